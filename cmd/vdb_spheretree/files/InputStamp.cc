// SPDX-License-Identifier: Apache-2.0
#include "InputStamp.h"

#include "base/Errors.h"

namespace command {

InputStamp::InputStamp(const std::string& path)
    : mPath(path), mIsFile(stat(path.c_str(), &mBefore) == 0 && S_ISREG(mBefore.st_mode))
{}

void InputStamp::requireUnchanged() const
{
    struct stat now;
    if (!mIsFile || stat(mPath.c_str(), &now) != 0) return;
    if (now.st_dev != mBefore.st_dev || now.st_ino != mBefore.st_ino) return;
    const bool same = now.st_size == mBefore.st_size && now.st_mtim.tv_sec == mBefore.st_mtim.tv_sec
        && now.st_mtim.tv_nsec == mBefore.st_mtim.tv_nsec;
    if (!same) throwInput(mPath + ": the file was changed while it was read; run it again");
}

} // namespace command
