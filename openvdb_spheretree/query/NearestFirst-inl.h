// SPDX-License-Identifier: Apache-2.0
/// @file NearestFirst-inl.h
/// @brief The walk down the blocks of a tree that all questions to one tree share: what is nearest
/// is looked at first, and what is no nearer than the best leaf found is left out.
///
/// A question is a struct of two functions, and how it ends:
/// - lanes(block, best, key) tests a block: it returns a bit for each lane that may hold something
///   nearer than `best`, and fills in keys of these lanes: lower bounds of what is below them, and
///   of a leaf its own value;
/// - accept(leaf, key): whether a leaf counts;
/// - isEnough(key): whether nothing nearer is worth looking for.
///
/// The order is fixed: children by key, then by lane, with the nearest one next. So the answer, and
/// the number of blocks, are the same on every machine. This header is compiled once for each
/// instruction set.

#if defined(SPHERETREE_NEAREST_FIRST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHERETREE_NEAREST_FIRST_INL_H
#undef SPHERETREE_NEAREST_FIRST_INL_H
#else
#define SPHERETREE_NEAREST_FIRST_INL_H
#endif

#include "BlockHit.h"
#include "BlockLanes-inl.h"

#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
HWY_INLINE V sumOfProducts(V a, V b, V c, V d, V e, V f)
{
    return hn::Add(hn::Add(hn::Mul(a, b), hn::Mul(c, d)), hn::Mul(e, f));
}

/// Ranks of some lanes by key, without a branch: how many of them have a smaller one. Keys are
/// compared as integers, which have the order of floats once the bits of negative ones are turned
/// around. The last three bits make way for the number of the lane: no two are equal.
HWY_INLINE void rankLanes(const float* key, uint32_t lanes, int32_t* rank)
{
    const hn::RebindToSigned<D> d;
    alignas(SphereBlock) int32_t order[kBlockWidth];
    for (std::size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
        const auto bits = hn::BitCast(d, hn::Load(D(), key + i));
        const auto turned = hn::And(hn::ShiftRight<31>(bits), hn::Set(d, 0x7fffffff));
        const auto ordered = hn::And(hn::Xor(bits, turned), hn::Set(d, ~(kBlockWidth - 1)));
        hn::Store(hn::Or(ordered, hn::Iota(d, int32_t(i))), d, order + i);
    }
    for (std::size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
        const auto own = hn::Load(d, order + i);
        auto before = hn::Zero(d);
        for (uint32_t left = lanes; left != 0; left &= left - 1) {
            const auto isBefore = hn::Lt(hn::Set(d, order[FirstLane(left)]), own);
            before = hn::Add(before, hn::IfThenElseZero(isBefore, hn::Set(d, 1)));
        }
        hn::Store(before, d, rank + i);
    }
}

struct WaitingBlock {
    float key;
    int32_t block;
};

/// Each step takes one block, and adds one for each of its lanes but the one that is next.
constexpr int kMostWaiting = kMostDepth * (kBlockWidth - 1) + 1;

/// The nearest of some lanes of a block is next, and the others wait, the nearest on top. (Sorted
/// one by one, points take 1.6 times as long: what goes where cannot be foretold. One or two lanes
/// keep clear of memory, which would be a tenth of a ray's time.)
/// @param lanes    not 0
/// @param waiting  the stack, of size @a count
HWY_INLINE WaitingBlock takeNearest(
    const SphereBlock& block, const float* key, uint32_t lanes, WaitingBlock* waiting, int& count)
{
    const int first = FirstLane(lanes);
    const uint32_t others = lanes & (lanes - 1);
    const WaitingBlock a{key[first], block.child[first]};
    if (others == 0) return a;
    if ((others & (others - 1)) == 0) {
        const int second = FirstLane(others);
        const WaitingBlock b{key[second], block.child[second]};
        const bool isNearer = a.key <= b.key;
        waiting[count++] = isNearer ? b : a;
        return isNearer ? a : b;
    }
    alignas(SphereBlock) int32_t rank[kBlockWidth];
    rankLanes(key, lanes, rank);
    count += int(hwy::PopCount(lanes));
    for (uint32_t left = lanes; left != 0; left &= left - 1) {
        const int lane = FirstLane(left);
        waiting[count - 1 - rank[lane]] = {key[lane], block.child[lane]};
    }
    return waiting[--count];
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
        const uint32_t met = question.lanes(block, best.key, key), leaves = LeafLanes(block);
        const float before = best.key;
        for (uint32_t left = met & leaves; left != 0; left &= left - 1) {
            const int lane = FirstLane(left);
            const int32_t leaf = ~block.child[lane];
            const bool isBetter = key[lane] < best.key && question.accept(leaf, key[lane]);
            best.key = isBetter ? key[lane] : best.key;
            best.leaf = isBetter ? leaf : best.leaf;
        }
        if (best.key < before && question.isEnough(best.key)) return best;
        const uint32_t inner = met & ~leaves;
        WaitingBlock next{best.key, 0};
        if (inner != 0) next = takeNearest(block, key, inner, waiting, count);
        while (!(next.key < best.key)) {
            if (count == 0) return best;
            next = waiting[--count];
        }
        here = next.block;
    }
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif // SPHERETREE_NEAREST_FIRST_INL_H
