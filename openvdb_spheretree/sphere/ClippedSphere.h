// SPDX-License-Identifier: Apache-2.0
/// @file ClippedSphere.h
/// @brief Integer arithmetic on closed spheres that never overflows: the box of their voxels, what lies
/// inside, and the rows of voxels along z.
///
/// Everything is in units of half a voxel or less, so that centers between voxels are integers:
/// 2^shift units are a voxel. A sphere may be one of a norm: all distances grow with each
/// coordinate, so the nearest (farthest) voxel of a box is the nearest (farthest) along every axis.

#pragma once

#include "SphereUnion.h"

#include <algorithm>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// @return the shift of a metric: its subdivision's logarithm.
/// @throw openvdb::ValueError if the subdivision is no power of two in range
inline int shiftOf(const SphereMetric& metric)
{
    for (int shift = 1; 1 << shift <= SphereMetric::kMaxSubdivision; ++shift) {
        if (metric.subdivision == 1 << shift) return shift;
    }
    OPENVDB_THROW(openvdb::ValueError,
        "spheres in units of 1/" << metric.subdivision
                                 << " voxel: the subdivision must be a power of two from 2 to "
                                 << SphereMetric::kMaxSubdivision);
}

/// @return a coordinate of voxels in units.
inline int64_t inUnits(int64_t voxels, int shift) { return voxels * (int64_t(1) << shift); }

/// Integers q with |2^shift q - center| <= reach, as a closed interval (empty: lo > hi).
struct Interval {
    int64_t lo, hi;
    Interval(int64_t center, int64_t reach, int shift)
        : lo((center - reach + inUnits(1, shift) - 1) >> shift), hi((center + reach) >> shift)
    {}
};

/// @return how far @a center is from the nearest voxel.
inline int64_t offVoxel(int64_t center, int shift)
{
    const int64_t above = center & (inUnits(1, shift) - 1);
    return std::min(above, inUnits(1, shift) - above);
}

/// @return the first and the last coordinate along @a axis of the voxels in the sphere; empty if
///         there
/// are none. Exact: along the other two axes no voxel is nearer to the center than offVoxel().
inline Interval extent(const ExactSphere& s, int axis, const Distance& distance, int shift)
{
    const int64_t reach = distance.reach(offVoxel(s.center[(axis + 1) % 3], shift),
        offVoxel(s.center[(axis + 2) % 3], shift), s.radiusSq);
    return Interval(reach < 0 ? 1 : s.center[axis], reach, reach < 0 ? 1 : shift);
}

/// A sphere to be drawn: with the box of its voxels, already clipped.
struct ClippedSphere {
    int64_t center[3];
    int64_t radiusSq;
    Distance distance;
    int32_t lo[3], hi[3]; ///< inclusive
    bool clipped;         ///< the box is smaller than the sphere's own
    bool plain;           ///< Euclidean, and small enough that squares near its box do not overflow
    int8_t shift;         ///< 2^shift units of center and radiusSq are a voxel

    /// Spheres of this size and less are plain: their radius is at most 2^29 units. holds() is
    /// called for voxels of cubes that meet the sphere's box, at most 4096 voxels or 2^22 units
    /// wide. They are less than 2^29 + 2^22 units from the center along an axis: three squares are
    /// below 2^60.
    static constexpr int64_t kMaxPlainRadiusSq = int64_t(1) << 58;
    /// Lengths that do not fit 63 bits are INT64_MAX (Distance::lengthSq): no sphere holds them.
    static constexpr int64_t kMaxRadiusSq = INT64_MAX - 1;

    /// @param d  from the center, in units; no farther than the corners of a cube that meets the
    ///           box
    bool holds(const int64_t d[3]) const
    {
        if (plain) return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= radiusSq;
        return distance.lengthSq(d[0], d[1], d[2]) <= radiusSq;
    }

