// SPDX-License-Identifier: Apache-2.0
/// @file BodyDistance.h
/// @brief How far two bodies are apart, and where they are nearest.
///
///     const DistanceResult near = distance(a, poseA, b, poseB);
///     near.distance; near.contact->pointA; near.contact->pointB;
///
/// Names are those of FCL and Coal where the meaning is the same. Of the distance of the unions of leaf spheres, L, and that of the
/// objects, O: where both trees hold their leaves, `distance` is that of L; where they hold their objects,
/// it is at least that of L, and at most that of O (docs/queries.md). So objects are as far apart as it says, or
/// farther, by `objectsUpper` at most.
///
/// Nothing is allocated. Results are the same on every instruction set, and calls are thread-safe. Tests:
/// TestBodyDistance.cc, against all pairs of leaves.

#pragma once

#include "Contact.h"
#include "QueryTree.h"
#include "RigidTransform.h"

#include <cstdint>
#include <limits>
#include <optional>

namespace openvdb_spheretree {

struct DistanceRequest {
    /// Bodies that meet have the negative depth of their deepest pair of leaf spheres, not 0. That is a measure of
    /// penetration with a gradient, and not how far they must move to part.
    bool enableSignedDistance = false;
    /// `distance` may be too large by this part of it, or by this much in world units: 0 or more.
    double relErr = 0, absErr = 0;
    /// Bodies as far apart as this, or farther, are not of interest: nothing is found then.
    double upperBound = std::numeric_limits<double>::infinity();
    /// Any pair this near is enough: world units. Without signs it is 0 at least.
    double stopBelow = -std::numeric_limits<double>::infinity();
    /// No more blocks than this are tested; the bounds are then wider. -1: any number.
    int64_t maxBlocks = -1;
    /// The nearest pair a moment ago: halves the time, or better. Of trees that do not hold their leaves it may be one beside the
    /// objects, nearer than any that is found without.
    NodePair warmStart;
};

struct DistanceResult {
    /// The nearest pair of leaf spheres that was found; none within upperBound: empty.
    std::optional<Contact> contact;
    /// Of that pair, 0 where spheres meet unless signs were asked for; infinity if there is none.
    double distance = std::numeric_limits<double>::infinity();
    /// The signed or unsigned distance of the nearest pair is no less than this: the same as `distance`, unless an error
    /// was allowed, or upperBound, stopBelow or maxBlocks ended the search.
    double lowerBound = 0;
    /// @name That of the objects' voxel cubes is between these
    /// @{
    double objectsLower = 0;
    double objectsUpper = std::numeric_limits<double>::infinity();
    /// @}
    bool isDecided = true; ///< false: maxBlocks came to an end
    int64_t blocks = 0;    ///< tested; the same on every machine
};

/// @throw openvdb::ValueError for errors below 0, bounds that are no numbers, or bodies more than 10^13 world units
///        apart
/// @throw openvdb::LookupError if one of the nodes of warmStart is no leaf
DistanceResult distance(const QueryTree& a, const RigidTransform& poseA, const QueryTree& b,
    const RigidTransform& poseB, const DistanceRequest& request = {});

} // namespace openvdb_spheretree
