// SPDX-License-Identifier: Apache-2.0
/// @file NearestFirst-inl.h
/// @brief The walk down the blocks of a tree that all questions to one tree share: what is nearest is
/// looked at first, and what is no nearer than the best leaf found is left out.
///
/// A question is a struct of two functions, and how it ends:
/// - lanes(block, best, key) tests a block: it returns a bit for each lane that may hold something
///   nearer than `best`, and fills in keys of these lanes: lower bounds of what is below them, and of
///   a leaf its own value;
/// - accept(leaf, key): whether a leaf counts;
/// - isEnough(key): whether nothing nearer is worth looking for.
///
/// The order is fixed: children by key, then by lane, with the nearest one next. So the answer, and the number
/// of blocks, are the same on every machine. This header is compiled once for each instruction set.

#if defined(SPHERETREE_NEAREST_FIRST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHERETREE_NEAREST_FIRST_INL_H
#undef SPHERETREE_NEAREST_FIRST_INL_H
#else
#define SPHERETREE_NEAREST_FIRST_INL_H
#endif

#include "BlockHit.h"
#include "SphereBlocks.h"

#include <hwy/highway.h>

#include <cstdint>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Lanes = hn::CappedTag<float, kBlockWidth>;
using Floats = hn::Vec<Lanes>;

/// @return the bits of a mask of Lanes, at the place of lane @a first.
template <typename Mask>
HWY_INLINE uint32_t bitsOf(const Mask& mask, std::size_t first)
{
    uint8_t bits[8] = {};
    hn::StoreMaskBits(Lanes(), mask, bits);
    return uint32_t(bits[0]) << first;
}

HWY_INLINE Floats sumOfProducts(Floats a, Floats b, Floats c, Floats d, Floats e, Floats f)
{
    return hn::Add(hn::Add(hn::Mul(a, b), hn::Mul(c, d)), hn::Mul(e, f));
}

struct WaitingBlock {
    float key;
    int32_t block;
};

/// Each step takes one block, and adds one for each of its lanes but the one that is next.
constexpr int kMostWaiting = kMostDepth * (kBlockWidth - 1);

/// Those of one block come with the nearest on top.
HWY_INLINE void push(WaitingBlock* waiting, int bottom, int& count, WaitingBlock added)
{
    int at = count++;
    for (; at > bottom && waiting[at - 1].key < added.key; --at) waiting[at] = waiting[at - 1];
    waiting[at] = added;
}

/// @param limit  only what is nearer counts
template <class Question>
HWY_INLINE BlockHit nearestFirst(const SphereBlock* blocks, const Question& question, float limit)
{
    WaitingBlock waiting[kMostWaiting]; // left as it is: filling it takes longer than a question
    alignas(SphereBlock) float key[kBlockWidth];
    BlockHit best{limit, -1, 0};
    int count = 0;
    for (int32_t here = 0;;) {
        const SphereBlock& block = blocks[here];
        ++best.blocks;
        const int bottom = count;
        WaitingBlock next{best.key, -1};
        for (uint32_t left = question.lanes(block, best.key, key); left != 0; left &= left - 1) {
            const auto lane = int(hwy::Num0BitsBelowLS1Bit_Nonzero32(left));
            WaitingBlock child{key[lane], block.child[lane]};
            if (!(child.key < best.key)) continue;
            if (child.block < 0) {
                if (!question.accept(~child.block, child.key)) continue;
                best.key = child.key;
                best.leaf = ~child.block;
                if (question.isEnough(child.key)) return best;
                continue;
            }
            if (child.key < next.key || next.block < 0) std::swap(child, next);
            if (child.block >= 0) push(waiting, bottom, count, child);
        }
        if (next.block < 0 || !(next.key < best.key)) {
            do {
                if (count == 0) return best;
                next = waiting[--count];
            } while (!(next.key < best.key));
        }
        here = next.block;
    }
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif // SPHERETREE_NEAREST_FIRST_INL_H
