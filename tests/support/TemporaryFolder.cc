// SPDX-License-Identifier: Apache-2.0
#include "TemporaryFolder.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <system_error>

#include <unistd.h>

namespace spheretree_test {

TemporaryDirectory::TemporaryDirectory(const std::string& folder)
{
    const char* before = std::getenv("TMPDIR");
    mWasSet = before != nullptr;
    if (before) mBefore = before;
    setenv("TMPDIR", folder.c_str(), 1);
}

TemporaryDirectory::~TemporaryDirectory()
{
    if (mWasSet) setenv("TMPDIR", mBefore.c_str(), 1);
    else unsetenv("TMPDIR");
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(mPath, ignored);
}

int64_t TemporaryFolder::files() const
{
    using std::filesystem::directory_iterator;
    return std::distance(directory_iterator(mPath), directory_iterator());
}

int64_t TemporaryFolder::openFiles() const
{
    int64_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        std::error_code gone; // the folder itself is open while it is listed
        const auto target = std::filesystem::read_symlink(entry.path(), gone);
        if (target.string().compare(0, mPath.size(), mPath) == 0) ++count;
    }
    return count;
}

std::string TemporaryFolder::made()
{
    std::string name = (std::filesystem::temp_directory_path() / "spheretree.XXXXXX").string();
    return mkdtemp(name.data()) ? name : std::string();
}

FileSizeLimit::FileSizeLimit(rlim_t bytes) : mHandler(std::signal(SIGXFSZ, SIG_IGN))
{
    getrlimit(RLIMIT_FSIZE, &mBefore);
    const rlimit limit{bytes, mBefore.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
}

FileSizeLimit::~FileSizeLimit()
{
    setrlimit(RLIMIT_FSIZE, &mBefore);
    std::signal(SIGXFSZ, mHandler);
}

} // namespace spheretree_test
