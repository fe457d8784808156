// SPDX-License-Identifier: Apache-2.0
#include "InputFile.h"

#include "base/Errors.h"
#include "base/Stop.h"

#include <openvdb_spheretree/base/FileStamp.h>

#include <cerrno>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace command {

using openvdb_spheretree::detail::isSameFile;
using openvdb_spheretree::detail::isUnwritten;

namespace {

int openToRead(const std::string& path)
{
    struct stat info;
    const bool isPipe = stat(path.c_str(), &info) == 0 && S_ISFIFO(info.st_mode);
    for (;;) {
        throwIfStopped();
        const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC | (isPipe ? O_NONBLOCK : 0));
        if (fd >= 0) {
            if (isPipe) { // only the opening was not to wait
                fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) & ~O_NONBLOCK);
            }
            return fd;
        }
        if (errno != EINTR) throwInput("cannot read " + systemError(path));
    }
}

} // namespace

InputFile::InputFile(const std::string& path) : mFd(openToRead(path)) {}

InputFile InputFile::standardInput() { return InputFile(STDIN_FILENO); }

InputFile::~InputFile()
{
    if (mFd != STDIN_FILENO) close(mFd);
}

bool InputFile::isStill(const std::string& path) const
{
    struct stat opened, named;
    return fstat(mFd, &opened) == 0 && stat(path.c_str(), &named) == 0 && isSameFile(opened, named)
        && isUnwritten(opened, named);
}

} // namespace command
