// SPDX-License-Identifier: Apache-2.0
/// @file FdBuffer.h
/// @brief Reading from and writing to files and pipes, where Ctrl-C ends the waiting.
///
/// OpenVDB does not check whether a read succeeded, and goes on with what happens to be in memory.
/// So it should read through a stream with exceptions on: then a truncated file fails where it ends.

#pragma once

#include <istream>
#include <streambuf>
#include <string>
#include <vector>

namespace command {

/// @brief Write all that is left in @a data to a file descriptor.
/// @throw Interrupted, CommandError (output) naming @a what and the reason
void writeToFd(int fd, std::streambuf& data, const std::string& what);

/// Reads from a file descriptor, which it does not own. It knows its position, but cannot seek.
class FdBuffer : public std::streambuf {
public:
    explicit FdBuffer(int fd);

protected:
    int_type underflow() override;
    std::streamsize xsgetn(char* to, std::streamsize count) override;
    pos_type seekoff(off_type, std::ios_base::seekdir, std::ios_base::openmode) override;

private:
    /// @return bytes read, 0 at the end. @throw Interrupted, CommandError (input)
    size_t fill(char* to, size_t size);

    int mFd;
    int64_t mPosition = 0; ///< of the end of the buffer, in bytes from the start
    std::vector<char> mBuffer;
};

} // namespace command
