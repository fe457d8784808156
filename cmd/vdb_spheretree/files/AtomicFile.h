// SPDX-License-Identifier: Apache-2.0
/// @file AtomicFile.h
/// @brief An output file that appears whole or not at all. It is written under a temporary name in
/// the folder of its target, and renamed when it is complete.

#pragma once

#include <fstream>
#include <functional>
#include <iosfwd>
#include <string>

namespace command {

class AtomicFile {
public:
    /// @brief Check whether @a path can be written, without touching it: its folder exists and takes
    /// new files, and the path is no folder, device or write-protected file.
    /// @throw CommandError (output) naming the path and the reason why not
    static void checkTarget(const std::string& path);

    /// @throw CommandError (output) if the temporary file cannot be made
    explicit AtomicFile(const std::string& path);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile(); ///< removes the temporary file, unless committed

    /// @brief Write the file, and close it. Call once.
    /// @param content  writes to a binary stream, which is open for reading too
    /// @throw CommandError (output) if the disk is full, and what @a content throws
    void write(const std::function<void(std::iostream&)>& content);
    /// @brief Put the written file in the place of its target.
    /// @throw Interrupted if the user has asked for a stop, CommandError (output) if that fails
    void commit();

private:
    std::string mPath, mTarget, mTemporary; ///< mTarget: mPath with symbolic links followed
    std::fstream mStream;
    bool mCommitted = false;
};

} // namespace command
