// SPDX-License-Identifier: Apache-2.0
/// @file TestInvariance.cc
/// @brief What must not matter: where an object lies, which way its axes point, what else lies far
/// away, whether voxels are stored as tiles, how many threads there are.

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

#include <tbb/global_control.h>

#include <string>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

using Balls = std::vector<MedialBall>;

/// Small objects of all shapes, and some with thick parts.
std::vector<RandomObject> objects()
{
    std::vector<RandomObject> result;
    for (uint32_t seed = 3000; seed < 3066; ++seed) result.push_back(randomObject(seed));
    result.push_back({"large ball", translated(shapes::ball(20 * 20), Coord(-3, 120, 5))});
    result.push_back({"large box", translated(shapes::box(Coord(50, 31, 44)), Coord(-20, -1, -7))});
    return result;
}

/// The layout and everything computed on it, voxel by voxel.
testing::AssertionResult sameStages(const CoreStages& a, const CoreStages& b)
{
    if (a.layout.leafCount() != b.layout.leafCount()) {
        return testing::AssertionFailure() << "different leaves";
    }
    auto result = testing::AssertionSuccess();
    forEachVoxel(a.layout, [&](uint32_t leaf, uint32_t k, const Coord& voxel) {
        const bool same = b.distSq(voxel) == a.distances.at(leaf, k)
            && b.labels.label(voxel) == a.labels.label(voxel);
        if (result && !same)
            result = testing::AssertionFailure() << "voxel " << voxel << " differs";
    });
    if (result && !(a.balls == b.balls)) return testing::AssertionFailure() << "balls differ";
    return result;
}

Balls moved(Balls balls, const Coord& by)
{
    for (MedialBall& ball : balls) ball.center += by;
    return balls;
}

TEST(Invariance, TranslationByLeavesCarriesEverythingAlong)
{
    for (const RandomObject& object : objects()) {
        const CoreStages here(*maskOf(object.voxels));
        for (const Coord& by : {Coord(8, -16, 4096), Coord(-128, 136, -1048576), Coord(0, 0, -8)}) {
            const CoreStages there(*maskOf(translated(object.voxels, by)));
            for (const Coord& voxel : object.voxels) {
                ASSERT_EQ(there.distSq(voxel + by), here.distSq(voxel)) << object.name;
                ASSERT_EQ(there.labels.label(voxel + by), here.labels.label(voxel) + by)
                    << object.name;
            }
            ASSERT_EQ(there.balls, moved(here.balls, by)) << object.name;
        }
    }
}

TEST(Invariance, TranslationByAnyStepCarriesEverythingAlong)
{
    Random random(11);
    for (const RandomObject& object : objects()) {
        const Coord by = random.coord(-20, 20);
        const CoreStages here(*maskOf(object.voxels));
        const CoreStages there(*maskOf(translated(object.voxels, by)));
        for (const Coord& voxel : object.voxels) {
            ASSERT_EQ(there.distSq(voxel + by), here.distSq(voxel)) << object.name;
            ASSERT_EQ(there.labels.label(voxel + by), here.labels.label(voxel) + by) << object.name;
        }
        ASSERT_EQ(there.balls, moved(here.balls, by)) << object.name;
    }
}

/// The power that a label has for its voxel, and its radius: what the tie rule compares before it
/// comes to the order of coordinates, which an axis permutation changes.
std::pair<int64_t, int64_t> quality(const CoreStages& stages, const Coord& voxel)
{
    const Coord label = stages.labels.label(voxel);
    const int64_t distSq = stages.distSq(label);
    return {distSq - squaredDistance(label, voxel), distSq};
}

TEST(Invariance, PermutedOrMirroredAxesCarryDistancesAndLabelsAlongUpToTies)
{
    for (const RandomObject& object : objects()) {
        const CoreStages here(*maskOf(object.voxels));
        for (const Coord& order :
            {Coord(1, 2, 0), Coord(2, 0, 1), Coord(0, 2, 1), Coord(1, 0, 2)}) {
            for (int sign : {1, -1}) {
                const auto turned = [&](const Coord& v) {
                    return Coord(sign * v[order[0]], v[order[1]], sign * v[order[2]]);
                };
                Voxels voxels;
                for (const Coord& voxel : object.voxels) voxels.push_back(turned(voxel));
                const CoreStages there(*maskOf(voxels));
                for (const Coord& voxel : object.voxels) {
                    ASSERT_EQ(there.distSq(turned(voxel)), here.distSq(voxel)) << object.name;
                    ASSERT_EQ(quality(there, turned(voxel)), quality(here, voxel)) << object.name;
                }
            }
        }
    }
}

