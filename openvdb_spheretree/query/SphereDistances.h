// SPDX-License-Identifier: Apache-2.0
/// @file SphereDistances.h
/// @brief Batches of spheres against a tree, as planners of motion ask them: a robot is some
/// spheres, and each configuration of it puts them elsewhere. Distances with gradients, or just
/// whether a configuration touches.
///
/// Spheres are flat arrays of floats x, y, z, radius, in world units: (batch, horizon, n, 4) in the
/// order of C, as cuRobo has them. So are the results: (batch, horizon, n), gradients (batch,
/// horizon, n, 3). A sphere whose radius is negative is switched off: it is nowhere, and touches
/// nothing.
///
/// What is certain is as for points (PointQuery.h): a distance is never larger than that of the
/// sphere to the object's voxel cubes, and no sphere that meets one is ever said to be free.
///
/// Work is done in parallel; the results are the same for any number of threads, and on every
/// machine. No memory is allocated for a sphere. Tests: TestSphereDistances.cc.

#pragma once

#include "QueryTree.h"

#include <openvdb/util/NullInterrupter.h>

#include <cstddef>
#include <cstdint>

namespace openvdb_spheretree {

/// Where results go: owned by the caller, and null where they are not wanted.
struct SphereDistanceArrays {
    /// One a sphere: signed, rounded down to a float. At most the activation distance, which is
    /// also that of spheres that are switched off.
    float* distance = nullptr;
    /// Three a sphere: in which direction the distance grows fastest, of length 1; 0 without a
    /// leaf. It jumps where another leaf becomes the nearest.
    float* gradient = nullptr;
    /// One a sphere: the nearest leaf; -1 where none is within the activation distance.
    int32_t* leaf = nullptr;
};

/// @brief The signed distance of every sphere to the leaf spheres.
/// @param spheres     4 count floats, as above
/// @param activation  world units, 0 or more; what is farther away is not looked for
/// @param interrupter may be null
/// @throw openvdb::ValueError for numbers that are not finite, naming the sphere, and for an
///        activation below 0 or NaN
/// @throw Interrupted; then the results are undefined
/// @note Cost: 15 to 30 nanoseconds a sphere, where a tenth of them are active.
void sphereDistances(const QueryTree& tree, const float* spheres, std::size_t count,
    float activation, const SphereDistanceArrays& results,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief Whether any sphere of a configuration meets a leaf sphere; ends at the first that does. One within rounding of contact
/// (2^-18 of the tree's size) may have a distance of 0 or less above, and touch nothing here, or the other way round.
/// @param spheres   4 configurations * perConfiguration floats
/// @param touching  receives 1 or 0 for each configuration
/// @throw openvdb::ValueError for numbers that are not finite, naming the sphere, of all that are
///        looked at
/// @throw Interrupted; then the results are undefined
/// @note Cost: 0.4 microseconds for a configuration of 64 spheres, most of them far away.
void spheresTouch(const QueryTree& tree, const float* spheres, std::size_t configurations,
    std::size_t perConfiguration, uint8_t* touching,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
