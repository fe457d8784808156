// SPDX-License-Identifier: Apache-2.0
/// @file PosePairs.h
/// @brief Two of the sample trees in poses near contact, nested, and far, and what is true of them by brute force.

#pragma once

#include "QuerySamples.h"

#include <openvdb_spheretree/query/BodyDistance.h>
#include <openvdb_spheretree/query/Collide.h>
#include <openvdb_spheretree/query/RigidMotion.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace spheretree_test {

/// A sample with its tree of queries, made with the settings of the sample.
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
    /// @param inside  world units that all faces are moved inwards by: then they meet whatever rounding of poses has done
    bool cubesMeet(double inside = 0) const;
    /// What the distance of two voxel cubes is at most: that of points of one to the other.
    double cubesDistanceAtMost() const;
};

/// Calls @a test with @a count poses in all, of pairs of samples: a third of them is near contact, the rest
/// anywhere. The same ones each time. Ends early at the first fatal failure.
void forEachPosePair(
    Exactness exactness, int count, const std::function<void(const PosePair&)>& test);
/// The same of other samples.
void forEachPosePairOf(const std::vector<QuerySample>& samples, Exactness exactness, int count,
    const std::function<void(const PosePair&)>& test);

/// @return the motion with another pose of the body in front of it, in another world.
openvdb_spheretree::RigidMotion movedMotion(const RigidTransform& world,
    const openvdb_spheretree::RigidMotion& motion, const RigidTransform& first = {});

/// The same pairs with the axes of the world and of both trees in another order, as turnedTree().
class TurnedPairs {
public:
    explicit TurnedPairs(Exactness exactness) : mExactness(exactness) {}

    PosePair of(const PosePair& pair);
    openvdb_spheretree::RigidMotion of(const openvdb_spheretree::RigidMotion& motion) const;

private:
    const QueryBody& body(const QueryBody& given);

    struct Turned {
        QuerySample sample;
        QueryBody body;
        Turned(const QueryBody& given, Exactness exactness);
    };
    Exactness mExactness;
    std::map<const QueryBody*, std::unique_ptr<Turned>> mBodies;
};

} // namespace spheretree_test
