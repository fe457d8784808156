// SPDX-License-Identifier: Apache-2.0
#include "CoverCounts.h"

namespace openvdb_spheretree::tight {

CoverCounts::CoverCounts(std::size_t leaves, uint32_t most) : mWhole(leaves, 0)
{
    while (most >>= 1) ++mPerLeaf;
    mPlanes.resize(leaves * mPerLeaf, LeafMask{});
}

void CoverCounts::add(std::size_t leaf, const LeafMask& mask)
{
    if (mask.all()) ++mWhole[leaf];
    else ripple(leaf, mask, 0);
}

void CoverCounts::remove(std::size_t leaf, const LeafMask& mask)
{
    if (mask.all()) --mWhole[leaf];
    else ripple(leaf, mask, ~uint64_t(0));
}

void CoverCounts::ripple(std::size_t leaf, LeafMask carry, uint64_t inverted)
{
    LeafMask* plane = &mPlanes[leaf * mPerLeaf];
    for (uint64_t any = 1; any; ++plane) {
        any = 0;
        for (int word = 0; word < 8; ++word) {
            const uint64_t before = (*plane)[word];
            (*plane)[word] = before ^ carry[word];
            carry[word] &= before ^ inverted;
            any |= carry[word];
        }
    }
}

LeafMask CoverCounts::heldBy(std::size_t leaf, uint32_t count) const
{
    if (mWhole[leaf] > count) return LeafMask{};
    const uint32_t inPlanes = count - mWhole[leaf];
    if (inPlanes >> mPerLeaf) return LeafMask{};
    LeafMask differs{};
    for (std::size_t bit = 0; bit < mPerLeaf; ++bit) {
        const LeafMask& plane = mPlanes[leaf * mPerLeaf + bit];
        differs |= inPlanes >> bit & 1 ? LeafMask::full() - plane : plane;
    }
    return LeafMask::full() - differs;
}

} // namespace openvdb_spheretree::tight
