// SPDX-License-Identifier: Apache-2.0
/// @file FileStamp.h
/// @brief Whether a file is still what it was: one that is written to while it is read gives a mixture of old and new
/// that nobody else may notice.
///
/// Size and time of the last change are compared, so a writer that sets the time back, or writes twice within one tick
/// of the file system's clock, gets away with it. A file that has been replaced by rename or removed is no concern: its
/// reader has the old one open.

#pragma once

#include <string>

#include <sys/stat.h>

namespace openvdb_spheretree::detail {

/// For messages, behind the name of the file.
constexpr const char* kWasChanged = "the file was changed while it was read; run it again";

/// @return whether both are of one file.
bool isSameFile(const struct stat& one, const struct stat& other);
/// @return whether a file has not been written to between the two, as far as they tell.
bool isUnwritten(const struct stat& before, const struct stat& now);

class FileStamp {
public:
    /// @param path  what is no regular file, or not there, is never compared
    explicit FileStamp(const std::string& path);
    /// @return false if the file has been written to since.
    bool isUnchanged() const;
    const std::string& path() const { return mPath; }

private:
    std::string mPath;
    struct stat mBefore = {};
    bool mIsFile;
};

} // namespace openvdb_spheretree::detail
