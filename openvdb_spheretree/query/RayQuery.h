// SPDX-License-Identifier: Apache-2.0
/// @file RayQuery.h
/// @brief Questions of rays to a tree: which leaf sphere is entered first and where, and is there
/// any; for one ray, or for many in parallel.
///
///     QueryRay ray{eye, towards};
///     if (const RayHit hit = intersect(tree, ray)) draw(ray.at(hit.t));
///
/// A tree is solid: a ray that starts in a leaf sphere hits it at its start. Let t_L be where the
/// ray enters L, the union of the leaf spheres, and t_O the same of the object's voxel cubes O
/// (QueryTree.h). Then
///
///     t_L - rounding <= t <= t_O     where holdsObject()
///     t_L - rounding <= t <= t_L     where holdsLeaves()
///
/// A ray that meets O never misses; one that misses L by more than rounding does. Rounding is that
/// spheres are larger by up to 2^-18 of the tree's size; a sphere of radius r that a ray grazes may
/// be entered sqrt(2 r rounding) too soon.
///
/// Why: all spheres of a cube's chain hold the point where the ray enters that cube, so none is
/// entered later. What is left out is entered no sooner than what was found.
///
/// Answers are the same on every machine, and for any number of threads. Nothing is allocated for a
/// ray. Tests: TestRayQuery.cc.

#pragma once

#include "QueryTree.h"

#include <openvdb/math/Vec3.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstddef>
#include <cstdint>
#include <limits>

namespace openvdb_spheretree {

/// The points origin + t direction, for t from tNear to tFar. Without any where tNear > tFar.
struct QueryRay {
    openvdb::Vec3d origin;    ///< in the world of the tree
    openvdb::Vec3d direction; ///< of any length; t counts by it
    double tNear = 0, tFar = std::numeric_limits<double>::infinity();
    /// Leaf spheres that hold the start do not count, as where rays leave a surface: these spheres
    /// are the surface, padded. Then a ray may miss what lies in such a sphere.
    bool leavesStart = false;

    openvdb::Vec3d at(double t) const { return origin + t * direction; }
};

/// The leaf sphere that a ray enters first. Without one, false.
struct RayHit {
    double t = std::numeric_limits<double>::infinity(); ///< tNear if the ray starts inside
    /// QueryTree::nodeId() is its id in the sphere-tree. The normal there points away from
    /// QueryTree::leafCenter().
    int32_t leaf = -1;
    int32_t blocks = 0; ///< that were tested: the same on every machine

    explicit operator bool() const { return leaf >= 0; }
};

/// @return the leaf sphere that a ray enters first.
/// @throw openvdb::ValueError for an origin that is not finite, or further from the tree than 2^26
///        times its size; for a direction without length or not finite, or so short that t is beyond
///        doubles; for a tNear or tFar that is NaN, or an infinite tNear
/// @note Cost: O(log leaves) for most rays, 0.1 to 0.4 microseconds. Thread-safe.
RayHit intersect(const QueryTree& tree, const QueryRay& ray);

/// @return whether a ray meets any leaf sphere: the same as whether intersect() finds one, in less
///        time.
/// @throw openvdb::ValueError as intersect()
bool occluded(const QueryTree& tree, const QueryRay& ray);

/// @name Many rays, in parallel
/// The answers are those of single rays.
/// @{

/// @param hits         receives one for each ray
/// @param interrupter  may be null
/// @throw openvdb::ValueError as intersect(), naming the ray
/// @throw Interrupted
void intersect(const QueryTree& tree, const QueryRay* rays, std::size_t count, RayHit* hits,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @param blocked  receives 1 or 0 for each ray
void occluded(const QueryTree& tree, const QueryRay* rays, std::size_t count, uint8_t* blocked,
    openvdb::util::NullInterrupter* interrupter = nullptr);
/// @}

} // namespace openvdb_spheretree
