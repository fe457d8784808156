// SPDX-License-Identifier: Apache-2.0
/// @file TemporaryFolder.h
/// @brief For tests of temporary files: where they go, whether any are left, and a full disk.

#pragma once

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <csignal>
#include <sys/resource.h>
#include <unistd.h>

namespace spheretree_test {

/// Sets TMPDIR as long as it lives.
class TemporaryDirectory {
public:
    explicit TemporaryDirectory(const std::string& folder)
    {
        const char* before = std::getenv("TMPDIR");
        mWasSet = before != nullptr;
        if (before) mBefore = before;
        setenv("TMPDIR", folder.c_str(), 1);
    }
    ~TemporaryDirectory()
    {
        if (mWasSet) setenv("TMPDIR", mBefore.c_str(), 1);
        else unsetenv("TMPDIR");
    }
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
    ~TemporaryFolder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(mPath, ignored);
    }

    std::string path() const { return mPath; }
    int64_t files() const
    {
        using std::filesystem::directory_iterator;
        return std::distance(directory_iterator(mPath), directory_iterator());
    }
    /// @return the files of this process that are open in the folder, without a name too.
    int64_t openFiles() const
    {
        int64_t count = 0;
        for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
            std::error_code gone; // the folder itself is open while it is listed
            const auto target = std::filesystem::read_symlink(entry.path(), gone);
            if (target.string().compare(0, mPath.size(), mPath) == 0) ++count;
        }
        return count;
    }

private:
    static std::string made()
    {
        std::string name = (std::filesystem::temp_directory_path() / "spheretree.XXXXXX").string();
        return mkdtemp(name.data()) ? name : std::string();
    }

    std::string mPath;
    TemporaryDirectory mDirectory;
};

/// Files of this process can have so many bytes, as long as it lives.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : mHandler(std::signal(SIGXFSZ, SIG_IGN))
    {
        getrlimit(RLIMIT_FSIZE, &mBefore);
        const rlimit limit{bytes, mBefore.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit()
    {
        setrlimit(RLIMIT_FSIZE, &mBefore);
        std::signal(SIGXFSZ, mHandler);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
    void (*mHandler)(int);
    rlimit mBefore{};
};

} // namespace spheretree_test
