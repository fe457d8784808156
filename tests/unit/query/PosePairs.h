// SPDX-License-Identifier: Apache-2.0
/// @file PosePairs.h
/// @brief Two of the sample trees in poses near contact, nested, and far, and what is true of them by brute force.

#pragma once

#include "QuerySamples.h"

#include <openvdb_spheretree/query/BodyDistance.h>
#include <openvdb_spheretree/query/Collide.h>

#include <functional>
#include <string>
#include <vector>

namespace spheretree_test {

/// A sample with its tree of queries.
struct QueryBody {
    const QuerySample& sample;
    QueryTree query;
    const SphereTree& tree;
};

struct PosePair {
    const QueryBody& a;
    const QueryBody& b;
    RigidTransform poseA, poseB;

    std::string name() const;
    PosePair swapped() const { return {b, a, poseB, poseA}; }
    PosePair movedBy(const RigidTransform& world) const
    {
        return {a, b, world * poseA, world * poseB};
    }

    openvdb_spheretree::CollisionResult collide(
        const openvdb_spheretree::CollisionRequest& request = {},
        std::vector<openvdb_spheretree::Contact>* contacts = nullptr) const
    {
        return openvdb_spheretree::collide(a.query, poseA, b.query, poseB, request, contacts);
    }
    openvdb_spheretree::CollisionResult collideAll(
        double margin, const openvdb_spheretree::ContactCallback& callback) const
    {
        return openvdb_spheretree::collideAll(a.query, poseA, b.query, poseB, margin, callback);
    }
    openvdb_spheretree::DistanceResult distance(
        const openvdb_spheretree::DistanceRequest& request = {}) const
    {
        return openvdb_spheretree::distance(a.query, poseA, b.query, poseB, request);
    }

    /// @name By stored spheres, all pairs, in doubles
    /// @{
    double smallestGap() const;
    std::vector<double> allGaps() const;
    double gapOf(const openvdb_spheretree::NodePair& nodes) const;
    /// @}
    /// Whether a voxel cube of a meets one of b: by the 15 axes that separate boxes.
    bool cubesMeet() const;
    /// What the distance of two voxel cubes is at most: that of points of one to the other.
    double cubesDistanceAtMost() const;
};

/// Calls @a test with @a count poses in all, of pairs of samples: a third of them is near contact, the rest
/// anywhere. The same ones each time. Ends early at the first fatal failure.
void forEachPosePair(
    Exactness exactness, int count, const std::function<void(const PosePair&)>& test);

} // namespace spheretree_test
