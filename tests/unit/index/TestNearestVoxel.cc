// SPDX-License-Identifier: Apache-2.0
/// @file TestNearestVoxel.cc
/// @brief Nearest-voxel queries against a look at every voxel.

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/index/NearestVoxel.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace spheretree_test;
using openvdb::MaskTree;
using openvdb_spheretree::Distance;
using openvdb_spheretree::detail::NearestVoxel;

/// |2 q - point2|^2 of the voxel that is nearest.
int64_t nearestByHand(const Voxels& voxels, const int64_t point2[3])
{
    int64_t least = std::numeric_limits<int64_t>::max();
    for (const Coord& q : voxels) {
        int64_t sum = 0;
        for (int a = 0; a < 3; ++a) sum += (2 * q[a] - point2[a]) * (2 * q[a] - point2[a]);
        least = std::min(least, sum);
    }
    return least;
}

void expectAnswers(const NearestVoxel& nearest, const int64_t point2[3], int64_t expected)
{
    ASSERT_EQ(nearest.distSq(point2, 0), expected);
    ASSERT_EQ(nearest.distSq(point2, expected - 1), expected);
    for (int64_t enough : {expected, expected + 1, 2 * expected + 7}) {
        const int64_t answer = nearest.distSq(point2, enough);
        ASSERT_GE(answer, expected);
        ASSERT_LE(answer, enough);
        ASSERT_TRUE(nearest.anyWithin(point2, enough));
    }
    ASSERT_FALSE(nearest.anyWithin(point2, expected - 1));
    ASSERT_FALSE(nearest.anyWithin(point2, expected / 2 - 1));
}

/// Points at voxel centres, up to @a around voxels outside the box.
void expectLikeBruteForce(const MaskTree& mask, Random& random, int around, int points)
{
    const NearestVoxel nearest(mask);
    const Voxels voxels = voxelsOf(mask);
    const CoordBBox box = boxOf(voxels);
    for (int i = 0; i < points; ++i) {
        int64_t point2[3];
        for (int a = 0; a < 3; ++a) {
            point2[a] = 2 * random.between(box.min()[a] - around, box.max()[a] + around);
        }
        SCOPED_TRACE(
            testing::Message() << point2[0] << ' ' << point2[1] << ' ' << point2[2] << " / 2");
        const int64_t expected = nearestByHand(voxels, point2);
        expectAnswers(nearest, point2, expected);
        const Coord point(int32_t(point2[0] / 2), int32_t(point2[1] / 2), int32_t(point2[2] / 2));
        Coord voxel;
        ASSERT_EQ(nearest.nearest(point, voxel), expected);
        ASSERT_TRUE(mask.isValueOn(voxel));
        const Coord d = voxel - point;
        ASSERT_EQ(4 * Distance().lengthSq(d[0], d[1], d[2]), expected);
    }
}

TEST(NearestVoxel, MatchesBruteForceOnRandomObjects)
{
    Random random(1);
    for (uint32_t seed = 0; seed < 66; ++seed) {
        const RandomObject object = randomObject(seed);
        SCOPED_TRACE(object.name);
        const auto mask = maskOf(object.voxels);
        expectLikeBruteForce(*mask, random, 6, 40);
        expectLikeBruteForce(*mask, random, 200, 10);
    }
}

TEST(NearestVoxel, MatchesBruteForceOnVoxelsScatteredOverManyLeaves)
{
    Random random(2);
    for (int spread : {20, 100, 400}) {
        Voxels voxels;
        for (int i = 0; i < 300; ++i) voxels.push_back(random.coord(-spread, spread));
        expectLikeBruteForce(*maskOf(voxels), random, spread, 200);
    }
}

/// Solid boxes of voxels count as boxes there, whose inner points are all at distance 0.
TEST(NearestVoxel, BetweenVoxelsDistancesAreAtMostHalfADiagonalTooShort)
{
    Random random(4);
    for (uint32_t seed = 0; seed < 66; ++seed) {
        const RandomObject object = randomObject(seed);
        SCOPED_TRACE(object.name);
        const NearestVoxel nearest(*maskOf(object.voxels));
        const CoordBBox box = boxOf(object.voxels);
        for (int i = 0; i < 40; ++i) {
            int64_t point2[3];
            for (int a = 0; a < 3; ++a) {
                point2[a] = random.between(2 * box.min()[a] - 9, 2 * box.max()[a] + 9);
            }
            const int64_t expected = nearestByHand(object.voxels, point2);
            const int64_t answer = nearest.distSq(point2, 0);
            ASSERT_LE(answer, expected);
            ASSERT_GE(std::sqrt(double(answer)) + std::sqrt(3.0), std::sqrt(double(expected)));
            ASSERT_TRUE(nearest.anyWithin(point2, answer));
            ASSERT_FALSE(nearest.anyWithin(point2, answer - 1));
        }
    }
}

