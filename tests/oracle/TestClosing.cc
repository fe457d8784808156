// SPDX-License-Identifier: Apache-2.0
/// @file TestClosing.cc
/// @brief Closing by the distance transform against closing voxel by voxel, and the model made of
/// it.

#include "support/CoreStages.h"
#include "support/Messages.h"
#include "support/NaiveModels.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/pyramid/Closing.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>

#include <tbb/global_control.h>

#include <cmath>
#include <string>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Index64;
using openvdb::MaskTree;

TEST(Closing, MatchesClosingVoxelByVoxel)
{
    for (uint32_t seed = 0; seed < 88; ++seed) {
        const RandomObject object = randomObject(900 + seed);
        const int radius = 1 + int(seed % 4);
        const auto mask = maskOf(object.voxels);
        if (seed % 2) mask->prune();
        for (const int dim : {2, 3}) {
            ASSERT_EQ(
                voxelsOf(*closing(*mask, radius, dim)), naiveClosing(object.voxels, radius, dim))
                << object.name << ", radius " << radius << ", dim " << dim;
        }
    }
}

TEST(Closing, MatchesForRadiiThatReachOverLeaves)
{
    Random random(5);
    for (const int radius : {7, 8, 9}) {
        Voxels voxels;
        for (int i = 0; i < 25; ++i) voxels.push_back(random.coord(-14, 14));
        sortVoxels(voxels);
        EXPECT_EQ(voxelsOf(*closing(*maskOf(voxels), radius)), naiveClosing(voxels, radius));
        for (Coord& voxel : voxels) voxel[2] = 5;
        sortVoxels(voxels);
        for (const int wide : {radius, 3 * radius}) {
            EXPECT_EQ(voxelsOf(*closing(*maskOf(voxels), wide, 2)), naiveClosing(voxels, wide, 2));
        }
    }
}

TEST(Closing, FillsAGapJustWhereTheBallFits)
{
    // Two walls with a gap of g voxels: the ball of radius r gets between them from g = 2 r + 1 on.
    for (int radius = 1; radius <= 20; radius += 3) {
        for (const int gap : {2 * radius - 1, 2 * radius, 2 * radius + 1}) {
            MaskTree walls(false);
            walls.sparseFill(CoordBBox(Coord(-100, -100, -8), Coord(99, 99, -1)), true);
            walls.sparseFill(CoordBBox(Coord(-100, -100, gap), Coord(99, 99, gap + 7)), true);
            const auto closed = closing(walls, radius);
            EXPECT_EQ(closed->isValueOn(Coord(0, 0, gap / 2)), gap <= 2 * radius)
                << "radius " << radius << ", gap " << gap;
        }
    }
}

TEST(Closing, TilesAreCutUpOnlyAlongTheSurface)
{
    MaskTree tree(false);
    tree.sparseFill(CoordBBox::createCube(Coord(0, 0, 0), 256), true);
    tree.fill(CoordBBox::createCube(Coord(60, 60, 60), 2), false, false); // a small hole
    const auto closed = closing(tree, 2);
    EXPECT_EQ(closed->activeVoxelCount(), Index64(256) * 256 * 256);
    EXPECT_EQ(closed->leafCount(), 0u);
}

TEST(Closing, TilesGiveWhatTheirVoxelsGive)
{
    Random random(11);
    MaskTree tree(false);
    tree.addTile(2, Coord(-128, 0, 0), true, true);
    for (int i = 0; i < 30; ++i) {
        const Coord at = random.coord(-2, 2);
        tree.addTile(1, Coord(8 * at[0], 8 * at[1] - 16, 8 * at[2]), true, true);
        tree.setValueOn(random.coord(-20, 20));
    }
    MaskTree voxels(tree);
    voxels.voxelizeActiveTiles();
    for (const int radius : {1, 3, 10}) {
        EXPECT_TRUE(closing(tree, radius)->hasSameTopology(*closing(voxels, radius))) << radius;
    }
}

TEST(Closing, OfRadiusZeroChangesNothingAndOthersHaveALimit)
{
    const Voxels voxels = randomObject(4).voxels;
    EXPECT_EQ(voxelsOf(*closing(*maskOf(voxels), 0)), voxels);
    for (const int radius : {-1, 65}) {
        const std::string why =
            messageOf<openvdb::ValueError>([&] { closing(*maskOf(voxels), radius); });
        EXPECT_TRUE(mentions(why, "closing=" + std::to_string(radius) + " is out of range"));
    }
}

TEST(Closing, IsTheSameForAnyNumberOfThreads)
{
    const auto mask = maskOf(shapes::ball(900, 300));
    const auto expected = closing(*mask, 5);
    for (const int threads : {1, 2, 5}) {
        const tbb::global_control control(
            tbb::global_control::max_allowed_parallelism, std::size_t(threads));
        EXPECT_TRUE(closing(*mask, 5)->hasSameTopology(*expected));
    }
}

TEST(Closing, StopsWhenInterrupted)
{
    StopAfter interrupter;
    EXPECT_THROW(closing(*maskOf(shapes::ball(200)), 3, 3, &interrupter), Interrupted);
}

TEST(Closing, AsAModelIsOrAfterAClosingOnEveryLevel)
{
    for (uint32_t seed = 0; seed < 33; ++seed) {
        const RandomObject object = randomObject(40 + seed);
        const int radius = 1 + int(seed % 3), factor = 2 + int(seed % 2);
        const OrPyramid pyramid =
            buildOrPyramid(*gridOf(object.voxels), factor, 3, closingModel(radius));
        const OrPyramid plain = buildOrPyramid(*gridOf(object.voxels), factor);
        ASSERT_EQ(pyramid.levels.size(), plain.levels.size()) << object.name;
        PyramidStep step{pyramid.origin, factor, 3};
        for (std::size_t k = 1; k < pyramid.levels.size(); ++k) {
            std::set<Coord> parents;
            for (const Coord& voxel : naiveClosing(voxelsOf(*pyramid.levels[k - 1]), radius)) {
                parents.insert(step.parentVoxel(voxel));
            }
            ASSERT_EQ(voxelsOf(*pyramid.levels[k]), Voxels(parents.begin(), parents.end()))
                << object.name << ", level " << k;
            step.origin = Coord();
        }
    }
}

/// As many voxels, far apart, as make the band larger than the machine's memory: it is not made.
TEST(Closing, RefusesABandThatDoesNotFitInMemoryBeforeItIsMade)
{
    constexpr double kBandBytes = 33.0 * 33 * 33 * 4096; // of a voxel and a radius of 64, or more
    constexpr int kApart = 512;
    const double there = detail::physicalMemory();
    if (there == 0) GTEST_SKIP() << "how much memory there is cannot be told";
    const int side = int(std::cbrt(there / kBandBytes)) + 1;
    MaskTree mask(false);
    for (const Coord& at : openvdb::CoordBBox::createCube(Coord(0), side)) {
        mask.setValueOn(Coord(at[0] * kApart, at[1] * kApart, at[2] * kApart));
    }
    const std::string why = messageOf<openvdb::ValueError>([&] { closing(mask, 64); });
    EXPECT_TRUE(mentions(why, "closing=64 looks at "));
    EXPECT_TRUE(mentions(why, "use a smaller radius"));
}

} // namespace
