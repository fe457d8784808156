// SPDX-License-Identifier: Apache-2.0
/// @file InputStamp.h
/// @brief Whether an input file is still what it was: one that is written to while it is read gives
/// a mixture of old and new that nobody else may notice.
///
/// Size and time of the last change are compared, so a writer that sets the time back, or writes
/// twice within one tick of the file system's clock, gets away with it. A file that has been replaced
/// by rename or removed is no concern: its reader has the old one open.

#pragma once

#include <string>

#include <sys/stat.h>

namespace command {

class InputStamp {
public:
    /// @param path  what is no regular file, or not there, is never compared
    explicit InputStamp(const std::string& path);
    /// @throw CommandError (input) if the file has been written to since
    void requireUnchanged() const;

private:
    std::string mPath;
    struct stat mBefore = {};
    bool mIsFile;
};

} // namespace command
