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

bool isWhole(const LeafMask& mask)
{
    uint64_t all = ~uint64_t(0);
    for (const uint64_t word : mask) all &= word;
    return all == ~uint64_t(0);
}

} // namespace

CoverCounts::CoverCounts(std::size_t leaves, uint32_t most)
    : mPerLeaf(bitsOf(most)), mPlanes(leaves * mPerLeaf, LeafMask{}), mWhole(leaves, 0)
{}

void CoverCounts::add(std::size_t leaf, const LeafMask& mask)
{
    if (isWhole(mask)) {
        ++mWhole[leaf];
        return;
    }
    LeafMask carry = mask;
    LeafMask* plane = planes(leaf);
    for (uint64_t any = 1; any; ++plane) {
        any = 0;
        for (int word = 0; word < 8; ++word) {
            const uint64_t before = (*plane)[word];
            (*plane)[word] = before ^ carry[word];
            carry[word] &= before;
            any |= carry[word];
        }
    }
}

void CoverCounts::remove(std::size_t leaf, const LeafMask& mask)
{
    if (isWhole(mask)) {
        --mWhole[leaf];
        return;
    }
    LeafMask borrow = mask;
    LeafMask* plane = planes(leaf);
    for (uint64_t any = 1; any; ++plane) {
        any = 0;
        for (int word = 0; word < 8; ++word) {
            const uint64_t before = (*plane)[word];
            (*plane)[word] = before ^ borrow[word];
            borrow[word] &= ~before;
            any |= borrow[word];
        }
    }
}

LeafMask CoverCounts::planesSay(std::size_t leaf, uint32_t count) const
{
    LeafMask differs{};
    for (std::size_t bit = 0; bit < mPerLeaf; ++bit) {
        const uint64_t wanted = count >> bit & 1 ? ~uint64_t(0) : 0;
        for (int word = 0; word < 8; ++word) differs[word] |= planes(leaf)[bit][word] ^ wanted;
    }
    for (uint64_t& word : differs) word = count >> mPerLeaf ? 0 : ~word;
    return differs;
}

LeafMask CoverCounts::once(std::size_t leaf) const
{
    return mWhole[leaf] > 1 ? LeafMask{} : planesSay(leaf, 1 - mWhole[leaf]);
}

LeafMask CoverCounts::twice(std::size_t leaf) const
{
    return mWhole[leaf] > 2 ? LeafMask{} : planesSay(leaf, 2 - mWhole[leaf]);
}

} // namespace tight
} // namespace openvdb_spheretree
