// SPDX-License-Identifier: Apache-2.0
#include "SpooledInput.h"

#include "base/Errors.h"
#include "FdBuffer.h"

#include <openvdb_spheretree/base/UnnamedFile.h>

#include <cerrno>
#include <streambuf>
#include <vector>

#include <unistd.h>

namespace command {

void requireInput(std::streambuf& input, const std::string& name)
{
    try {
        if (input.sgetc() != std::streambuf::traits_type::eof()) return;
        throwInput("the input is empty: standard input is closed or has nothing in it, or the "
                   "command before this one has written nothing");
    } catch (...) {
        rethrowNamed(name, kInput);
    }
}

SpooledInput::SpooledInput(const std::string& name)
    : mFolder(openvdb_spheretree::detail::temporaryFolder()),
      mFd(openvdb_spheretree::detail::openUnnamedFile(mFolder))
{
    if (mFd < 0) throwOutput("no temporary file can be made in " + systemError(mFolder));
    try {
        fillFrom(STDIN_FILENO, name);
    } catch (...) {
        close(mFd);
        throw;
    }
}

SpooledInput::~SpooledInput() { close(mFd); }

void SpooledInput::fillFrom(int fd, const std::string& name) const
{
    FdBuffer input(fd);
    requireInput(input, name);
    std::vector<char> block(1 << 20);
    while (const auto size = size_t(input.sgetn(block.data(), std::streamsize(block.size())))) {
        for (size_t done = 0; done < size;) {
            const ssize_t count = write(mFd, block.data() + done, size - done);
            if (count >= 0) {
                done += size_t(count);
            } else if (errno != EINTR) {
                throwOutput(name + ": the temporary file in " + systemError(mFolder)
                    + "; set TMPDIR to a folder that has room");
            }
        }
    }
}

} // namespace command
