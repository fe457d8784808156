// SPDX-License-Identifier: Apache-2.0
#include "FdBuffer.h"

#include "Errors.h"
#include "Progress.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <poll.h>
#include <unistd.h>

namespace command {

namespace {

constexpr size_t kBufferSize = 1 << 20;
constexpr size_t kLargestRead = 1 << 26; // Ctrl-C is looked for at least this often

/// A signal that comes just before a read does not wake it; so wait in slices, and look. One that
/// comes during the wait ends it early, with nothing to read: then look, and wait on.
void waitForData(int fd)
{
    for (;;) {
        throwIfStopped();
        pollfd wanted{fd, POLLIN, 0};
        const int ready = poll(&wanted, 1, 200);
        if (ready > 0 || (ready < 0 && errno != EINTR)) return; // read() reports what is wrong
    }
}

} // namespace

FdBuffer::FdBuffer(int fd) : mFd(fd), mBuffer(kBufferSize) {}

size_t FdBuffer::fill(char* to, size_t size)
{
    for (;;) {
        waitForData(mFd);
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
    const size_t count = fill(mBuffer.data(), mBuffer.size());
    setg(mBuffer.data(), mBuffer.data(), mBuffer.data() + count);
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
        } else if (size_t(wanted) >= mBuffer.size()) { // large blocks go straight to their place
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
