// SPDX-License-Identifier: Apache-2.0
/// @file TestTransformsOracle.cc
/// @brief Distances, power labels and medial balls against the O(n^2) definition: on random
/// objects, and on every mask of 2x2x3 voxels.

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

namespace {

using namespace spheretree_test;

constexpr uint32_t kObjects = 550;

/// The 12 bits of @a mask as voxels of a box of 2x2x3 in the axis order given by its longest axis.
Voxels smallMask(uint32_t mask, int longAxis)
{
    Coord size(2, 2, 2);
    size[longAxis] = 3;
    Voxels voxels;
    uint32_t bit = 0;
    for (const Coord& voxel : shapes::box(size)) {
        if (mask >> bit++ & 1) voxels.push_back(voxel);
    }
    return voxels;
}

/// All masks but the empty one at once, far enough from each other that none touches the next.
void checkAllSmallMasks(int longAxis, const Coord& corner)
{
    constexpr uint32_t kCount = 1 << 12;
    const auto cell = [&](uint32_t mask) {
        return corner
            + Coord(int(mask & 15) * 16 - 128, int(mask >> 4 & 15) * 16 - 128,
                int(mask >> 8) * 16 - 128);
    };
    Voxels all;
    std::vector<NaiveReference> references;
    for (uint32_t mask = 1; mask < kCount; ++mask) {
        const Voxels voxels = smallMask(mask, longAxis);
        for (const Coord& voxel : voxels) all.push_back(voxel + cell(mask));
        references.emplace_back(voxels);
    }
    const CoreStages stages(*maskOf(all));
    ASSERT_EQ(stages.layout.voxelCount(), int64_t(all.size()));
    std::vector<NaiveReference::Ball> balls;
    for (uint32_t mask = 1; mask < kCount; ++mask) {
        const NaiveReference& reference = references[mask - 1];
        ASSERT_TRUE(agreeOnVoxels(reference, stages, cell(mask))) << "mask " << mask;
        for (const auto& ball : reference.balls()) {
            balls.push_back({ball.center + cell(mask), ball.radiusSq});
        }
    }
    std::sort(balls.begin(), balls.end(),
        [](const auto& a, const auto& b) { return a.center < b.center; });
    EXPECT_TRUE(agreeOnBalls(balls, stages.balls));
}

TEST(TransformsOracle, MatchesBruteForceOnEveryMaskOf2x2x3AcrossALeafCorner)
{
    checkAllSmallMasks(2, Coord(7, 7, 6));
}

TEST(TransformsOracle, MatchesBruteForceOnEveryMaskOf2x3x2AcrossALeafCorner)
{
    checkAllSmallMasks(1, Coord(7, 6, 7));
}

TEST(TransformsOracle, MatchesBruteForceOnEveryMaskOf3x2x2AcrossALeafCorner)
{
    checkAllSmallMasks(0, Coord(6, 7, 7));
}

TEST(TransformsOracle, MatchesBruteForceOnEveryMaskOf2x2x3InsideALeaf)
{
    checkAllSmallMasks(2, Coord(2, 3, 4));
}

TEST(TransformsOracle, MatchesBruteForceOnEveryMaskOf2x2x3AcrossTheOrigin)
{
    for (uint32_t mask = 1; mask < 1 << 12; ++mask) {
        const Voxels voxels = translated(smallMask(mask, 2), Coord(-1, -1, -1));
        ASSERT_TRUE(agree(NaiveReference(voxels), CoreStages(*maskOf(voxels)))) << "mask " << mask;
    }
}

TEST(TransformsOracle, MatchesBruteForceOnRandomObjects)
{
    int64_t voxels = 0;
    for (uint32_t seed = 0; seed < kObjects; ++seed) {
        const RandomObject object = randomObject(seed);
        const auto mask = maskOf(object.voxels);
        if (seed % 2) mask->prune(); // full leaves become tiles
        ASSERT_TRUE(agree(NaiveReference(object.voxels), CoreStages(*mask))) << object.name;
        voxels += int64_t(object.voxels.size());
    }
    EXPECT_GT(voxels, 100000) << "the objects have become too small to show anything";
}

TEST(TransformsOracle, MatchesBruteForceOnRandomObjectsInTwoDimensions)
{
    for (uint32_t seed = 1000; seed < 1000 + kObjects; ++seed) {
        const RandomObject object = randomObject(seed);
        const CoreStages stages(*maskOf(object.voxels), 2);
        ASSERT_TRUE(agree(NaiveReference(object.voxels, 2), stages)) << object.name;
    }
}

TEST(TransformsOracle, LineReferenceMatchesBruteForce)
{
    for (uint32_t seed = 2000; seed < 2110; ++seed) {
        const RandomObject object = randomObject(seed);
        const int dim = 2 + int(seed / 11 % 2);
        const NaiveReference naive(object.voxels, dim);
        const LineReference lines(object.voxels, dim);
        for (std::size_t i = 0; i < naive.voxels().size(); ++i) {
            ASSERT_EQ(lines.distSq(naive.voxels()[i]), naive.distSq(i)) << object.name;
        }
        std::vector<LineReference::Site> plane;
        int planeZ = lines.box().min()[2] - 1;
        for (std::size_t i = 0; i < naive.voxels().size(); ++i) {
            const Coord voxel = naive.voxels()[i];
            if (voxel[2] != planeZ) plane = lines.labelsOfPlane(planeZ = voxel[2]);
            ASSERT_EQ(lines.labelIn(plane, voxel).at, naive.label(i)) << object.name;
        }
    }
}

} // namespace
