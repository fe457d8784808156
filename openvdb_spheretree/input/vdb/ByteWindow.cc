// SPDX-License-Identifier: Apache-2.0
#include "ByteWindow.h"

#include <openvdb/Exceptions.h>

#include <algorithm>

namespace openvdb_spheretree::detail {

namespace {

constexpr uint64_t kPiece = 1 << 20; // bytes; a claimed length is believed in such pieces

} // namespace

void ByteWindow::clear()
{
    std::copy(mBytes.begin() + std::ptrdiff_t(mTaken), mBytes.begin() + std::ptrdiff_t(mArrived),
        mBytes.begin());
    mArrived -= mTaken;
    mStart += mTaken;
    mTaken = 0;
}

void ByteWindow::require(uint64_t count)
{
    while (mArrived - mTaken < count) {
        const uint64_t missing = std::min(count - (mArrived - mTaken), kPiece);
        // What the source has at hand costs nothing; to ask for more could wait for ever on a pipe.
        const auto atHand = uint64_t(std::max<std::streamsize>(mSource.in_avail(), 0));
        const auto piece = size_t(std::max(missing, std::min(atHand, kPiece)));
        if (mBytes.size() < mArrived + piece) mBytes.resize(2 * mArrived + piece);
        const std::streamsize some =
            mSource.sgetn(mBytes.data() + mArrived, std::streamsize(piece));
        mArrived += size_t(some);
        if (size_t(some) < missing) fail("it ends too early");
    }
}

const char* ByteWindow::take(uint64_t count)
{
    require(count);
    const char* bytes = mBytes.data() + mTaken;
    mTaken += size_t(count);
    return bytes;
}

std::string ByteWindow::string()
{
    const auto length = value<uint32_t>();
    return std::string(take(length), length);
}

void ByteWindow::eraseFrom(size_t begin)
{
    std::copy(mBytes.begin() + std::ptrdiff_t(mTaken), mBytes.begin() + std::ptrdiff_t(mArrived),
        mBytes.begin() + std::ptrdiff_t(begin));
    const size_t erased = mTaken - begin;
    mArrived -= erased;
    mTaken -= erased;
    mStart += erased;
}

void ByteWindow::fail(const std::string& what) const
{
    OPENVDB_THROW(openvdb::IoError,
        "the file is truncated or damaged at byte " << position() << ": " << what);
}

} // namespace openvdb_spheretree::detail
