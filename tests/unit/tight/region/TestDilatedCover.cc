// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/region/DilatedCover.h>

#include <openvdb_spheretree/tight/region/BallPruning.h>

#include "support/MergedLeaves.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// Dilated by the least that rounding to whole sixteenths of a voxel allows.
ExactSphere dilated(const ExactSphere& ball, int64_t by)
{
    auto radius = int64_t(std::sqrt(double(ball.radiusSq)));
    while (radius * radius < ball.radiusSq) ++radius;
    ExactSphere large = ball;
    large.radiusSq = (radius + by) * (radius + by);
    return large;
}

/// One ball after the other, smallest first, goes if the others that are there hold its voxels.
std::vector<ExactSphere> naivelyPruned(const std::vector<ExactSphere>& balls, const Voxels& voxels)
{
    std::vector<std::size_t> order(balls.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
        [&](std::size_t a, std::size_t b) { return balls[a].radiusSq < balls[b].radiusSq; });
    std::vector<bool> isThere(balls.size(), true);
    for (const std::size_t i : order) {
        const auto inOther = [&](const Coord& v) {
            for (std::size_t k = 0; k < balls.size(); ++k) {
                if (k != i && isThere[k] && holds(balls[k], v)) return true;
            }
            return false;
        };
        isThere[i] = std::any_of(voxels.begin(), voxels.end(),
            [&](const Coord& v) { return holds(balls[i], v) && !inOther(v); });
    }
    std::vector<ExactSphere> left;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        if (isThere[i]) left.push_back(balls[i]);
    }
    return left;
}

/// The balls of which a dilated cover is one, all dilated by the same length.
/// @return that length, 1/16 voxel; -1 if it is none
int64_t dilationOf(const std::vector<ExactSphere>& cover, const std::vector<ExactSphere>& balls,
    const Voxels& voxels)
{
    for (int64_t by = 1; by <= kFine; ++by) {
        std::vector<ExactSphere> large;
        for (const ExactSphere& ball : balls) large.push_back(dilated(ball, by));
        if (naivelyPruned(large, voxels) == cover) return by;
    }
    return -1;
}

TEST(DilatedCover, IsOfBallsDilatedByOneLengthAndPruned)
{
    Random random(1);
    for (const double rate : {0.4, 0.7, 0.95}) {
        const MergedLeaves merged(shapes::noise(Coord(12, 10, 9), rate, random));
        const auto all = int64_t(merged.leaves.size());
        for (const int64_t part : {2, 3, 5}) {
            const auto cover =
                dilatedCover(merged.leaves, all / part, 1, merged.object.level(0), nullptr);
            EXPECT_EQ(heldBy(cover, merged.voxels), merged.voxels);
            if (cover != merged.leaves)
                EXPECT_GT(dilationOf(cover, merged.leaves, merged.voxels), 0);
            else EXPECT_LT(part, 5); // dilated by little, all may be needed
        }
    }
}

/// An ellipsoid: of a solid, whose balls are near each other. Noise has others.
TEST(DilatedCover, OfASolidHasAboutAsManyBallsAsAreAimedAt)
{
    Voxels voxels;
    for (const Coord& v : voxelsOfBox(CoordBBox(Coord(-24, -17, -11), Coord(24, 17, 11)))) {
        const double x = v[0] / 24.0, y = v[1] / 17.0, z = v[2] / 11.0;
        if (x * x + y * y + z * z < 1) voxels.push_back(v);
    }
    sortVoxels(voxels);
    const SampledObject object = sampled(voxels);
    const std::vector<ExactSphere> all = fineBalls(CoreStages(*maskOf(voxels)).balls);
    std::vector<ExactSphere> leaves;
    for (const int32_t i : prunedBalls(all, object.level(0), nullptr)) leaves.push_back(all[i]);
    for (const double part : {1.5, 2.0, 3.0}) {
        const double aim = double(leaves.size()) / part;
        const auto cover = dilatedCover(leaves, int64_t(aim), 1, object.level(0), nullptr);
        EXPECT_GT(double(cover.size()), 0.6 * aim);
        EXPECT_LT(double(cover.size()), 1.5 * aim);
        EXPECT_EQ(heldBy(cover, voxels), voxels);
    }
}

TEST(DilatedCover, HasAtLeastAsManyBallsAsAreAskedFor)
{
    Random random(3);
    const MergedLeaves merged(shapes::noise(Coord(12, 10, 9), 0.8, random));
    const auto all = int64_t(merged.leaves.size());
    const auto coverOf = [&](int64_t least) {
        return dilatedCover(merged.leaves, all / 5, least, merged.object.level(0), nullptr);
    };
    const auto fewest = int64_t(coverOf(1).size());
    for (const int64_t least : {fewest, fewest + 1, (fewest + all) / 2, all}) {
        const auto cover = coverOf(least);
        EXPECT_GE(int64_t(cover.size()), least);
        EXPECT_EQ(heldBy(cover, merged.voxels), merged.voxels);
    }
    EXPECT_EQ(coverOf(fewest).size(), std::size_t(fewest));
    EXPECT_EQ(coverOf(all), merged.leaves);
}

} // namespace
