// SPDX-License-Identifier: Apache-2.0
#include "FileStamp.h"

namespace openvdb_spheretree::detail {

FileStamp::FileStamp(const std::string& path)
    : mPath(path), mIsFile(stat(path.c_str(), &mBefore) == 0 && S_ISREG(mBefore.st_mode))
{}

bool FileStamp::isUnchanged() const
{
    struct stat now;
    if (!mIsFile || stat(mPath.c_str(), &now) != 0) return true;
    if (now.st_dev != mBefore.st_dev || now.st_ino != mBefore.st_ino) return true;
    return now.st_size == mBefore.st_size && now.st_mtim.tv_sec == mBefore.st_mtim.tv_sec
        && now.st_mtim.tv_nsec == mBefore.st_mtim.tv_nsec;
}

} // namespace openvdb_spheretree::detail
