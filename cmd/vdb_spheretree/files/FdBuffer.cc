// SPDX-License-Identifier: Apache-2.0
#include "FdBuffer.h"

#include "base/Errors.h"
#include "base/Stop.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <limits.h>
#include <poll.h>
#include <unistd.h>

namespace command {

namespace {

constexpr size_t kBufferSize = 1 << 20;
constexpr size_t kLargestRead = 1 << 26; // Ctrl-C is looked for at least this often

/// A signal that comes just before a read or write does not wake it; so wait in slices, and look.
/// One that comes during the wait ends it early, with nothing there: then look, and wait on.
void waitFor(int fd, short event)
{
    for (;;) {
        throwIfStopped();
        pollfd wanted{fd, event, 0};
        const int ready = poll(&wanted, 1, 200);
        // What is wrong, if anything, is for read() or write() to report.
        if (ready > 0 || (ready < 0 && errno != EINTR)) return;
    }
}

/// Bytes that a pipe which has any room takes without blocking.
constexpr size_t kAtOnce = PIPE_BUF;

void writeBytes(int fd, const char* bytes, size_t size, const std::string& what)
{
    for (size_t done = 0; done < size;) {
        waitFor(fd, POLLOUT);
        const ssize_t count = ::write(fd, bytes + done, std::min(size - done, kAtOnce));
        if (count >= 0) {
            done += size_t(count);
        } else if (errno == EPIPE) {
            throw ClosedPipe(what);
        } else if (errno != EINTR) {
            throwOutput("cannot write " + systemError(what));
        }
    }
}

} // namespace

void writeToFd(int fd, std::streambuf& data, const std::string& what)
{
    char block[kAtOnce];
    while (const auto size = size_t(data.sgetn(block, sizeof(block)))) {
        writeBytes(fd, block, size, what);
    }
}

FdSink::FdSink(int fd, const std::string& what)
    : mFd(fd), mWhat(what), mBuffer(new char[kBufferSize])
{
    setp(mBuffer.get(), mBuffer.get() + kBufferSize);
}

FdSink::int_type FdSink::overflow(int_type c)
{
    sync();
    if (!traits_type::eq_int_type(c, traits_type::eof())) sputc(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
}

int FdSink::sync()
{
    writeBytes(mFd, pbase(), size_t(pptr() - pbase()), mWhat);
    setp(mBuffer.get(), mBuffer.get() + kBufferSize);
    return 0;
}

FdBuffer::FdBuffer(int fd) : mFd(fd), mBuffer(new char[kBufferSize]) {}

size_t FdBuffer::fill(char* to, size_t size)
{
    for (;;) {
        waitFor(mFd, POLLIN);
        const ssize_t count = ::read(mFd, to, std::min(size, kLargestRead));
        if (count >= 0) {
            mPosition += count;
            return size_t(count);
        }
        if (errno != EINTR) throwInput(std::strerror(errno));
    }
}

FdBuffer::int_type FdBuffer::underflow()
{
    const size_t count = fill(mBuffer.get(), kBufferSize);
    setg(mBuffer.get(), mBuffer.get(), mBuffer.get() + count);
    return count ? traits_type::to_int_type(*gptr()) : traits_type::eof();
}

std::streamsize FdBuffer::xsgetn(char* to, std::streamsize count)
{
    std::streamsize done = 0;
    while (done < count) {
        const std::streamsize wanted = count - done;
        if (const std::streamsize buffered = egptr() - gptr(); buffered > 0) {
            const std::streamsize some = std::min(buffered, wanted);
            std::memcpy(to + done, gptr(), size_t(some));
            gbump(int(some));
            done += some;
        } else if (size_t(wanted) >= kBufferSize) { // large blocks go straight to their place
            const size_t some = fill(to + done, size_t(wanted));
            if (some == 0) break;
            done += std::streamsize(some);
        } else if (underflow() == traits_type::eof()) {
            break;
        }
    }
    return done;
}

FdBuffer::pos_type FdBuffer::seekoff(
    off_type offset, std::ios_base::seekdir direction, std::ios_base::openmode)
{
    if (offset != 0 || direction != std::ios_base::cur) return pos_type(off_type(-1));
    return pos_type(off_type(mPosition - (egptr() - gptr())));
}

} // namespace command
