// SPDX-License-Identifier: Apache-2.0
/// @file TestCollideWorlds.cc
/// @brief Verdicts of two bodies that are swapped, of a world that is moved, turned or far away: the same, and nothing
/// that meets is missed.

#include "ObjectReference.h"
#include "PosePairs.h"
#include "QuerySamples.h"

#include <openvdb_spheretree/query/Collide.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

/// Leaves grow by rounding to floats: gaps this near to 0 may be either.
constexpr double kRounding = 2e-5;

TEST(Collide, SwappedBodiesGiveTheSameVerdict)
{
    forEachPosePair(Exactness::LeafUnion, 5000, [&](const PosePair& pair) {
        if (std::abs(pair.smallestGap()) < kRounding) return;
        ASSERT_EQ(pair.collide().verdict, pair.swapped().collide().verdict);
    });
}

TEST(Collide, AMovedWorldGivesTheSameVerdict)
{
    Random random(8);
    forEachPosePair(Exactness::LeafUnion, 5000, [&](const PosePair& pair) {
        if (std::abs(pair.smallestGap()) < 1e-4) return;
        const auto world =
            RigidTransform::fromTranslation(1e6 * randomDirection(random)) * randomRotation(random);
        ASSERT_EQ(pair.collide().verdict, pair.movedBy(world).collide().verdict);
    });
}

/// From 10^6 to 10^9 voxels away.
TEST(Collide, FarFromTheOriginOfTheWorldNoTwoCubesThatMeetAreApart)
{
    Random random(12);
    int met = 0, apart = 0;
    forEachPosePair(Exactness::Object, 3000, [&](const PosePair& pair) {
        const double far = pair.a.tree.voxelSize() * std::pow(10.0, uniform(random, 6, 9));
        const auto world =
            RigidTransform::fromTranslation(far * randomDirection(random)) * randomRotation(random);
        // Poses there are rounded.
        const double rounding = 1e-15 * far + 1e-9;
        const bool isApart = pair.movedBy(world).collide().verdict == Verdict::Apart;
        (isApart ? apart : met) += 1;
        ASSERT_FALSE(isApart && pair.cubesMeet(rounding)) << pair.name() << far;
        ASSERT_FALSE(!isApart && pair.smallestGap() > kRounding + 10 * rounding)
            << pair.name() << far;
    });
    EXPECT_GT(met, 500);
    EXPECT_GT(apart, 500);
}

/// The trees themselves lie there, and each is brought back by its pose.
TEST(Collide, TreesFarFromTheOriginOfTheWorldThatMeetAreNotApart)
{
    int met = 0, apart = 0;
    for (const double voxels : {1e6, 1e7, 1e8, 1e9}) {
        std::vector<QuerySample> moved;
        for (const QuerySample& sample : querySamples()) {
            const double far = voxels * sample.tree.voxelSize();
            moved.push_back(sample);
            SphereTree& tree = moved.back().tree;
            tree = turnedTree(tree, Vec3d(far, -far, 0.5 * far));
            for (Coord& voxel : moved.back().voxels) voxel = Coord(voxel[1], voxel[2], voxel[0]);
        }
        forEachPosePairOf(moved, Exactness::Object, 1000, [&](const PosePair& pair) {
            const double rounding = 1e-15 * voxels * pair.a.tree.voxelSize() + 1e-9;
            const bool isApart = pair.collide().verdict == Verdict::Apart;
            (isApart ? apart : met) += 1;
            ASSERT_FALSE(isApart && pair.cubesMeet(10 * rounding)) << pair.name() << voxels;
        });
    }
    EXPECT_GT(met, 500);
    EXPECT_GT(apart, 500);
}

TEST(Collide, AxesInAnotherOrderGiveTheSameVerdict)
{
    TurnedPairs turned(Exactness::LeafUnion);
    forEachPosePair(Exactness::LeafUnion, 5000, [&](const PosePair& pair) {
        if (std::abs(pair.smallestGap()) < 1e-4) return;
        ASSERT_EQ(pair.collide().verdict, turned.of(pair).collide().verdict);
    });
}

} // namespace
