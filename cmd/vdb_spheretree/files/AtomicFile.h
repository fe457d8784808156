// SPDX-License-Identifier: Apache-2.0
/// @file AtomicFile.h
/// @brief An output file that is there whole or not at all: it is written under another name beside
/// its target, and renamed when it is complete.

#pragma once

#include <fstream>
#include <string>

namespace command {

class AtomicFile {
public:
    /// @brief Find out whether @a path can be written, without touching it: its folder is there and
    /// takes new files, and it is no folder, device or write-protected file itself.
    /// @throw CommandError (output) naming the path and what is in the way
    static void checkTarget(const std::string& path);

    /// @throw CommandError (output) if the temporary file cannot be made
    explicit AtomicFile(const std::string& path);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile(); ///< removes the temporary file, unless committed

    const std::string& target() const { return mPath; }
    /// Binary, readable too; throws std::ios_base::failure as soon as a write fails.
    std::fstream& stream() { return mStream; }

    /// @brief Flush and close: what can still fail fails here.
    void finish();
    /// @brief Put the finished file in place of its target.
    /// @throw Interrupted if the user has asked for a stop, CommandError (output) if that fails
    void commit();

private:
    std::string mPath, mTarget, mTemporary; ///< mTarget: mPath with symbolic links followed
    std::fstream mStream;
    bool mCommitted = false;
};

} // namespace command
