// SPDX-License-Identifier: Apache-2.0
#include "RayKernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/query/RayKernel.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "NearestFirst-inl.h"

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

/// A ray, and where it enters the spheres of a block.
struct RayLanes {
    explicit RayLanes(const RayQuestion& r)
        : x(hn::Set(D(), r.origin[0])), y(hn::Set(D(), r.origin[1])), z(hn::Set(D(), r.origin[2])),
          ux(hn::Set(D(), r.direction[0])), uy(hn::Set(D(), r.direction[1])),
          uz(hn::Set(D(), r.direction[2])), ray(r)
    {}

    /// A sphere counts if it holds the point nearest to its center of the ray as far as `best`:
    /// that needs no root, which is for keys alone, so the next block is known sooner. How far a
    /// center is aside of the line comes from the cross product with the direction: nothing
    /// cancels, and it waits for nothing else. (As center - (center . u) u, and with roots, rays
    /// take 15 to 25 % longer.)
    HWY_INLINE uint32_t lanes(const SphereBlock& block, float best, float* key) const
    {
        const D d;
        uint32_t met = 0;
        for (std::size_t i = 0; i < kBlockWidth; i += hn::Lanes(d)) {
            const V cx = hn::Sub(hn::Load(d, block.x + i), x);
            const V cy = hn::Sub(hn::Load(d, block.y + i), y);
            const V cz = hn::Sub(hn::Load(d, block.z + i), z);
            const V r = hn::Add(hn::Load(d, block.r + i), hn::Set(d, ray.slack));
            const V along = sumOfProducts(cx, ux, cy, uy, cz, uz);
            const V ax = hn::Sub(hn::Mul(cy, uz), hn::Mul(cz, uy));
            const V ay = hn::Sub(hn::Mul(cz, ux), hn::Mul(cx, uz));
            const V az = hn::Sub(hn::Mul(cx, uy), hn::Mul(cy, ux));
            const V halfSq = hn::Sub(hn::Mul(r, r), sumOfProducts(ax, ax, ay, ay, az, az));
            // Of a sphere that the line misses the root is NaN, and not looked at.
            hn::Store(hn::Sub(along, hn::Sqrt(halfSq)), d, key + i);
            const V before = hn::Sub(hn::Set(d, ray.near), along);
            const V beyond = hn::Sub(along, hn::Set(d, best));
            const V outside = hn::Max(hn::Max(before, beyond), hn::Zero(d));
            met |= Bits(hn::Le(hn::Mul(outside, outside), halfSq)) << i;
        }
        return met;
    }

    bool accept(int32_t, float key) const { return !(ray.leavesStart && key < ray.near); }
    bool isEnough(float key) const { return ray.anyHit || key <= ray.near; }

    V x, y, z, ux, uy, uz;
    const RayQuestion& ray;
};

BlockHit FirstLeaf(const SphereBlocks& tree, const RayQuestion& ray)
{
    return nearestFirst(tree.blocks.data(), RayLanes(ray), ray.far);
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::detail {

HWY_EXPORT(FirstLeaf);

BlockHit firstLeaf(const SphereBlocks& tree, const RayQuestion& ray)
{
    return HWY_DYNAMIC_DISPATCH(FirstLeaf)(tree, ray);
}

} // namespace openvdb_spheretree::detail
#endif
