// SPDX-License-Identifier: Apache-2.0
/// @file TestGeneratedObject.cc
/// @brief Every generated shape against its definition, voxel by voxel, and what holds for all.

#include <openvdb_spheretree/base/Hash.h>
#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/input/shapes/BallShape.h>
#include <openvdb_spheretree/input/shapes/GeneratedObject.h>
#include <openvdb_spheretree/input/shapes/HeightField.h>

#include "support/Messages.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <unistd.h>

using namespace openvdb_spheretree;
using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;
using spheretree_test::mentions;
using spheretree_test::messageOf;

namespace {

constexpr std::array<Shape, 5> kShapes{
    Shape::Gyroid, Shape::Menger, Shape::Terrain, Shape::Noise, Shape::Ball};

GeneratedObjectSettings settingsOf(Shape shape, int64_t voxels, uint64_t seed = 1)
{
    GeneratedObjectSettings settings;
    settings.shape = shape;
    settings.voxels = voxels;
    settings.seed = seed;
    return settings;
}

BoolGrid::Ptr made(Shape shape, int64_t voxels, uint64_t seed = 1)
{
    return generateObject(settingsOf(shape, voxels, seed));
}

CoordBBox boxOf(const BoolGrid& grid) { return grid.evalActiveVoxelBoundingBox(); }

using Rule = std::function<bool(const Coord&)>;

/// The grid's voxels are those of the box by the rule, on and true, and there are no others.
void expectRule(const BoolGrid& grid, const CoordBBox& box, const Rule& rule)
{
    const auto accessor = grid.getConstAccessor();
    uint64_t count = 0;
    for (auto ijk = box.begin(); ijk; ++ijk) {
        const bool on = rule(*ijk);
        count += on;
        ASSERT_EQ(accessor.isValueOn(*ijk), on) << *ijk;
        ASSERT_EQ(accessor.getValue(*ijk), on) << *ijk;
    }
    EXPECT_EQ(grid.activeVoxelCount(), count);
    EXPECT_FALSE(grid.background());
}

bool isNearCube(const Coord& sides)
{
    return sides[0] >= sides[1] && sides[1] >= sides[2] && sides[0] - sides[2] <= 1;
}

// ---- What holds for all shapes

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

// ---- Shape by shape

/// In doubles: how much nearer than 3 voxels the surface is, to first order.
double insideGyroid(const Coord& ijk)
{
    const double w = 2 * 3.14159265358979323846 / 64;
    const double x = w * ijk[0], y = w * ijk[1], z = w * ijk[2];
    using std::cos, std::sin;
    const double f = sin(x) * cos(y) + sin(y) * cos(z) + sin(z) * cos(x);
    const openvdb::Vec3d gradient(cos(x) * cos(y) - sin(z) * sin(x),
        cos(y) * cos(z) - sin(x) * sin(y), cos(z) * cos(x) - sin(y) * sin(z));
    return 3 * w * gradient.length() - std::abs(f);
}

TEST(GeneratedGyroid, IsTheShellOfTheSurface)
{
    const auto grid = made(Shape::Gyroid, 150000);
    const CoordBBox box = boxOf(*grid);
    EXPECT_EQ(box.min(), Coord(0));
    EXPECT_TRUE(isNearCube(box.extents())) << box;
    EXPECT_GT(box.extents()[2], 64); // more than a period
    const auto accessor = grid->getConstAccessor();
    uint64_t count = 0, near = 0;
    for (auto ijk = box.begin(); ijk; ++ijk) {
        const double inside = insideGyroid(*ijk);
        const bool on = accessor.isValueOn(*ijk);
        count += on;
        ASSERT_EQ(accessor.getValue(*ijk), on);
        if (std::abs(inside) < 0.002) {
            ++near; // rounding decides
        } else {
            ASSERT_EQ(on, inside > 0) << *ijk;
        }
    }
    EXPECT_EQ(grid->activeVoxelCount(), count);
    EXPECT_LT(near, count / 50);
}

TEST(GeneratedGyroid, GoesOnFromPeriodToPeriod)
{
    const auto grid = made(Shape::Gyroid, 4000000); // 3 periods and a rest
    const auto accessor = grid->getConstAccessor();
    const CoordBBox box = boxOf(*grid);
    ASSERT_GT(box.max()[2], 3 * 64);
    for (auto ijk = box.begin(); ijk; ++ijk) {
        const Coord first = *ijk & 63;
        ASSERT_EQ(accessor.isValueOn(*ijk), accessor.isValueOn(first)) << *ijk;
    }
}

/// By definition: the middle of each face, and of the cube, at every size.
bool isOnMenger(const Coord& ijk)
{
    for (int size = 1; size < 3000; size *= 3) {
        int middle = 0;
        for (int axis = 0; axis < 3; ++axis) middle += ijk[axis] / size % 3 == 1;
        if (middle >= 2) return false;
    }
    return true;
}

TEST(GeneratedMenger, IsAWholeSpongeOfPowersOfTwenty)
{
    for (const auto& [voxels, side] : {std::pair{8000, 27}, std::pair{160000, 81}}) {
        const auto grid = made(Shape::Menger, voxels);
        EXPECT_EQ(grid->activeVoxelCount(), uint64_t(voxels));
        EXPECT_EQ(boxOf(*grid), CoordBBox(Coord(0), Coord(side - 1)));
        expectRule(*grid, boxOf(*grid), isOnMenger);
    }
}

TEST(GeneratedMenger, IsAPartOfALargerSpongeOtherwise)
{
    for (const int voxels : {1000, 30000, 1000000}) {
        const auto grid = made(Shape::Menger, voxels);
        const CoordBBox box = boxOf(*grid);
        EXPECT_EQ(box.min(), Coord(0));
        EXPECT_TRUE(isNearCube(box.extents())) << box;
        expectRule(*grid, box, isOnMenger);
    }
}

/// A field's height in doubles, from the same random numbers.
double heightAt(uint64_t seed, int x, int y)
{
    const auto blend = [](double t) { return t * t * (3 - 2 * t); };
    double sum = 0;
    for (int bits = 3; bits <= 7; ++bits) {
        const int dim = 1 << bits, i = int(std::floor(double(x) / dim)),
                  j = int(std::floor(double(y) / dim));
        const auto corner = [&](int di, int dj) {
            const uint64_t place = uint64_t(uint32_t(i + di)) << 32 | uint32_t(j + dj);
            const uint64_t key = detail::hash(detail::hash(seed) + uint64_t(bits));
            return double(detail::hash(key ^ place) >> 52) / 4096;
        };
        const double u = blend(double(x - i * dim) / dim), v = blend(double(y - j * dim) / dim);
        sum += dim / 2
            * ((1 - v) * ((1 - u) * corner(0, 0) + u * corner(1, 0))
                + v * ((1 - u) * corner(0, 1) + u * corner(1, 1)));
    }
    return sum;
}

TEST(HeightField, IsTheSumOfItsOctaves)
{
    for (const uint64_t seed : {1, 7}) {
        const detail::HeightField field(seed);
        for (const int origin : {-200, 0, 1000}) {
            constexpr int kSide = 300;
            const std::vector<int> heights = field.heights(origin, origin + 5, kSide);
            for (int n = 0; n < kSide * kSide; ++n) {
                const double height = heightAt(seed, origin + n / kSide, origin + 5 + n % kSide);
                ASSERT_NEAR(heights[n] + 0.5, height, 1.3) << n << " seed " << seed;
                ASSERT_GE(heights[n], 0);
                ASSERT_LE(heights[n], detail::HeightField::kHighest);
            }
        }
    }
}

TEST(HeightField, IsTheSameThroughAnyWindow)
{
    const detail::HeightField field(3);
    const std::vector<int> all = field.heights(-20, 100, 90);
    for (int n = 0; n < 90 * 90; n += 7) {
        EXPECT_EQ(field.heights(-20 + n / 90, 100 + n % 90, 1).front(), all[n]);
    }
}

TEST(GeneratedTerrain, IsTheSheetAlongItsHeights)
{
    for (const int voxels : {1000, 200000}) {
        const auto grid = made(Shape::Terrain, voxels, 5);
        const Coord sides = boxOf(*grid).extents();
        EXPECT_EQ(sides[0], sides[1]);
        const int side = sides[0], wide = side + 2;
        const std::vector<int> heights = detail::HeightField(5).heights(-1, -1, wide);
        expectRule(*grid, CoordBBox(Coord(0), Coord(side - 1, side - 1, 127)), [&](const Coord& q) {
            const int at = (q[0] + 1) * wide + q[1] + 1;
            int lowest = heights[at];
            for (int dx : {-wide, 0, wide}) {
                for (int dy : {-1, 0, 1}) lowest = std::min(lowest, heights[at + dx + dy]);
            }
            return q[2] >= lowest && q[2] <= heights[at] + 2;
        });
    }
}

/// The voxels that can be reached from @a start by steps to the next one, while @a free.
uint64_t flood(const CoordBBox& box, const Coord& start, bool corners, const Rule& free,
    std::vector<bool>& reached)
{
    const Coord sides = box.extents();
    const auto index = [&](const Coord& q) {
        const Coord at = q - box.min();
        return (std::size_t(at[0]) * sides[1] + at[1]) * sides[2] + at[2];
    };
    reached.assign(box.volume(), false);
    std::vector<Coord> stack{start};
    reached[index(start)] = true;
    uint64_t count = 0;
    const CoordBBox steps(Coord(-1), Coord(1));
    for (; !stack.empty(); ++count) {
        const Coord from = stack.back();
        stack.pop_back();
        for (auto step = steps.begin(); step; ++step) {
            const Coord d = *step, to = from + d;
            if (!corners && std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]) > 1) continue;
            if (!box.isInside(to) || reached[index(to)] || !free(to)) continue;
            reached[index(to)] = true;
            stack.push_back(to);
        }
    }
    return count;
}

