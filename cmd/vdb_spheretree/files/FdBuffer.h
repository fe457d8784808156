// SPDX-License-Identifier: Apache-2.0
/// @file FdBuffer.h
/// @brief Reading from and writing to files and pipes, where Ctrl-C ends the waiting.
///
/// OpenVDB does not check whether a read succeeded, and goes on with what happens to be in memory.
/// So it should read through a stream with exceptions on: then a truncated file fails where it ends.

#pragma once

#include "base/Errors.h"

#include <istream>
#include <memory>
#include <streambuf>
#include <string>

namespace command {

/// A pipe whose reader has gone. That is no failure of whoever wants no more of a text (`| head`).
class ClosedPipe : public CommandError {
public:
    explicit ClosedPipe(const std::string& what)
        : CommandError(kOutput, what + ": the reading end of the pipe is closed")
    {}
};

/// @brief Write all that is left in @a data to a file descriptor.
/// @throw Interrupted, ClosedPipe, CommandError (output) naming @a what and the reason
void writeToFd(int fd, std::streambuf& data, const std::string& what);

/// Writes to a file descriptor, which it does not own, a buffer at a time. What is left in the buffer
/// is written by pubsync(), and lost without.
class FdSink : public std::streambuf {
public:
    /// @param what  for messages
    FdSink(int fd, const std::string& what);

protected:
    /// @throw as writeToFd(), so the stream should not catch: exceptions(std::ios::badbit)
    int_type overflow(int_type c) override;
    int sync() override;

private:
    int mFd;
    std::string mWhat;
    std::unique_ptr<char[]> mBuffer; // not zeros, which take as long as reading a small file
};

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
    int64_t mPosition = 0;           ///< of the end of the buffer, in bytes from the start
    std::unique_ptr<char[]> mBuffer; // not zeros, which take as long as reading a small file
};

} // namespace command
