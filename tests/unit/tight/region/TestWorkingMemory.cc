// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/region/WorkingMemory.h>

#include "support/Messages.h"

#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include "support/FineBalls.h"

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// @param rate  1: a box
void expectEnoughForRegions(double rate)
{
    Random random(1);
    const Voxels voxels = shapes::noise(Coord(72, 64, 48), rate, random);
    const SampledObject object(LeafLayout(*maskOf(voxels)));
    const SampleLevel& level = object.level(0);
    for (const int radius : {3, 30, 200, 900}) {
        std::vector<ExactSphere> balls;
        for (int i = 0; i < 50; ++i) {
            const Coord at = voxels[std::size_t(random.between(0, int(voxels.size()) - 1))];
            ExactSphere& ball = balls.emplace_back(voxelBall(at));
            ball.radiusSq = int64_t(radius) * radius;
        }
        double taken = 0;
        for (const VoxelRegion& region : regionsOf(balls, level, nullptr)) {
            std::size_t whole = 0;
            for (const RegionLeaf part : region) whole += part.mask == level.mask(part.leaf);
            taken += regionBytes(double(region.size()), double(whole));
        }
        WorkingMemory estimate;
        estimate.addRegions(balls, level.leafCount());
        EXPECT_GE(estimate.bytes, taken);
        EXPECT_LE(estimate.bytes, 2 * regionBytes(50 * double(level.leafCount()), 0));
    }
}

TEST(WorkingMemory, OfRegionsIsNotLessThanTheyTake)
{
    expectEnoughForRegions(0.7);
    expectEnoughForRegions(1);
}

TEST(WorkingMemory, AddsUpAndIsRefusedWithBothNumbers)
{
    WorkingMemory some;
    some.addSamples(1000);
    const double samples = some.bytes;
    EXPECT_GE(samples, 1000 * 72);
    some.addMerging(10000);
    EXPECT_GE(some.bytes - samples, 1200 * 10000);
    EXPECT_NO_THROW(some.require(int64_t(some.bytes) + 1, "things"));
    EXPECT_NO_THROW(some.require(0, "things"));
    const std::string why =
        messageOf<openvdb::ValueError>([&] { some.require(1 << 20, "some things"); });
    EXPECT_TRUE(mentions(why, "some things need about 14.")) << why;
    EXPECT_TRUE(mentions(why, "memory= allows 1 MiB: allow more, use a larger voxel")) << why;
    some.bytes = 1e18;
    EXPECT_THROW(some.require(0, "things"), openvdb::ValueError);
}

} // namespace
