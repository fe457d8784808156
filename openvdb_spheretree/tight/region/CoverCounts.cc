// SPDX-License-Identifier: Apache-2.0
#include "CoverCounts.h"

namespace openvdb_spheretree {
namespace tight {

namespace {

std::size_t bitsOf(uint32_t value)
{
    std::size_t bits = 1;
    while (value >>= 1) ++bits;
    return bits;
}

} // namespace

CoverCounts::CoverCounts(std::size_t leaves, uint32_t most)
    : mPerLeaf(bitsOf(most)), mPlanes(leaves * mPerLeaf, LeafMask{}), mWhole(leaves, 0)
{}

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
    LeafMask* plane = planes(leaf);
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

LeafMask CoverCounts::countedAs(std::size_t leaf, uint32_t count) const
{
    LeafMask differs{};
    for (std::size_t bit = 0; bit < mPerLeaf; ++bit) {
        const uint64_t expected = count >> bit & 1 ? ~uint64_t(0) : 0;
        for (int word = 0; word < 8; ++word) differs[word] |= planes(leaf)[bit][word] ^ expected;
    }
    return count >> mPerLeaf ? LeafMask{} : LeafMask::full() - differs;
}

LeafMask CoverCounts::once(std::size_t leaf) const
{
    return mWhole[leaf] > 1 ? LeafMask{} : countedAs(leaf, 1 - mWhole[leaf]);
}

LeafMask CoverCounts::twice(std::size_t leaf) const
{
    return mWhole[leaf] > 2 ? LeafMask{} : countedAs(leaf, 2 - mWhole[leaf]);
}

} // namespace tight
} // namespace openvdb_spheretree
