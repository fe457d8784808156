// SPDX-License-Identifier: Apache-2.0
/// @file InputReader.h
/// @brief One way into every reader of files, for fuzz targets and mutation tests alike, and what is
/// asked of them: an input is read whole, or refused with a message that names the file.

#pragma once

#include "InputFile.h"

#include <string>

namespace spheretree_test {

class InputReader {
public:
    /// @param extension  `.vdb`, `.vol`, `.longvol`, another volume's, a mesh's, `.csv`, `.json`; `.poses`, `.bodies`, `.points` or
    ///                   `.rays` for a table of questions; `.cfg` for a file of -config; or `.expression` for the
    ///                   value of an option, which is in no file
    explicit InputReader(const std::string& extension) : mExtension(extension), mFile(extension) {}

    /// @brief Read the bytes as a file. Of a `.vdb`, sphere-trees become trees, which are used (TreeUse.h), and all
    /// values of other grids are read.
    /// @param delayed  of a `.vdb`: values are read as they are used
    /// @return whether it was read; false if it was refused as it should be.
    /// @throw anything else that the reader throws; std::logic_error for a message that does not name
    ///        the file, or is too long for people
    bool read(const std::string& bytes, bool delayed = false);

private:
    static bool evaluates(const std::string& text);
    void readVdb(bool delayed) const;

    std::string mExtension;
    InputFile mFile;
};

} // namespace spheretree_test