TEST(GeneratedTerrain, IsOnePartByFacesAndLetsNothingThroughByCorners)
{
    for (const uint64_t seed : {1, 2, 3}) {
        const auto grid = made(Shape::Terrain, 60000, seed);
        const auto accessor = grid->getConstAccessor();
        CoordBBox box = boxOf(*grid);
        box.min()[2] -= 1;
        box.max()[2] += 1;
        std::vector<bool> reached;
        const Rule on = [&](const Coord& q) { return accessor.isValueOn(q); };
        const Rule off = [&](const Coord& q) { return !accessor.isValueOn(q); };
        const Coord first = grid->tree().cbeginValueOn().getCoord();
        EXPECT_EQ(flood(box, first, false, on, reached), grid->activeVoxelCount());
        flood(box, box.max(), true, off, reached);
        const std::size_t below = 0; // the corner of the box
        EXPECT_FALSE(reached[below]) << "seed " << seed;
        EXPECT_TRUE(reached.back());
    }
}

TEST(GeneratedNoise, IsAHashOfCoordinatesAndSeed)
{
    for (const uint64_t seed : {0, 1}) {
        const auto grid = made(Shape::Noise, 3000, seed);
        // 300000 voxels: the sides as the header promises them.
        const CoordBBox box(Coord(0), Coord(66, 66, 66));
        expectRule(*grid, box, [&](const Coord& q) {
            const uint64_t place = uint64_t(q[0]) << 42 | uint64_t(q[1]) << 21 | uint64_t(q[2]);
            const bool on = detail::hash(detail::hash(seed) ^ place) < 184467440737095516u;
            return on;
        });
    }
}

