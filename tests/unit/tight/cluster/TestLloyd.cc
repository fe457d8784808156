// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/cluster/Lloyd.h>

#include "support/RandomObjects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// In doubles: squares of the largest objects do not fit 64 bits.
double distanceSq(const VoxelBlock& point, const FineCenter& center)
{
    double sum = 0;
    for (int a = 0; a < 3; ++a) {
        const auto apart = double(point.center[a] - center[a]);
        sum += apart * apart;
    }
    return sum;
}

std::size_t nearestOf(const VoxelBlock& point, const std::vector<FineCenter>& centers)
{
    std::size_t best = 0;
    for (std::size_t c = 1; c < centers.size(); ++c) {
        if (distanceSq(point, centers[c]) < distanceSq(point, centers[best])) best = c;
    }
    return best;
}

std::vector<VoxelBlock> randomPoints(int count, int64_t size, Random& random)
{
    std::vector<VoxelBlock> points;
    for (int i = 0; i < count; ++i) {
        constexpr int kParts = 1 << 20;
        const auto at = [&] { return size * random.between(0, kParts) / kParts - size / 2; };
        points.push_back({{at(), at(), at()}, random.between(1, 9)});
    }
    return points;
}

TEST(Lloyd, EveryCenterIsInTheMiddleOfThePointsNearestToIt)
{
    Random random(1);
    const auto points = randomPoints(300, 4000, random);
    for (uint64_t seed = 0; seed < 4; ++seed) {
        const auto centers = clusterCenters(points, 7, seed);
        ASSERT_EQ(centers.size(), 7u);
        std::vector<std::array<double, 4>> sums(centers.size());
        for (const VoxelBlock& point : points) {
            auto& sum = sums[nearestOf(point, centers)];
            for (int a = 0; a < 3; ++a) sum[a] += double(point.voxels * point.center[a]);
            sum[3] += double(point.voxels);
        }
        for (std::size_t c = 0; c < centers.size(); ++c) {
            ASSERT_GT(sums[c][3], 0);
            for (int a = 0; a < 3; ++a) {
                EXPECT_NEAR(double(centers[c][a]), sums[c][a] / sums[c][3], 0.51);
            }
        }
    }
}

TEST(Lloyd, FindsClustersThatLieApart)
{
    Random random(2);
    std::vector<VoxelBlock> points;
    for (int cluster = 0; cluster < 5; ++cluster) {
        for (VoxelBlock point : randomPoints(40, 100, random)) {
            point.center[cluster % 3] += 10000 * (cluster + 1);
            points.push_back(point);
        }
    }
    const auto centers = clusterCenters(points, 5, 0);
    std::set<std::size_t> used;
    for (int cluster = 0; cluster < 5; ++cluster) {
        const std::size_t first = nearestOf(points[40 * cluster], centers);
        for (int i = 0; i < 40; ++i) {
            EXPECT_EQ(nearestOf(points[40 * cluster + i], centers), first);
        }
        used.insert(first);
    }
    EXPECT_EQ(used.size(), 5u);
}

TEST(Lloyd, ThereAreNoMoreClustersThanPoints)
{
    const std::vector<VoxelBlock> points{{{0, 0, 0}, 1}, {{160, 0, 0}, 3}, {{0, 0, 0}, 2}};
    for (uint64_t seed = 0; seed < 4; ++seed) {
        auto centers = clusterCenters(points, 8, seed);
        std::sort(centers.begin(), centers.end());
        EXPECT_EQ(centers, (std::vector<FineCenter>{{0, 0, 0}, {160, 0, 0}}));
    }
}

TEST(Lloyd, OtherSeedsBeginElsewhere)
{
    Random random(3);
    const auto points = randomPoints(400, 4000, random);
    std::set<std::vector<FineCenter>> found;
    for (uint64_t seed = 0; seed < 6; ++seed) found.insert(clusterCenters(points, 12, seed));
    EXPECT_GT(found.size(), 3u);
    EXPECT_EQ(clusterCenters(points, 12, 5), clusterCenters(points, 12, 5));
}

/// Coordinates are coarser then.
TEST(Lloyd, TakesObjectsOfAnySize)
{
    Random random(4);
    const int64_t size = int64_t(1) << 35;
    const auto points = randomPoints(100, size, random);
    for (const FineCenter& center : clusterCenters(points, 9, 1)) {
        for (int a = 0; a < 3; ++a) EXPECT_LE(std::abs(center[a]), size / 2);
    }
    const auto centers = clusterCenters(points, 100, 1);
    for (const VoxelBlock& point : points) {
        EXPECT_LT(
            distanceSq(point, centers[nearestOf(point, centers)]), (size >> 12) * (size >> 12));
    }
}

} // namespace
