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
    : mPerLeaf(bitsOf(most)), mPlanes(leaves * mPerLeaf, LeafMask{}),
      mMore(leaves, LeafMask{})
{}

void CoverCounts::add(std::size_t leaf, const LeafMask& mask)
{
    LeafMask* const plane = planes(leaf);
    for (int word = 0; word < 8; ++word) {
        uint64_t carry = mask[word];
        mMore[leaf][word] |= plane[0][word] & carry;
        for (std::size_t bit = 0; carry && bit < mPerLeaf; ++bit) {
            const uint64_t before = plane[bit][word];
            plane[bit][word] = before ^ carry;
            carry &= before;
        }
    }
}

void CoverCounts::remove(std::size_t leaf, const LeafMask& mask)
{
    LeafMask* const plane = planes(leaf);
    for (int word = 0; word < 8; ++word) {
        uint64_t borrow = mask[word];
        for (std::size_t bit = 0; borrow && bit < mPerLeaf; ++bit) {
            const uint64_t before = plane[bit][word];
            plane[bit][word] = before ^ borrow;
            borrow &= ~before;
        }
        const uint64_t suspects = mask[word] & mMore[leaf][word]; // may have 1 left
        if (!suspects) continue;
        uint64_t more = 0;
        for (std::size_t bit = 1; bit < mPerLeaf; ++bit) more |= plane[bit][word];
        mMore[leaf][word] = more;
    }
}

LeafMask CoverCounts::once(std::size_t leaf) const
{
    LeafMask result = planes(leaf)[0];
    const LeafMask& more = mMore[leaf];
    for (int word = 0; word < 8; ++word) result[word] &= ~more[word];
    return result;
}

LeafMask CoverCounts::twice(std::size_t leaf) const
{
    const LeafMask* const plane = planes(leaf);
    LeafMask result{};
    if (mPerLeaf < 2) return result;
    for (int word = 0; word < 8; ++word) {
        uint64_t others = plane[0][word];
        for (std::size_t bit = 2; bit < mPerLeaf; ++bit) others |= plane[bit][word];
        result[word] = plane[1][word] & ~others;
    }
    return result;
}

} // namespace tight
} // namespace openvdb_spheretree
