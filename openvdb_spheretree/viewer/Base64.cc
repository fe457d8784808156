// SPDX-License-Identifier: Apache-2.0
#include "Base64.h"

#include <openvdb/Exceptions.h>

#include <ostream>

namespace openvdb_spheretree::detail {

void Base64::putGroup()
{
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const uint32_t group = mGroup << 8 * (3 - mBytes);
    for (int digit = 0; digit < 4; ++digit) {
        mText += digit <= mBytes ? kDigits[group >> (18 - 6 * digit) & 63] : '=';
    }
    mGroup = 0;
    mBytes = 0;
    constexpr std::size_t kFlushBytes = std::size_t(1) << 16;
    if (mText.size() >= kFlushBytes) write();
}

void Base64::write()
{
    mOut.write(mText.data(), std::streamsize(mText.size()));
    if (!mOut) OPENVDB_THROW(openvdb::IoError, "cannot write the .html: is the disk full?");
    mText.clear();
}

void Base64::finish()
{
    if (mBytes > 0) putGroup();
    write();
}

} // namespace openvdb_spheretree::detail
