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

void expectEnoughForRegions(const Voxels& voxels)
{
    Random random(1);
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
            taken += double(region.bytes());
        }
        WorkingMemory known, guessed;
        known.addRegions(balls, level, nullptr);
        guessed.guessRegions(balls, level.leafCount());
        EXPECT_GE(known.bytes, 2 * taken); // of two levels
        EXPECT_LE(known.bytes, 2.5 * regionBytes(50 * double(level.leafCount()), 0));
        EXPECT_GE(guessed.bytes, taken);
        EXPECT_LE(guessed.bytes, 2.5 * regionBytes(50 * double(level.leafCount()), 0));
    }
}

/// @return the surface of a ball around 0: its leaf nodes lie where a ball as large holds parts of them.
Voxels shell(int radius)
{
    Voxels voxels;
    for (const Coord& v : CoordBBox(Coord(-radius), Coord(radius))) {
        const int square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
        if (square <= radius * radius && square > (radius - 2) * (radius - 2)) voxels.push_back(v);
    }
    return voxels;
}

TEST(WorkingMemory, OfRegionsIsNotLessThanTheyTake)
{
    Random random(1);
    expectEnoughForRegions(shapes::noise(Coord(72, 64, 48), 0.7, random));
    expectEnoughForRegions(shapes::noise(Coord(72, 64, 48), 1, random));
    expectEnoughForRegions(shell(40));
}

TEST(WorkingMemory, OfRegionsIsEnoughWhereABallHoldsPartsOfAllLeafNodes)
{
    const Voxels voxels = shell(60);
    const SampledObject object(LeafLayout(*maskOf(voxels)));
    const SampleLevel& level = object.level(0);
    const std::vector<ExactSphere> balls(3, ExactSphere{{0, 0, 0}, kFine * kFine * 59 * 59});
    double taken = 0;
    for (const VoxelRegion& region : regionsOf(balls, level, nullptr))
        taken += double(region.bytes());
    WorkingMemory known, guessed;
    known.addRegions(balls, level, nullptr);
    guessed.guessRegions(balls, level.leafCount());
    EXPECT_GE(known.bytes, 2 * taken);
    EXPECT_GE(guessed.bytes, 2 * taken);
}

/// Balls around the cells of a grid: no cover of a solid by balls of one size overlaps more.
TEST(WorkingMemory, OfACoverIsEnoughForBallsOfAnySizeInASolid)
{
    constexpr int kSide = 256;
    openvdb::MaskTree solid;
    solid.fill(openvdb::CoordBBox::createCube(Coord(0), kSide), true);
    const SampledObject object((LeafLayout(solid)));
    for (int apart = 8; apart <= kSide; apart *= 2) {
        std::vector<ExactSphere> balls;
        const int64_t half = kFine * apart / 2;
        for (int64_t x = half; x < kFine * kSide; x += 2 * half) {
            for (int64_t y = half; y < kFine * kSide; y += 2 * half) {
                for (int64_t z = half; z < kFine * kSide; z += 2 * half) {
                    balls.push_back({{x, y, z}, 3 * half * half});
                }
            }
        }
        WorkingMemory known, guessed;
        known.addRegions(balls, object.level(0), nullptr);
        guessed.guessCover(double(balls.size()), object.level(0).leafCount(), 3);
        EXPECT_GE(guessed.bytes, known.bytes) << apart;
        EXPECT_LE(guessed.bytes, 12 * known.bytes) << apart;
    }
}

TEST(WorkingMemory, AddsUpAndIsRefusedWithBothNumbers)
{
    WorkingMemory some;
    some.addSamples(1000, 3);
    const double samples = some.bytes;
    EXPECT_GE(samples, 1000 * 72);
    // A leaf's mask, origin and column, of levels that each have a quarter of the leaves of the one before.
    EXPECT_GE(WorkingMemory().addSamples(1000, 2).bytes, 1000 * 80 * 4.0 / 3);
    some.addMerging(10000);
    EXPECT_GE(some.bytes - samples, 1200 * 10000);
    EXPECT_NO_THROW(some.require(int64_t(some.bytes) + 1, "things"));
    EXPECT_NO_THROW(some.require(0, "things"));
    const std::string why =
        messageOf<openvdb::ValueError>([&] { some.require(1 << 20, "some things"); });
    EXPECT_TRUE(mentions(why, "some things need about 14.")) << why;
    EXPECT_TRUE(mentions(why, "memory= allows 1 MiB: try memory=14.")) << why;
    EXPECT_TRUE(mentions(why, "MiB, use a larger voxel")) << why;
    some.bytes = 1e18;
    EXPECT_THROW(some.require(0, "things"), openvdb::ValueError);
}

} // namespace