TEST(GeneratedBall, IsTheDigitalBall)
{
    for (const int voxels : {1000, 5000, 70000, 1000000}) {
        const int64_t radiusSq = detail::SolidBall(voxels).radiusSq();
        const double volume = 4.18879020478639 * std::pow(double(radiusSq), 1.5);
        EXPECT_LE(volume, voxels * 1.000001);
        const int r = int(std::sqrt(double(radiusSq))) + 1;
        expectRule(*made(Shape::Ball, voxels), CoordBBox(Coord(-r), Coord(r)), [&](const Coord& q) {
            return int64_t(q[0]) * q[0] + int64_t(q[1]) * q[1] + int64_t(q[2]) * q[2] < radiusSq;
        });
    }
}

TEST(GeneratedBall, IsTilesInside)
{
    const auto grid = made(Shape::Ball, 113097336); // radius 300
    const auto& tree = grid->tree();
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) ASSERT_FALSE(leaf->isDense());
    EXPECT_EQ(tree.getValueDepth(Coord(0)), 1);         // a tile of 128^3
    EXPECT_EQ(tree.getValueDepth(Coord(0, 0, 280)), 2); // of 8^3
    EXPECT_TRUE(tree.isValueOn(Coord(0)));
    EXPECT_LT(tree.leafCount(), 40000u);
}

/// A cube of 4096^3 voxels and a bit more.
class FullCell : public detail::LeafwiseRule {
public:
    CoordBBox box() const override { return {Coord(-3, 0, 0), Coord(4095, 4095, 4095)}; }
    detail::Filling filling(const CoordBBox& cube) const override
    {
        if (cube.min()[0] >= 0) return detail::Filling::All;
        return cube.max()[1] < 8 && cube.max()[2] < 8  ? detail::Filling::Part
            : cube.min()[1] == 0 && cube.min()[2] == 0 ? detail::Filling::Part
                                                       : detail::Filling::None;
    }
    LeafMask leaf(const Coord&) const override
    {
        LeafMask full;
        full.fill(~uint64_t(0));
        return full;
    }
};

TEST(VoxelRule, FullNodesAreTilesAndLeavesAreClippedToTheBox)
{
    const auto tree = detail::treeOf(FullCell(), nullptr);
    EXPECT_EQ(tree->leafCount(), 1u);
    EXPECT_EQ(tree->getValueDepth(Coord(1, 2, 3)), 0); // a tile of the root
    EXPECT_EQ(tree->activeVoxelCount(), (uint64_t(1) << 36) + 3 * 64);
    EXPECT_TRUE(tree->isValueOn(Coord(-3, 7, 7)));
    EXPECT_FALSE(tree->isValueOn(Coord(-4, 7, 7)));
}

} // namespace
