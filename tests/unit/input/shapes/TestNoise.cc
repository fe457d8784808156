// SPDX-License-Identifier: Apache-2.0
/// @file TestNoise.cc
/// @brief Generated noise against what it claims: single voxels at random, one in a hundred.

#include "support/GeneratedShapes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// For a sum of @a trials independent voxels of chance @a p: within six standard deviations, which
/// one sum in 5e8 is not.
void expectLikely(int64_t count, double trials, double p, const std::string& what)
{
    EXPECT_NEAR(double(count), trials * p, 6 * std::sqrt(trials * p * (1 - p)) + 1) << what;
}

constexpr int kSide = 67; // of 3000 voxels: the cube of 300000, as the header promises it
constexpr double kShare = 0.01;

CoordBBox noiseBox(int side) { return CoordBBox(Coord(0), Coord(side - 1)); }

TEST(GeneratedNoise, IsAHundredthOfItsCubeEvenlyInEveryPlane)
{
    for (const uint64_t seed : {0, 1, 2}) {
        const auto grid = made(Shape::Noise, 3000, seed);
        std::vector<std::array<int, 3>> planes(kSide);
        for (auto voxel = grid->cbeginValueOn(); voxel; ++voxel) {
            ASSERT_TRUE(noiseBox(kSide).isInside(voxel.getCoord()));
            for (int axis = 0; axis < 3; ++axis) ++planes[voxel.getCoord()[axis]][axis];
        }
        expectLikely(int64_t(grid->activeVoxelCount()), kSide * kSide * kSide, kShare, "all");
        for (int i = 0; i < kSide; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                expectLikely(planes[i][axis], kSide * kSide, kShare,
                    "plane " + std::to_string(i) + " of axis " + std::to_string(axis));
            }
        }
    }
}

/// Neighbours, and the planes at distances of powers of two, where bits of a hash might meet.
TEST(GeneratedNoise, VoxelsAreIndependentOfThoseNearby)
{
    const auto grid = made(Shape::Noise, 3000, 1);
    const auto accessor = grid->getConstAccessor();
    for (int axis = 0; axis < 3; ++axis) {
        for (const Coord& across : {Coord(0), Coord(1), Coord(-1, 1, 0), Coord(0, -1, 1)}) {
            for (int away = 1; away <= 32; away *= 2) {
                Coord step = across;
                step[axis] += away;
                int64_t pairs = 0;
                for (auto voxel = grid->cbeginValueOn(); voxel; ++voxel) {
                    pairs += accessor.isValueOn(voxel.getCoord() + step);
                }
                const double trials = double(kSide - std::abs(step[0]))
                    * (kSide - std::abs(step[1])) * (kSide - std::abs(step[2]));
                std::ostringstream what;
                what << "pairs at " << step;
                expectLikely(pairs, trials, kShare * kShare, what.str());
            }
        }
    }
}

TEST(GeneratedNoise, SeedsAreIndependent)
{
    const auto grid = made(Shape::Noise, 3000, 0);
    for (const uint64_t seed : {uint64_t(1), uint64_t(2), uint64_t(1) << 32, ~uint64_t(0)}) {
        const auto other = made(Shape::Noise, 3000, seed)->deepCopy();
        other->topologyIntersection(*grid);
        expectLikely(int64_t(other->activeVoxelCount()), kSide * kSide * kSide, kShare * kShare,
            "seed " + std::to_string(seed));
    }
}

TEST(GeneratedNoise, IsAWindowOfTheSameNoiseWhateverItsSize)
{
    const auto small = made(Shape::Noise, 3000, 5), large = made(Shape::Noise, 20000, 5);
    const auto inSmall = small->getConstAccessor();
    const auto inLarge = large->getConstAccessor();
    EXPECT_GT(large->activeVoxelCount(), small->activeVoxelCount());
    for (const Coord& q : noiseBox(kSide)) {
        ASSERT_EQ(inSmall.isValueOn(q), inLarge.isValueOn(q)) << q;
    }
}

} // namespace
