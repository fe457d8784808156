// SPDX-License-Identifier: Apache-2.0
/// @file PointQuery.h
/// @brief Questions of points to a tree: how far is the nearest leaf sphere, which is it, and does
/// a ball meet any.
///
///     const PointDistance found = nearest(tree, point, 5.0);
///     if (found) push(found.distance, found.gradient);
///
/// Let L be the union of the leaf spheres, O the object's voxel cubes (QueryTree.h). For a point
/// outside of the leaf spheres
///
///     d(point, L) - rounding <= distance <= d(point, O)     where holdsObject()
///     d(point, L) - rounding <= distance <= d(point, L)     where holdsLeaves()
///
/// Rounding is 2^-20 of the point's distance to the middle of the tree plus the tree's size, and
/// 2^-17 of it beyond 512 times that size. Points in a cube of O have a distance of 0 or less.
/// Within L the distance is |point - center| - radius of a leaf sphere that holds the point: where
/// holdsLeaves() of the one it is deepest in. That is never deeper than the point is in L, and not
/// how far it must move to get out.
///
/// Why: if the nearest point q of O lies in a cube, all spheres of that cube's chain hold q, so
/// their distance is at most |point - q|. What is left out is no nearer than what was found. So
/// either the chain's leaf is found, or something as near.
///
/// The distance to O is also at most that to the leaf found, shrunk by leafInset(), which lies in
/// O; and its own distance, 0 at least, plus leafReach(): `objectUpper`.
///
/// All answers are the same on every machine, and for any number of threads that ask. Nothing is
/// allocated. Tests: TestPointQuery.cc.

#pragma once

#include "QueryTree.h"

#include <openvdb/math/Vec3.h>

#include <cstdint>
#include <limits>

namespace openvdb_spheretree {

/// The leaf sphere nearest to a point. Without one, false.
struct PointDistance {
    /// Signed, world units: negative inside. The cut-off, if nothing is nearer.
    double distance = std::numeric_limits<double>::infinity();
    /// In which direction the distance grows fastest: of length 1, away from the leaf's center. It
    /// jumps where another leaf becomes the nearest. 0 at a center, and without a leaf.
    openvdb::Vec3d gradient = openvdb::Vec3d(0.0);
    /// @name The distance to the object's voxel cubes is between these: 0 of points in it
    /// By the leaf that was found: `objectUpper` is infinity without one, and where leaves are not known to be near
    /// the object (QueryTree::leafReach(), leafInset()).
    /// @{
    double objectLower = 0;
    double objectUpper = std::numeric_limits<double>::infinity();
    /// @}
    int32_t leaf = -1;  ///< QueryTree::nodeId() is its id in the sphere-tree
    int32_t blocks = 0; ///< that were tested: the same on every machine

    explicit operator bool() const { return leaf >= 0; }
};

/// @brief The leaf sphere nearest to a point, or deepest around it.
/// @param point   in the world of the tree
/// @param cutoff  world units, not negative: what is farther away is not looked for, which takes a
///        fraction of the time. Anything of O no farther than it is found.
/// @throw openvdb::ValueError for a point that is not finite, and a cut-off below 0 or NaN
/// @note Cost: O(log leaves), 0.1 to 0.5 microseconds. Thread-safe.
PointDistance nearest(const QueryTree& tree, const openvdb::Vec3d& point,
    double cutoff = std::numeric_limits<double>::infinity());

/// @return whether a ball meets the leaf spheres: never false where it meets O (with holdsLeaves(),
///        L); never true where it is farther from L than rounding is off.
/// @param radius  world units, not negative; 0 asks for a point
/// @throw openvdb::ValueError for a point or radius that is not finite, and a radius below 0
/// @note Cost: O(log leaves), a third of nearest(). Thread-safe.
bool meetsBall(const QueryTree& tree, const openvdb::Vec3d& center, double radius);

} // namespace openvdb_spheretree
