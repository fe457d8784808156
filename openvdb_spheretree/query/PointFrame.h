// SPDX-License-Identifier: Apache-2.0
/// @file PointFrame.h
/// @brief Points of the world as kernels take them: floats about the origin of the blocks, and how
/// far rounding may be off.
///
/// *Rounding.* Let e = 2^-24, p the point, E the extent of the blocks. Its coordinates are off by e
/// |p| each, differences by e (|p| + E) each, and three squares, their sums, the root and the
/// difference with the radius by less than 5 e (|p| + E) together: a kernel's |p - c| - r is off by
/// less than 8 e (|p| + E), the `slack`.
///
/// *Points far away.* Floats that hold |p| hold no E. Such a point is moved straight towards the
/// origin, to a distance s, and |p - c| falls by |p| - s nearly: for |c| <= E, by less than E^2 / s
/// less. So what is nearest to the moved point is nearest to the point itself, but for this.

#pragma once

#include "QueryData.h"

#include <openvdb/math/Vec3.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace openvdb_spheretree::detail {

constexpr double kFloatError = 0x1p-24; ///< of one operation, relative
/// Kernels look no further: beyond are the empty lanes (kEmptyLane).
constexpr float kFarthestKey = 5e14f;

struct LocalPoint {
    LocalPoint(const QueryData& tree, const openvdb::Vec3d& world) : at(world - tree.origin)
    {
        const double extent = tree.spheres.extent, length = at.length();
        const double farthest = std::min(512 * extent, 2e14);
        openvdb::Vec3d moved = at;
        if (length > farthest) {
            moved *= farthest / length;
            towards = length - farthest;
            bent = 1.01 * extent * extent / farthest;
        }
        x = float(moved[0]), y = float(moved[1]), z = float(moved[2]);
        slack = 8 * kFloatError * (std::min(length, farthest) + extent);
    }

    /// @return what a kernel's key must be below, of a leaf no farther than @a distance from the
    ///        point.
    float limit(double distance) const
    {
        const double key = distance - towards + 1.001 * (slack + bent);
        return key < kFarthestKey ? std::nextafter(float(key), kFarthestKey) : kFarthestKey;
    }

    openvdb::Vec3d at; ///< exactly where the point is, but for doubles
    float x, y, z;
    double towards = 0; ///< how far a point far away was moved
    double slack;       ///< of keys, for rounding
    double bent = 0;    ///< of keys, for having been moved
};

/// Of a leaf that a kernel found to be the nearest.
struct LeafDistance {
    LeafDistance(const QueryData& tree, const LocalPoint& point, int32_t number)
    {
        const FloatSphere leaf = tree.spheres.leaf(number);
        const openvdb::Vec3d away = point.at - openvdb::Vec3d(leaf.x, leaf.y, leaf.z);
        const double length = away.length();
        // Another may be nearer, by the rounding of both keys at most.
        distance = length - leaf.r - 2 * (point.slack + point.bent);
        if (length > 0) gradient = away / length;
    }

    double distance; ///< never more than that of any leaf
    openvdb::Vec3d gradient = openvdb::Vec3d(0.0);
};

} // namespace openvdb_spheretree::detail
