// SPDX-License-Identifier: Apache-2.0
#include "ArrayLayout.h"

#include <openvdb/Exceptions.h>

namespace openvdb_spheretree::detail {

using openvdb::IoError;

std::string describe(const ArrayLayout& layout)
{
    return std::to_string(layout.dim[0]) + " x " + std::to_string(layout.dim[1]) + " x "
        + std::to_string(layout.dim[2]) + " numbers of type " + toString(layout.type);
}

void requireSides(const ArrayLayout& layout)
{
    for (const uint64_t side : layout.dim) {
        if (side == 0) throw IoError("its array is empty: " + describe(layout));
        if (side > ArrayLayout::kMaxSide) {
            throw IoError("its array is too large: " + describe(layout)
                + ", and a side has at most " + std::to_string(ArrayLayout::kMaxSide));
        }
    }
}

void requireHeld(const ArrayLayout& layout, uint64_t held, bool deflated)
{
    constexpr uint64_t kMaxRatio = 1032; // 258 bytes in two bits
    constexpr uint64_t kSlack = 64;      // bytes of the stream, for rounding and block headers
    const std::string claim = describe(layout) + " take " + std::to_string(layout.bytes())
        + " bytes, but the file holds " + std::to_string(held);
    if (deflated && layout.bytes() / kMaxRatio > held + kSlack) {
        throw IoError(claim + " compressed ones, which cannot expand to that many");
    }
    if (deflated || held == layout.bytes()) return;
    throw IoError(claim
        + (held < layout.bytes() ? "; it is truncated, or its shape or type is another one"
                                 : "; nothing may follow, or its shape or type is another one"));
}

} // namespace openvdb_spheretree::detail
