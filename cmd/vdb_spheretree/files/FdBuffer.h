// SPDX-License-Identifier: Apache-2.0
/// @file FdBuffer.h
/// @brief Files and pipes that Ctrl-C wakes from waiting: one to read from as a C++ stream, which
/// ends every short read with an exception, and one to write to.
///
/// OpenVDB does not ask its stream whether a read succeeded, and works on with what happened to be
/// in memory. Its reader is therefore given a stream that throws: a truncated file then fails where
/// it ends, whatever it ends in.

#pragma once

#include <istream>
#include <streambuf>
#include <string>
#include <vector>

namespace command {

/// @brief Writes all that is left in @a data to a file descriptor.
/// @throw Interrupted, CommandError (output) naming @a what and the reason
void writeToFd(int fd, std::streambuf& data, const std::string& what);

/// Reads from a file descriptor, which it does not own. Can tell its position, but not seek.
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
