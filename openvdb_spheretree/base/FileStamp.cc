// SPDX-License-Identifier: Apache-2.0
#include "FileStamp.h"

namespace openvdb_spheretree::detail {

bool isSameFile(const struct stat& one, const struct stat& other)
{
    return one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

bool isUnwritten(const struct stat& before, const struct stat& now)
{
    return now.st_size == before.st_size && now.st_mtim.tv_sec == before.st_mtim.tv_sec
        && now.st_mtim.tv_nsec == before.st_mtim.tv_nsec;
}

FileStamp::FileStamp(const std::string& path)
    : mPath(path), mIsFile(stat(path.c_str(), &mBefore) == 0 && S_ISREG(mBefore.st_mode))
{}

bool FileStamp::isUnchanged() const
{
    struct stat now;
    if (!mIsFile || stat(mPath.c_str(), &now) != 0) return true;
    return !isSameFile(mBefore, now) || isUnwritten(mBefore, now);
}

} // namespace openvdb_spheretree::detail
