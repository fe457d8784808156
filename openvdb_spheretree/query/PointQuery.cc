// SPDX-License-Identifier: Apache-2.0
#include "PointQuery.h"

#include "PointFrame.h"
#include "PointKernel.h"
#include "QueryData.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {
namespace {

using detail::LocalPoint;
using openvdb::Vec3d;

/// Lengths are doubles.
void requireFinite(const Vec3d& point)
{
    if (std::isfinite(point.lengthSqr())) return;
    OPENVDB_THROW(openvdb::ValueError,
        "no question can be asked of the point "
            << point << ": its coordinates must be finite, and their squares, too");
}

/// What the distance to the object is at most, by a leaf.
double objectUpper(const QueryTree& tree, const Vec3d& point, int32_t leaf)
{
    const detail::QueryData& data = tree.data();
    const detail::FloatSphere sphere = data.spheres.leaf(leaf);
    const Vec3d away = point - data.origin - Vec3d(sphere.x, sphere.y, sphere.z);
    const double length = away.length();
    // Of a leaf that shrinks to less than nothing the center is left.
    const double byInset = length - std::max(0.0, sphere.r - tree.leafInset());
    const double byReach = std::max(0.0, length - sphere.r) + tree.leafReach();
    const double best = std::isfinite(tree.leafInset()) ? std::min(byInset, byReach) : byReach;
    // Floats round centers, by 2^-24 of a coordinate; doubles those of the world, and the few sums above.
    const double rounding = 0x1p-23 * double(data.spheres.extent)
        + 0x1p-49 * (point.length() + data.origin.length() + length);
    return std::max(0.0, best) + rounding;
}

} // namespace

PointDistance nearest(const QueryTree& tree, const Vec3d& point, double cutoff)
{
    requireFinite(point);
    if (!(cutoff >= 0)) {
        OPENVDB_THROW(openvdb::ValueError,
            "cutoff=" << cutoff << " is no distance: it must be 0 or more (infinity: no cut-off)");
    }
    const detail::QueryData& data = tree.data();
    const LocalPoint local(data, point);
    const detail::PointQuestion question{local.x, local.y, local.z, local.limit(cutoff)};
    detail::BlockHit hit;
    detail::nearestLeaves(data.spheres, &question, 1, &hit);
    PointDistance result;
    result.distance = cutoff;
    result.blocks = hit.blocks;
    if (tree.holdsObject()) result.objectLower = cutoff;
    if (hit.leaf < 0) return result;
    const detail::LeafDistance found(data, local, hit.leaf);
    if (found.distance > cutoff) return result;
    result.distance = found.distance;
    if (tree.holdsObject()) result.objectLower = std::max(0.0, found.distance);
    result.objectUpper = objectUpper(tree, point, hit.leaf);
    result.gradient = found.gradient;
    result.leaf = hit.leaf;
    return result;
}

bool meetsBall(const QueryTree& tree, const Vec3d& center, double radius)
{
    requireFinite(center);
    if (!(radius >= 0) || std::isinf(radius)) {
        OPENVDB_THROW(openvdb::ValueError,
            "radius=" << radius << " is no radius: it must be 0 or more, and finite");
    }
    const detail::QueryData& data = tree.data();
    const LocalPoint local(data, center);
    const detail::FloatSphere ball{local.x, local.y, local.z, local.limit(radius)};
    int64_t blocks = 0;
    return detail::firstBallThatMeets(data.spheres, &ball, 1, blocks) == 0;
}

} // namespace openvdb_spheretree
