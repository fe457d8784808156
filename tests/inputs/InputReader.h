// SPDX-License-Identifier: Apache-2.0
/// @file InputReader.h
/// @brief One way into every reader of files, for fuzz targets and mutation tests alike, and what is
/// asked of them: an input is read whole, or refused with a message that names the file.

#pragma once

#include "InputFile.h"
#include "VolumeInput.h"

#include <openvdb/Grid.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace spheretree_test {

/// Which uses a tree is put to that was read (TreeUse.h).
enum class TreeUses {
    Some, ///< a part of them, by the bytes of the file: the same each time
    All
};

/// What reading may take beyond what the process has when the limit is set; what is done with a tree then may take
/// more, as a small file may say of a large object that it has it.
struct ReadingLimit {
    uint64_t bytes = 0;   ///< for any file; 0: no limit
    uint64_t perByte = 0; ///< and for each byte of it
};

class InputReader {
public:
    /// @param extension  `.vdb`, `.vol`, `.longvol`, another volume's, or a kind of VolumeInput.h; a mesh's, `.csv`, `.json`;
    ///                   `.poses`, `.bodies`, `.points` or `.rays` for a table of questions; `.cfg` for a file of -config; or `.expression` for the
    ///                   value of an option, which is in no file
    explicit InputReader(const std::string& extension, TreeUses uses = TreeUses::Some);

    /// Limits the addresses of the process while it reads, from now on. Not under sanitizers, which have their own.
    void limit(const ReadingLimit& reading);

    /// @brief Read the bytes as a file. Of a `.vdb`, sphere-trees become trees, which are used (TreeUse.h), and all
    /// values of other grids are read.
    /// @param delayed  of a `.vdb`: values are read as they are used
    /// @return whether it was read; false if it was refused as it should be.
    /// @throw anything else that the reader throws; std::logic_error for a message that does not name
    ///        the file, or is too long for people
    bool read(const std::string& bytes, bool delayed = false);

private:
    static bool evaluates(const std::string& text);
    void readVdb(const std::string& bytes, bool delayed) const;
    void readOther(const std::string& bytes) const;
    void readValues(const openvdb::GridBase& grid) const;
    /// @return the bytes of addresses that the process may have while it reads such a file; 0: any.
    uint64_t allowed(std::size_t fileBytes) const;

    std::string mExtension;
    InputFile mFile;
    std::optional<VolumeInput> mVolume;
    TreeUses mUses;
    ReadingLimit mLimit;
    uint64_t mBefore = 0; ///< bytes of addresses when the limit was set
};

} // namespace spheretree_test
