// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/region/CoarseObject.h>

#include "support/CoreStages.h"
#include "support/FineBalls.h"

#include <openvdb_spheretree/voxel/Masks.h>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

CoarseObject coarseOf(
    const Voxels& voxels, int64_t leastBalls, int dim = 3, int64_t enough = INT64_MAX)
{
    SphereTreeSettings settings;
    settings.dim = dim;
    StageSeconds seconds;
    return coarseObject(maskOf(voxels), settings, {leastBalls, enough}, nullptr, &seconds);
}

TEST(CoarseObject, IsTheCoarsestLevelWithEnoughLeafBalls)
{
    Random random(1);
    const Voxels voxels = shapes::noise(Coord(60, 50, 40), 0.02, random);
    std::size_t levels = 0;
    for (const int64_t least : {10000000, 1000, 300, 50, 1}) {
        const CoarseObject object = coarseOf(voxels, least);
        ASSERT_EQ(object.levels.size(), object.steps.size() + 1);
        EXPECT_GE(object.levels.size(), levels);
        levels = object.levels.size();
        const auto found = int64_t(object.leaves.balls.size());
        EXPECT_TRUE(found >= least || object.steps.empty());
        EXPECT_EQ(object.leaves.digital.size(), object.leaves.balls.size());
        Voxels last;
        for (std::size_t leaf = 0; leaf < object.samples.level(0).leafCount(); ++leaf) {
            const SampleLevel& level = object.samples.level(0);
            for (const Coord& v : voxelsOf(level.mask(leaf), level.origin(leaf))) last.push_back(v);
        }
        EXPECT_EQ(int64_t(last.size()), int64_t(object.levels.back()->activeVoxelCount()));
        for (const Coord& v : last) EXPECT_TRUE(object.levels.back()->isValueOn(v));
        for (std::size_t k = 0; k < object.steps.size(); ++k) {
            for (auto it = object.levels[k]->cbeginValueOn(); it; ++it) {
                EXPECT_TRUE(
                    object.levels[k + 1]->isValueOn(object.steps[k].parentVoxel(it.getCoord())));
            }
        }
        for (const ExactSphere& ball : object.leaves.balls) {
            EXPECT_TRUE(object.levels.back()->isValueOn(Coord(int(ball.center[0] / kFine),
                int(ball.center[1] / kFine), int(ball.center[2] / kFine))));
        }
    }
    EXPECT_GT(levels, 3u);
}

/// A ball has few leaf balls at any resolution.
TEST(CoarseObject, IsNoFinerThanItHasToBe)
{
    const Voxels ball = shapes::ball(900);
    EXPECT_EQ(coarseOf(ball, 5000).steps.size(), 0u);
    const CoarseObject object = coarseOf(ball, 5000, 3, 1000);
    EXPECT_EQ(object.steps.size(), 2u);
    EXPECT_GE(object.levels.back()->activeVoxelCount(), 1000u);
}

TEST(CoarseObject, OfAFlatObjectStaysFlat)
{
    Random random(2);
    const CoarseObject object = coarseOf(shapes::noise(Coord(90, 80, 1), 0.3, random), 40, 2);
    ASSERT_GT(object.steps.size(), 0u);
    for (const PyramidStep& step : object.steps) EXPECT_EQ(step.dim, 2);
    for (const ExactSphere& ball : object.leaves.balls) EXPECT_EQ(ball.center[2], 0);
}

} // namespace