TEST(Invariance, AnObjectWithoutTiesHasTheSameBallsInAnyOrderOfAxes)
{
    // Balls far enough apart keep their labels to themselves, whatever the order of coordinates.
    Voxels voxels;
    for (int i = 0; i < 40; ++i) {
        for (const Coord& v : shapes::ball(i % 2 ? 2 : 4)) {
            voxels.push_back(v + Coord(10 * i - 200, 7 * (i % 5), 13 * (i % 3)));
        }
    }
    const Balls here = CoreStages(*maskOf(voxels)).balls;
    for (Coord& voxel : voxels) voxel = Coord(voxel[2], voxel[0], voxel[1]);
    Balls there = CoreStages(*maskOf(voxels)).balls;
    EXPECT_EQ(here.size(), 40u);
    for (MedialBall& ball : there) {
        ball.center = Coord(ball.center[1], ball.center[2], ball.center[0]);
    }
    std::sort(there.begin(), there.end(),
        [](const auto& a, const auto& b) { return a.center < b.center; });
    EXPECT_EQ(there, here);
}

TEST(Invariance, DisjointCopiesDoNotSeeEachOther)
{
    for (const RandomObject& object : objects()) {
        const CoordBBox box = boxOf(object.voxels);
        const CoreStages alone(*maskOf(object.voxels));
        for (int axis = 0; axis < 3; ++axis) {
            // One voxel of background between the two is enough.
            Coord by(0, 0, 0);
            by[axis] = box.extents()[axis] + 1;
            Voxels both = object.voxels;
            for (const Coord& voxel : object.voxels) both.push_back(voxel + by);
            const CoreStages pair(*maskOf(both));
            ASSERT_EQ(pair.balls.size(), 2 * alone.balls.size()) << object.name;
            for (const Coord& voxel : object.voxels) {
                ASSERT_EQ(pair.distSq(voxel), alone.distSq(voxel)) << object.name;
                ASSERT_EQ(pair.distSq(voxel + by), alone.distSq(voxel)) << object.name;
                const Coord label = alone.labels.label(voxel);
                ASSERT_EQ(pair.labels.label(voxel), label) << object.name;
                ASSERT_EQ(pair.labels.label(voxel + by), label + by) << object.name;
            }
        }
    }
}

TEST(Invariance, TilesGiveTheSameAsTheirVoxelsWrittenOut)
{
    for (const CoordBBox& box : {CoordBBox(Coord(-9, 0, 3), Coord(20, 40, 33)),
             CoordBBox(Coord(-128, -8, 0), Coord(-1, 119, 127)),
             CoordBBox(Coord(100, -20, -130), Coord(150, 15, 140))}) {
        auto tiles = maskOf(box);
        tiles->setValueOff(box.min() + Coord(12, 13, 14)); // a hole, so that it is no plain box
        const auto voxels = std::make_shared<openvdb::MaskTree>(*tiles);
        voxels->voxelizeActiveTiles(false);
        ASSERT_GT(tiles->activeTileCount(), 0u);
        ASSERT_EQ(voxels->activeTileCount(), 0u);
        EXPECT_TRUE(sameStages(CoreStages(*tiles), CoreStages(*voxels))) << box;
    }
}

TEST(Invariance, TheNumberOfThreadsDoesNotMatter)
{
    const auto stagesWith = [](int threads, const openvdb::MaskTree& mask) {
        tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        return std::make_unique<CoreStages>(mask);
    };
    Random random(5);
    Voxels cluster; // many leaves, so that there is something to share
    for (uint32_t seed = 0; seed < 60; ++seed) {
        const Coord at = random.coord(0, 90);
        for (const Coord& v : shapes::ball(random.between(4, 150))) cluster.push_back(v + at);
    }
    std::vector<RandomObject> all = objects();
    all.push_back({"cluster of balls", cluster});
    for (const RandomObject& object : all) {
        const auto mask = maskOf(object.voxels);
        const auto one = stagesWith(1, *mask), two = stagesWith(2, *mask),
                   many = stagesWith(7, *mask);
        ASSERT_TRUE(sameStages(*one, *two)) << object.name;
        ASSERT_TRUE(sameStages(*one, *many)) << object.name;
    }
}

} // namespace
