// SPDX-License-Identifier: Apache-2.0
/// @file TestGeneratedObject.cc
/// @brief What holds for all generated shapes: counts, seeds, names, refusals, the same on every machine.

#include <openvdb_spheretree/base/Hash.h>
#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/input/shapes/GeneratedObject.h>

#include "support/GeneratedShapes.h"
#include "support/Messages.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <unistd.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

constexpr std::array<Shape, 5> kShapes{
    Shape::Gyroid, Shape::Menger, Shape::Terrain, Shape::Noise, Shape::Ball};

void expectCount(Shape shape, int64_t voxels)
{
    const double count = double(made(shape, voxels)->activeVoxelCount());
    EXPECT_NEAR(count / double(voxels), 1, 0.1) << toString(shape) << " of " << voxels;
}

TEST(GeneratedObject, HasTheNumberOfVoxelsWithinTenPercent)
{
    for (const Shape shape : kShapes) {
        for (double voxels = 1000; voxels < 20000; voxels *= 1.03) {
            expectCount(shape, int64_t(voxels));
        }
        for (const int64_t voxels : {100000, 160000, 160001, 1000000, 3210000}) {
            expectCount(shape, voxels);
        }
    }
}

TEST(GeneratedObject, LeavesHoldWhatTheHeaderSays)
{
    const std::array<double, 4> voxelsOfLeaf{170, 160, 120, 5};
    for (std::size_t i = 0; i < voxelsOfLeaf.size(); ++i) {
        const auto grid = made(kShapes[i], 3000000);
        const double voxels = double(grid->activeVoxelCount()) / double(grid->tree().leafCount());
        EXPECT_NEAR(voxels / voxelsOfLeaf[i], 1, 0.15) << toString(kShapes[i]) << " " << voxels;
    }
}

TEST(GeneratedObject, LeavesHoldAVoxelAtLeast)
{
    for (const Shape shape : kShapes) {
        const auto grid = made(shape, 100000);
        for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf) {
            EXPECT_FALSE(leaf->isEmpty()) << toString(shape) << leaf->origin();
        }
    }
}

TEST(GeneratedObject, IsTheSameForAnyNumberOfThreads)
{
    for (const Shape shape : kShapes) {
        std::vector<BoolGrid::Ptr> grids;
        for (const std::size_t threads : {1, 2, 5}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            grids.push_back(made(shape, 300000));
        }
        EXPECT_TRUE(grids[0]->tree().hasSameTopology(grids[1]->tree())) << toString(shape);
        EXPECT_TRUE(grids[0]->tree().hasSameTopology(grids[2]->tree())) << toString(shape);
    }
}

/// A number that is another one for any other set of voxels.
uint64_t checksum(const BoolGrid& grid)
{
    uint64_t sum = 0;
    for (auto voxel = grid.cbeginValueOn(); voxel; ++voxel) {
        CoordBBox box;
        voxel.getBoundingBox(box);
        for (auto q = box.begin(); q; ++q) {
            const Coord at = *q + Coord(1000); // the ball has coordinates below 0
            sum += detail::hash(uint64_t(at[0]) << 42 | uint64_t(at[1]) << 21 | uint64_t(at[2]));
        }
    }
    return sum;
}

/// Figures measured on one machine are compared with those of others, and of other years.
TEST(GeneratedObject, IsTheSameOnEveryMachine)
{
    constexpr std::array<uint64_t, 5> sums{8381283209549820110u, 10971832179275678623u,
        157183048306125320u, 6676792716224326805u, 3352937674184047869u};
    for (std::size_t i = 0; i < kShapes.size(); ++i) {
        EXPECT_EQ(checksum(*made(kShapes[i], 100000)), sums[i]) << toString(kShapes[i]);
    }
}

TEST(GeneratedObject, SeedsMakeOtherTerrainAndNoise)
{
    for (const Shape shape : kShapes) {
        const bool random = shape == Shape::Terrain || shape == Shape::Noise;
        const auto grid = made(shape, 20000, 1), other = made(shape, 20000, 2);
        EXPECT_EQ(grid->tree().hasSameTopology(other->tree()), !random) << toString(shape);
    }
}

TEST(GeneratedObject, IsNamedAndScaled)
{
    GeneratedObjectSettings settings = settingsOf(Shape::Menger, 8000);
    settings.voxelSize = 0.25;
    const auto grid = generateObject(settings);
    EXPECT_EQ(grid->getName(), "menger");
    EXPECT_EQ(grid->voxelSize(), openvdb::Vec3d(0.25));
    EXPECT_EQ(grid->indexToWorld(Coord(4, 0, 8)), openvdb::Vec3d(1, 0, 2));
}

TEST(GeneratedObject, NamesOfShapesAreReadBack)
{
    for (const Shape shape : kShapes) EXPECT_EQ(shapeFromString(toString(shape)), shape);
    const std::string message = messageOf<openvdb::ValueError>([] { shapeFromString("cube"); });
    EXPECT_TRUE(mentions(message, "shape='cube'"));
    EXPECT_TRUE(mentions(message, "gyroid, menger, terrain, noise or ball"));
}

TEST(GeneratedObject, RefusesCountsThatCannotBeMade)
{
    constexpr int64_t kMost = std::numeric_limits<int64_t>::max();
    for (const Shape shape : kShapes) {
        for (const int64_t voxels : {int64_t(0), int64_t(-1), int64_t(999), -kMost - 1}) {
            const std::string message =
                messageOf<openvdb::ValueError>([&] { made(shape, voxels); });
            EXPECT_TRUE(mentions(message, "voxels=" + std::to_string(voxels)));
            EXPECT_TRUE(mentions(message, "ask for 1000 or more"));
        }
        const std::string message = messageOf<openvdb::ValueError>([&] { made(shape, kMost); });
        EXPECT_TRUE(mentions(message, "more than 2^31 leaf nodes"));
        EXPECT_TRUE(mentions(message, "ask for fewer"));
    }
}

TEST(GeneratedObject, RefusesWhatNeedsMoreThanTheMemoryOfTheMachine)
{
    if (double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE)) > 3e11) GTEST_SKIP();
    const auto noise = settingsOf(Shape::Noise, int64_t(10) << 30); // 2^31 leaves
    const std::string message = messageOf<openvdb::ValueError>([&] { noise.validate(); });
    EXPECT_TRUE(mentions(message, "GiB of this machine: ask for fewer voxels"));
}

TEST(GeneratedObject, RefusesVoxelSizesThatAreNone)
{
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    GeneratedObjectSettings settings = settingsOf(Shape::Ball, 1000);
    for (const double size : {0.0, -1.0, 1e-5, kInfinity, std::nan("")}) {
        settings.voxelSize = size;
        EXPECT_TRUE(mentions(
            messageOf<openvdb::ValueError>([&] { generateObject(settings); }), "out of range"));
    }
    for (const double size : {settings.kSmallestVoxel, settings.kLargestVoxel}) {
        settings.voxelSize = size;
        EXPECT_EQ(generateObject(settings)->voxelSize()[0], size);
    }
}

struct StopAtOnce : openvdb::util::NullInterrupter {
    bool wasInterrupted(int = -1) override { return true; }
};

TEST(GeneratedObject, CanBeInterrupted)
{
    for (const Shape shape : kShapes) {
        StopAtOnce interrupter;
        EXPECT_THROW(generateObject(settingsOf(shape, 10000), &interrupter), Interrupted);
    }
}

} // namespace
