// SPDX-License-Identifier: Apache-2.0
#include "PointKernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/query/PointKernel.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "NearestFirst-inl.h"

#include <algorithm>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

uint32_t SpheresWithin(const BallAround& around, const float* spheres, std::size_t count)
{
    const D d;
    const V infinity = hn::Set(d, std::numeric_limits<float>::infinity()), zero = hn::Zero(d);
    // A square of a distance in floats is off by five parts in 2^24, that of a reach by three.
    const V more = hn::Set(d, 1 + 0x1p-20f);
    uint32_t within = 0;
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const std::size_t left = count - i;
        float last[4 * kBlockWidth] = {};
        const bool isWhole = left >= hn::Lanes(d);
        if (!isWhole) std::copy_n(spheres + 4 * i, 4 * left, last);
        V x, y, z, r;
        hn::LoadInterleaved4(d, isWhole ? spheres + 4 * i : last, x, y, z, r);
        const V dx = hn::Sub(x, hn::Set(d, around.x)), dy = hn::Sub(y, hn::Set(d, around.y)),
                dz = hn::Sub(z, hn::Set(d, around.z));
        const V distSq = sumOfProducts(dx, dx, dy, dy, dz, dz);
        const V reach = hn::Mul(hn::Add(r, hn::Set(d, around.reach)), more);
        const auto isFar = hn::Gt(distSq, hn::Mul(reach, reach));
        const auto isOff = hn::And(hn::Lt(r, zero), hn::Gt(r, hn::Neg(infinity)));
        // Comparisons with NaN are false, so what is NaN or infinite counts as within.
        const auto isOut = hn::And(hn::Or(isFar, isOff), hn::Lt(distSq, infinity));
        within |= Bits(hn::Not(isOut)) << i;
    }
    return count == kMostFiltered ? within : within & ((uint32_t(1) << count) - 1);
}

/// A point, and how far the spheres of a block are from it.
struct PointLanes {
    PointLanes(float atX, float atY, float atZ)
        : x(hn::Set(D(), atX)), y(hn::Set(D(), atY)), z(hn::Set(D(), atZ))
    {}

    HWY_INLINE uint32_t lanes(const SphereBlock& block, float best, float* key) const
    {
        const D d;
        uint32_t nearer = 0;
        for (std::size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
            const V dx = hn::Sub(hn::Load(d, block.x + i), x);
            const V dy = hn::Sub(hn::Load(d, block.y + i), y);
            const V dz = hn::Sub(hn::Load(d, block.z + i), z);
            const V distSq = sumOfProducts(dx, dx, dy, dy, dz, dz);
            const V distance = hn::Sub(hn::Sqrt(distSq), hn::Load(d, block.r + i));
            hn::Store(distance, d, key + i);
            nearer |= Bits(hn::Lt(distance, hn::Set(d, best))) << i;
        }
        return nearer;
    }

    V x, y, z;
};

/// The nearest of all leaves.
struct NearestLeaf : PointLanes {
    using PointLanes::PointLanes;
    bool accept(int32_t, float) const { return true; }
    bool isEnough(float) const { return false; }
};

/// Any leaf nearer than the limit.
struct AnyLeaf : PointLanes {
    using PointLanes::PointLanes;
    bool accept(int32_t, float) const { return true; }
    bool isEnough(float) const { return true; }
};

/// Any leaf nearer than the limit whose digital ball holds a voxel: by integers, exactly.
struct HoldingLeaf : PointLanes {
    HoldingLeaf(const FloatSphere& ball, const MedialBall* leaves, const openvdb::Coord& voxel)
        : PointLanes(ball.x, ball.y, ball.z), digital(leaves), q(voxel)
    {}
    bool accept(int32_t leaf, float) const
    {
        const MedialBall& ball = digital[leaf];
        const int64_t dx = int64_t(q[0]) - ball.center[0], dy = int64_t(q[1]) - ball.center[1],
                      dz = int64_t(q[2]) - ball.center[2];
        return dx * dx + dy * dy + dz * dz < ball.radiusSq;
    }
    bool isEnough(float) const { return true; }

    const MedialBall* digital;
    openvdb::Coord q;
};

void NearestLeaves(
    const SphereBlocks& tree, const PointQuestion* points, std::size_t count, BlockHit* hits)
{
    const SphereBlock* const blocks = tree.blocks.data();
    for (std::size_t i = 0; i < count; ++i) {
        const PointQuestion& p = points[i];
        hits[i] = nearestFirst(blocks, NearestLeaf(p.x, p.y, p.z), p.limit);
    }
}

std::size_t FirstBallThatMeets(
    const SphereBlocks& tree, const FloatSphere* balls, std::size_t count, int64_t& tested)
{
    const SphereBlock* const blocks = tree.blocks.data();
    for (std::size_t i = 0; i < count; ++i) {
        const FloatSphere& ball = balls[i];
        const BlockHit hit = nearestFirst(blocks, AnyLeaf(ball.x, ball.y, ball.z), ball.r);
        tested += hit.blocks;
        if (hit.leaf >= 0) return i;
    }
    return count;
}

bool IsInDigitalBall(const SphereBlocks& tree, const FloatSphere& ball, const MedialBall* leaves,
    const openvdb::Coord& q)
{
    return nearestFirst(tree.blocks.data(), HoldingLeaf(ball, leaves, q), ball.r).leaf >= 0;
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::detail {

HWY_EXPORT(SpheresWithin);
HWY_EXPORT(NearestLeaves);
HWY_EXPORT(FirstBallThatMeets);
HWY_EXPORT(IsInDigitalBall);

uint32_t spheresWithin(const BallAround& around, const float* spheres, std::size_t count)
{
    return HWY_DYNAMIC_DISPATCH(SpheresWithin)(around, spheres, count);
}

void nearestLeaves(
    const SphereBlocks& tree, const PointQuestion* points, std::size_t count, BlockHit* hits)
{
    HWY_DYNAMIC_DISPATCH(NearestLeaves)(tree, points, count, hits);
}

std::size_t firstBallThatMeets(
    const SphereBlocks& tree, const FloatSphere* balls, std::size_t count, int64_t& blocks)
{
    return HWY_DYNAMIC_DISPATCH(FirstBallThatMeets)(tree, balls, count, blocks);
}

bool isInDigitalBall(const SphereBlocks& tree, const FloatSphere& ball, const MedialBall* leaves,
    const openvdb::Coord& q)
{
    return HWY_DYNAMIC_DISPATCH(IsInDigitalBall)(tree, ball, leaves, q);
}

} // namespace openvdb_spheretree::detail
#endif
