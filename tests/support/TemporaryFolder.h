// SPDX-License-Identifier: Apache-2.0
/// @file TemporaryFolder.h
/// @brief For tests of temporary files: where they go, whether any are left, and a full disk.

#pragma once

#include <cstdint>
#include <string>

#include <sys/resource.h>

namespace spheretree_test {

/// Sets TMPDIR as long as it lives.
class TemporaryDirectory {
public:
    explicit TemporaryDirectory(const std::string& folder);
    ~TemporaryDirectory();
    TemporaryDirectory(const TemporaryDirectory&) = delete;
    TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;

private:
    bool mWasSet = false;
    std::string mBefore;
};

/// A new folder that is TMPDIR as long as it lives.
class TemporaryFolder {
public:
    TemporaryFolder() : mPath(made()), mDirectory(mPath) {}
    ~TemporaryFolder();

    std::string path() const { return mPath; }
    int64_t files() const;
    /// @return the files of this process that are open in the folder, without a name too.
    int64_t openFiles() const;

private:
    static std::string made();

    std::string mPath;
    TemporaryDirectory mDirectory;
};

/// Files of this process can have so many bytes, as long as it lives.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes);
    ~FileSizeLimit();
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    void (*mHandler)(int);
    rlimit mBefore{};
};

} // namespace spheretree_test