    /// Along an axis: how far the nearest and the farthest of the voxels first...last are from the
    /// center, and whether they are in the box.
    int64_t nearest(int axis, int32_t first, int32_t last) const
    {
        const int64_t from = inUnits(first, shift), to = inUnits(last, shift);
        return std::max(from, std::min(center[axis], to)) - center[axis];
    }
    int64_t farthest(int axis, int32_t first, int32_t last) const
    {
        const int64_t below = center[axis] - inUnits(first, shift);
        return std::max(below, inUnits(last, shift) - center[axis]);
    }
    bool isInBox(int axis, int32_t first, int32_t last) const
    {
        return first >= lo[axis] && last <= hi[axis];
    }

    /// @return whether the sphere comes as near as a voxel of the box first...last, which its own
    /// box must meet; the clip aside.
    bool touches(const int32_t first[3], const int32_t last[3]) const
    {
        int64_t d[3];
        for (int a = 0; a < 3; ++a) d[a] = nearest(a, first[a], last[a]);
        return holds(d);
    }

    /// @return whether every voxel of the box is in the sphere and in the clip.
    bool contains(const int32_t first[3], const int32_t last[3]) const
    {
        int64_t d[3];
        for (int a = 0; a < 3; ++a) {
            if (!isInBox(a, first[a], last[a])) return false;
            d[a] = farthest(a, first[a], last[a]);
        }
        return holds(d);
    }
};

/// @param shift  that of the metric
/// @return false if the clipped sphere is empty (or certainly holds no voxel).
inline bool clipSphere(const ExactSphere& s, const Distance& distance, int shift,
    const openvdb::CoordBBox& clip, ClippedSphere& ball)
{
    ball.distance = distance;
    ball.shift = int8_t(shift);
    ball.clipped = false;
    for (int a = 0; a < 3; ++a) {
        const Interval range = extent(s, a, distance, shift);
        const int64_t lo = std::max<int64_t>(range.lo, clip.min()[a]);
        const int64_t hi = std::min<int64_t>(range.hi, clip.max()[a]);
        if (lo > hi) return false;
        ball.lo[a] = int32_t(lo);
        ball.hi[a] = int32_t(hi);
        ball.center[a] = s.center[a];
        ball.clipped = ball.clipped || lo != range.lo || hi != range.hi;
    }
    ball.plain = distance.isEuclidean() && s.radiusSq <= ClippedSphere::kMaxPlainRadiusSq;
    ball.radiusSq = std::min(s.radiusSq, ClippedSphere::kMaxRadiusSq);
    return true;
}

/// Calls f(x, y, lo, hi) for the rows of a sphere, and of its clip, in the cube of @a size voxels
/// at
/// @a origin: voxels (x, y, lo...hi), counted from the cube's corner. Rows may be empty (lo > hi).
/// The sphere's box must meet the cube.
template <typename F>
void forEachRow(const ClippedSphere& sphere, const openvdb::Coord& origin, int32_t size, const F& f)
{
    int32_t first[3], last[3]; // of the sphere's box in the cube
    int64_t center[3];
    for (int a = 0; a < 3; ++a) {
        first[a] = std::max(sphere.lo[a], origin[a]) - origin[a];
        last[a] = std::min(sphere.hi[a], origin[a] + (size - 1)) - origin[a];
        center[a] = sphere.center[a] - inUnits(origin[a], sphere.shift);
    }
    const int64_t voxel = inUnits(1, sphere.shift);
    int64_t dx = inUnits(first[0], sphere.shift) - center[0];
    for (int32_t x = first[0]; x <= last[0]; ++x, dx += voxel) {
        int64_t dy = inUnits(first[1], sphere.shift) - center[1];
        for (int32_t y = first[1]; y <= last[1]; ++y, dy += voxel) {
            const int64_t reach = sphere.distance.reach(dx, dy, sphere.radiusSq);
            if (reach < 0) continue;
            const Interval run(center[2], reach, sphere.shift);
            f(x, y, int32_t(std::max<int64_t>(run.lo, first[2])),
                int32_t(std::min<int64_t>(run.hi, last[2])));
        }
    }
}

/// @return the bits of lo...hi, which are in order, of a row of eight.
inline uint64_t rowBits(int32_t lo, int32_t hi) { return (0xffu >> (7 - hi)) & (0xffu << lo); }

} // namespace openvdb_spheretree::detail
