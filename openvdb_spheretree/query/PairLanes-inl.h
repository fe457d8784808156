// SPDX-License-Identifier: Apache-2.0
/// @file PairLanes-inl.h
/// @brief What searches through two trees share: pairs of spheres by their places, which one is opened, and a block's
/// lanes against a sphere. Compiled once for each instruction set.

#if defined(SPHERETREE_PAIR_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SPHERETREE_PAIR_LANES_INL_H
#undef SPHERETREE_PAIR_LANES_INL_H
#else
#define SPHERETREE_PAIR_LANES_INL_H
#endif

#include "BlockLanes-inl.h"
#include "PairFrame.h"

#include <hwy/highway.h>

#include <cmath>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Squared distances of some lanes' centers to that of a sphere.
HWY_INLINE V DistSq(const SphereBlock& block, int lane, const FloatSphere& s)
{
    const D d;
    const V x = hn::Sub(hn::Load(d, block.x + lane), hn::Set(d, s.x));
    const V y = hn::Sub(hn::Load(d, block.y + lane), hn::Set(d, s.y));
    const V z = hn::Sub(hn::Load(d, block.z + lane), hn::Set(d, s.z));
    return hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
}

HWY_INLINE FloatSphere Moved(const FloatPose& pose, const FloatSphere& s)
{
    const auto& m = pose.rotation;
    const auto& t = pose.translation;
    return {(m[0] * s.x + m[1] * s.y) + (m[2] * s.z + t[0]),
        (m[3] * s.x + m[4] * s.y) + (m[5] * s.z + t[1]),
        (m[6] * s.x + m[7] * s.y) + (m[8] * s.z + t[2]), s.r};
}

/// PairFrame::gap(), once more, so that it comes to stand within the loops.
HWY_INLINE double Gap(const PairFrame& frame, const FloatSphere& ofA, const FloatSphere& ofB)
{
    const auto& m = frame.pose.rotation();
    const auto& t = frame.pose.translation();
    double distSq = 0;
    for (int i = 0; i < 3; ++i) {
        const double center = i == 0 ? ofA.x : i == 1 ? ofA.y : ofA.z;
        const double d = (m(i, 0) * ofB.x + m(i, 1) * ofB.y + m(i, 2) * ofB.z + t[i]) - center;
        distSq += d * d;
    }
    return std::sqrt(distSq) - ofA.r - ofB.r;
}

/// A place is kBlockWidth * block + lane; or this, of the sphere above all.
constexpr int32_t kRootPlace = -1;

struct Node {
    FloatSphere sphere;
    int32_t child; ///< as in a block
};

HWY_INLINE Node NodeAt(const SphereBlocks& blocks, int32_t place)
{
    if (place == kRootPlace) return {blocks.root, 0};
    const SphereBlock& block = blocks.blocks.data()[uint32_t(place) / kBlockWidth];
    const uint32_t lane = uint32_t(place) % kBlockWidth;
    return {{block.x[lane], block.y[lane], block.z[lane], block.r[lane]}, block.child[lane]};
}

/// A pair that waits on the stack.
struct Pair {
    int32_t a, b; ///< places
};

/// A block that is tested next, and the sphere of the other body in its frame.
struct Opened {
    const SphereBlock* block;
    int32_t place; ///< of lane 0
    FloatSphere other;
    FloatSphere own;    ///< the same in its own frame
    int32_t otherChild; ///< negative: a leaf
    bool isOfA;         ///< the block

    bool areLeaves(int lane) const { return otherChild < 0 && block->child[lane] < 0; }
    /// The leaves of such a pair.
    int32_t leafA(int lane) const { return ~(isOfA ? block->child[lane] : otherChild); }
    int32_t leafB(int lane) const { return ~(isOfA ? otherChild : block->child[lane]); }
    Pair below(const Pair& pair, int lane) const
    {
        return isOfA ? Pair{place + lane, pair.b} : Pair{pair.a, place + lane};
    }
};

/// Opens the larger sphere of a pair that is not two leaves.
HWY_INLINE Opened Open(const PairFrame& frame, const Pair& pair)
{
    const Node a = NodeAt(*frame.a, pair.a), b = NodeAt(*frame.b, pair.b);
    const bool opensA = b.child < 0 || (a.child >= 0 && a.sphere.r >= b.sphere.r);
    Opened opened;
    opened.isOfA = opensA;
    const int32_t number = opensA ? a.child : b.child;
    opened.block = (opensA ? frame.a : frame.b)->blocks.data() + number;
    opened.place = kBlockWidth * number;
    opened.other = Moved(opensA ? frame.toA : frame.toB, opensA ? b.sphere : a.sphere);
    opened.own = opensA ? b.sphere : a.sphere;
    opened.otherChild = opensA ? b.child : a.child;
    return opened;
}

/// The gap of the lane's sphere and the other one, in doubles.
HWY_INLINE double GapOf(const PairFrame& frame, const Opened& opened, int lane)
{
    const FloatSphere here = opened.block->sphere(lane);
    return opened.isOfA ? Gap(frame, here, opened.own) : Gap(frame, opened.own, here);
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