TEST(NearestVoxel, TilesAreAllOfTheirVoxels)
{
    Random random(3);
    MaskTree mask(false);
    mask.addTile(1, Coord(-8, 0, 16), true, true); // 8^3
    mask.addTile(1, Coord(8, 16, -16), true, true);
    mask.setValueOn(Coord(3, 5, -9));
    expectLikeBruteForce(mask, random, 40, 300);

    MaskTree large(false);
    large.addTile(2, Coord(128, 0, 0), true, true); // 128^3
    const int64_t before[3] = {2 * 127, 2 * 127, 0}, behind[3] = {2 * 256, 2 * 128, -2};
    expectAnswers(NearestVoxel(large), before, 4);
    Coord voxel;
    const Coord at(int32_t(before[0] / 2), int32_t(before[1] / 2), int32_t(before[2] / 2));
    EXPECT_EQ(NearestVoxel(large).nearest(at, voxel), 4);
    const Coord step = voxel - at;
    EXPECT_EQ(Distance().lengthSq(step[0], step[1], step[2]), 1);
    EXPECT_TRUE(large.isValueOn(voxel));
    expectAnswers(NearestVoxel(large), behind, 12);
}

TEST(NearestVoxel, OfNoVoxelsNoneIsNear)
{
    const NearestVoxel nothing((MaskTree(false)));
    const int64_t point2[3] = {0, 0, 0};
    EXPECT_EQ(nothing.distSq(point2, 0), std::numeric_limits<int64_t>::max());
    EXPECT_FALSE(nothing.anyWithin(point2, std::numeric_limits<int64_t>::max() - 1));
}

TEST(NearestVoxel, DistancesAreExactUpTo2To29VoxelsAnAxisAndAtLeastThatBeyond)
{
    constexpr int64_t kFar2 = NearestVoxel::kFar2;
    const NearestVoxel nearest(*maskOf(Voxels{Coord(0, 0, 0), Coord(40, 40, 40)}));
    const int64_t within[3] = {-kFar2, 1 - kFar2, 2 - kFar2};
    const int64_t sum = kFar2 * kFar2 + (kFar2 - 1) * (kFar2 - 1) + (kFar2 - 2) * (kFar2 - 2);
    EXPECT_EQ(nearest.distSq(within, 0), sum);
    EXPECT_FALSE(nearest.anyWithin(within, sum - 1));
    for (int64_t beyond : {-kFar2 - 1, -4 * kFar2, 4 * kFar2}) {
        const int64_t alongX[3] = {beyond, 0, 0}, diagonal[3] = {beyond, beyond, beyond};
        EXPECT_GE(nearest.distSq(alongX, 0), kFar2 * kFar2);
        EXPECT_GE(nearest.distSq(diagonal, 0), kFar2 * kFar2);
        EXPECT_FALSE(nearest.anyWithin(alongX, kFar2 * kFar2 - 1));
        EXPECT_FALSE(nearest.anyWithin(diagonal, kFar2 * kFar2 - 1));
    }
}

/// Whether the block is of the solid: all voxels that it is made of are there.
bool isOfSolid(const NearestVoxel::Block& block, const MaskTree& mask)
{
    const auto voxel = [](const double* corner, double inward) {
        return Coord(int(corner[0] + inward), int(corner[1] + inward), int(corner[2] + inward));
    };
    CoordBBox box(voxel(block.lo, 0.5), voxel(block.hi, -0.5));
    for (auto q = box.begin(); q; ++q) {
        if (!mask.isValueOn(*q)) return false;
    }
    return !box.empty();
}

TEST(NearestVoxel, FindsABlockOfTheSolidThatIsNearestToAnyPoint)
{
    Random random(5);
    for (int turn = 0; turn < 40; ++turn) {
        Voxels voxels;
        for (int i = 0; i < (turn % 4 == 0 ? 2 : 90); ++i) {
            voxels.push_back(
                Coord(random.between(-9, 9), random.between(-9, 9), random.between(-9, 9)));
        }
        const auto mask = maskOf(voxels);
        if (turn % 3 == 0) mask->addTile(1, Coord(8, 0, 0), true, true);
        voxels = voxelsOf(*mask);
        const Distance distance = turn % 5 == 4 ? Distance::chamfer(3, 4, 5) : Distance();
        const NearestVoxel nearest(*mask, distance);
        NearestVoxel::Block block; // stays from point to point
        for (int i = 0; i < 200; ++i) {
            double point[3], least = std::numeric_limits<double>::infinity();
            for (double& p : point) p = random.between(-400, 400) / 32.0;
            for (const Coord& q : voxels) {
                double gap[3];
                for (int a = 0; a < 3; ++a) gap[a] = std::max(std::abs(point[a] - q[a]) - 0.5, 0.0);
                least = std::min(least, distance.length(gap[0], gap[1], gap[2]));
            }
            if (i % 7 == 0) block = {};
            ASSERT_DOUBLE_EQ(nearest.nearestBlock(point, block), least);
            ASSERT_TRUE(isOfSolid(block, *mask));
            double gap[3];
            for (int a = 0; a < 3; ++a) {
                gap[a] = std::max({block.lo[a] - point[a], point[a] - block.hi[a], 0.0});
            }
            ASSERT_DOUBLE_EQ(distance.length(gap[0], gap[1], gap[2]), least);
        }
    }
}

} // namespace
