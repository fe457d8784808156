// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include "support/FineBalls.h"

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

Voxels samplesOf(const SampleLevel& level)
{
    Voxels samples;
    for (std::size_t leaf = 0; leaf < level.leafCount(); ++leaf) {
        for (const Coord& v : voxelsOf(level.mask(leaf), level.origin(leaf))) samples.push_back(v);
    }
    sortVoxels(samples);
    return samples;
}

Voxels everySecondOf(const Voxels& voxels)
{
    Voxels samples;
    for (const Coord& v : voxels) {
        const bool even = v[0] % 2 == 0 && v[1] % 2 == 0 && v[2] % 2 == 0;
        if (even) samples.emplace_back(v[0] / 2, v[1] / 2, v[2] / 2);
    }
    return samples;
}

TEST(SampledObject, HasEverySecondSampleOnTheNextLevel)
{
    for (uint32_t seed = 0; seed < 66; ++seed) {
        const RandomObject random = randomObject(seed);
        const SampledObject object = sampled(random.voxels);
        Voxels expected = random.voxels;
        for (int k = 0; k < object.levels() + 2; ++k) {
            ASSERT_EQ(samplesOf(object.level(k)), expected) << random.name << ", level " << k;
            expected = everySecondOf(expected);
        }
        ASSERT_LE(object.levels(), 32);
    }
}

/// An odd z would be on no other level.
TEST(SampledObject, OfAFlatObjectKeepsItsPlane)
{
    Random random(4);
    for (const int z : {-5, -1, 0, 3, 8, 23}) {
        Voxels expected;
        for (const Coord& v : shapes::noise(Coord(40, 30, 1), 0.4, random)) {
            expected.emplace_back(v[0] - 9, v[1] - 4, z);
        }
        sortVoxels(expected);
        const SampledObject object(openvdb_spheretree::LeafLayout(*maskOf(expected)), true);
        for (int k = 0; k < object.levels(); ++k) {
            ASSERT_EQ(samplesOf(object.level(k)), expected) << "z = " << z << ", level " << k;
            ASSERT_EQ(object.plane(k), z >> k);
            Voxels next;
            for (const Coord& v : expected) {
                const bool even = v[0] % 2 == 0 && v[1] % 2 == 0;
                if (even) next.emplace_back(v[0] / 2, v[1] / 2, v[2] >> 1);
            }
            expected = next;
        }
        EXPECT_FALSE(
            sampled(voxelsOf(object.level(0).mask(0), object.level(0).origin(0))).plane(0));
    }
}

TEST(SampledObject, OfTheOriginHasItOnEveryLevel)
{
    const SampledObject object = sampled({Coord(0, 0, 0)});
    for (const int k : {0, 1, 5, 31}) {
        EXPECT_EQ(samplesOf(object.level(k)), Voxels{Coord(0, 0, 0)});
    }
}

/// Nor a level more than has samples, and one without.
TEST(SampledObject, HasNoLeafWithoutSamples)
{
    EXPECT_EQ(sampled({Coord(1, 2, 3)}).levels(), 2);
    EXPECT_EQ(sampled({Coord(8, -16, 24)}).levels(), 5);
    for (uint32_t seed = 0; seed < 22; ++seed) {
        const SampledObject object = sampled(randomObject(seed).voxels);
        for (int k = 0; k < object.levels(); ++k) {
            const SampleLevel& level = object.level(k);
            for (std::size_t leaf = 0; leaf < level.leafCount(); ++leaf) {
                ASSERT_NE(level.mask(leaf), LeafMask{}) << "level " << k;
            }
        }
    }
}

TEST(SampledObject, FindsTheLeavesThatMeetABox)
{
    Random random(1);
    for (uint32_t seed = 100; seed < 133; ++seed) {
        Voxels voxels;
        for (int n = random.between(1, 60); n > 0; --n) voxels.push_back(random.coord(-50, 50));
        sortVoxels(voxels);
        const SampledObject object = sampled(voxels);
        const SampleLevel& level = object.level(0);
        for (int i = 0; i < 40; ++i) {
            const Coord corner = random.coord(-70, 60);
            const CoordBBox box(corner, corner + random.coord(0, i));
            std::vector<std::size_t> expected, found;
            for (std::size_t leaf = 0; leaf < level.leafCount(); ++leaf) {
                const CoordBBox own = CoordBBox::createCube(level.origin(leaf), 8);
                if (own.hasOverlap(box)) expected.push_back(leaf);
            }
            level.forEachLeaf(box, [&](std::size_t leaf) { found.push_back(leaf); });
            ASSERT_EQ(found, expected) << box;
        }
    }
}

} // namespace
