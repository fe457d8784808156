// SPDX-License-Identifier: Apache-2.0
/// @file TestMedialAxis.cc
/// @brief The medial balls' interface and what they promise. Against brute force:
/// TestTransformsOracle.cc.

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/medial/MedialAxis.h>

#include <openvdb/openvdb.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::MaskTree;

using Balls = std::vector<MedialBall>;

Balls ballsOf(const MaskTree& mask, int dim = 3) { return medialBalls(*gridOf(mask), dim); }
Balls ballsOf(const Voxels& voxels, int dim = 3) { return ballsOf(*maskOf(voxels), dim); }

/// The voxels of a digital ball.
Voxels voxelsOf(const MedialBall& ball, int dim)
{
    const int r = int(std::sqrt(double(ball.radiusSq))) + 1;
    Voxels voxels;
    for (const Coord& step :
        voxelsOfBox(CoordBBox(Coord(-r, -r, dim == 2 ? 0 : -r), Coord(r, r, dim == 2 ? 0 : r)))) {
        if (squaredDistance(step, Coord(0, 0, 0)) >= ball.radiusSq) continue;
        voxels.push_back(ball.center + step);
    }
    return voxels;
}

TEST(MedialAxis, ASingleVoxelIsOneBall)
{
    const Coord voxel(-1, 128, -4096);
    EXPECT_EQ(ballsOf(Voxels{voxel}), (Balls{{voxel, 1}}));
    EXPECT_EQ(ballsOf(Voxels{voxel}, 2), (Balls{{voxel, 1}}));
}

TEST(MedialAxis, ASmallBallIsOneBall)
{
    for (int radiusSq : {1, 2, 4}) {
        EXPECT_EQ(ballsOf(shapes::ball(radiusSq)), (Balls{{Coord(0, 0, 0), radiusSq}}));
    }
}

TEST(MedialAxis, AnEmptyObjectHasNoBalls)
{
    EXPECT_TRUE(medialBalls(*openvdb::BoolGrid::create()).empty());
}

TEST(MedialAxis, AnOddBarHasABallAtEachVoxelOfItsCore)
{
    const Balls expected{{Coord(1, 1, 1), 4}, {Coord(2, 1, 1), 4}, {Coord(3, 1, 1), 4}};
    EXPECT_EQ(ballsOf(shapes::box(Coord(5, 3, 3))), expected);
}

/// Two dimensions for every other kind of object, but for those that would be turned:
/// TestFlatObjects has these.
int dimFor(const RandomObject& object, uint32_t seed)
{
    const CoordBBox box = boxOf(object.voxels);
    const bool turned = box.min()[0] == box.max()[0] || box.min()[1] == box.max()[1];
    return turned ? 3 : 2 + int(seed / 11 % 2);
}

TEST(MedialAxis, BallsComeInTheOrderOfTheirCentresAcrossLeaves)
{
    for (uint32_t seed = 0; seed < 55; ++seed) {
        Voxels voxels = randomObject(seed).voxels;
        for (Coord& voxel : voxels) voxel = Coord(voxel[0] * 2, voxel[1] * 2, voxel[2] * 3);
        const Balls balls = ballsOf(voxels);
        ASSERT_EQ(balls.size(), voxels.size()) << "no two voxels touch: each is a ball";
        for (std::size_t i = 0; i < balls.size(); ++i) ASSERT_EQ(balls[i].center, voxels[i]);
    }
}

TEST(MedialAxis, TheUnionOfTheBallsIsTheObject)
{
    for (uint32_t seed = 500; seed < 720; ++seed) {
        const RandomObject object = randomObject(seed);
        const int dim = dimFor(object, seed);
        std::set<Coord> covered;
        for (const MedialBall& ball : ballsOf(object.voxels, dim)) {
            for (const Coord& voxel : voxelsOf(ball, dim)) covered.insert(voxel);
        }
        ASSERT_EQ(Voxels(covered.begin(), covered.end()), object.voxels) << object.name;
    }
}

TEST(MedialAxis, TheBallsAreTheLabelsInUse)
{
    for (uint32_t seed = 0; seed < 110; ++seed) {
        const RandomObject object = randomObject(seed);
        const Balls balls = ballsOf(object.voxels);
        const CoreStages stages(*maskOf(object.voxels));
        std::set<Coord> used;
        for (const Coord& voxel : object.voxels) used.insert(stages.labels.label(voxel));
        ASSERT_EQ(balls.size(), used.size()) << object.name;
        for (const MedialBall& ball : balls) {
            ASSERT_EQ(used.count(ball.center), 1u) << object.name;
            ASSERT_EQ(uint32_t(ball.radiusSq), stages.distSq(ball.center)) << object.name;
        }
    }
}

TEST(MedialAxis, TilesHaveTheBallsOfTheirVoxels)
{
    struct {
        int size;
        openvdb::Index level;
    } const tiles[] = {{8, 1}, {128, 2}};
    for (const auto& tile : tiles) {
        MaskTree tree(false);
        tree.addTile(tile.level, Coord(-tile.size, 0, tile.size), true, true);
        const Balls asTile = ballsOf(tree);
        tree.voxelizeActiveTiles(false);
        EXPECT_FALSE(asTile.empty());
        EXPECT_EQ(asTile, ballsOf(tree));
    }
}

TEST(MedialAxis, VoxelsFarApartAreTwoBalls)
{
    for (int far : {1000000, 1 << 27}) {
        const Balls expected{{Coord(-far, 3, -7), 1}, {Coord(far, 3, -7), 1}};
        EXPECT_EQ(ballsOf(Voxels{Coord(-far, 3, -7), Coord(far, 3, -7)}), expected);
    }
}

TEST(MedialAxis, StopsWhenInterrupted)
{
    const auto mask = maskOf(shapes::ball(100));
    for (int after : {0, 1, 2}) {
        StopAfter interrupter(after);
        EXPECT_THROW(medialBalls(*gridOf(*mask), 3, {}, &interrupter), Interrupted);
    }
    StopAfter never(1 << 30);
    EXPECT_EQ(medialBalls(*gridOf(*mask), 3, {}, &never), ballsOf(*mask));
}

} // namespace
