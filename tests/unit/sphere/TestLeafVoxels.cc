// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/kernel/LeafBall.h>
#include <openvdb_spheretree/sphere/LeafVoxels.h>

#include "support/RandomObjects.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Coord;

namespace {

const Distance kDistances[] = {
    Distance(), Distance::l1(), Distance::linf(), Distance::chamfer(3, 4, 5)};

LeafMask voxelsOneByOne(
    const ExactSphere& sphere, int shift, const Coord& origin, const Distance& distance)
{
    LeafMask mask{};
    for (uint32_t n = 0; n < kLeafVoxels; ++n) {
        const Coord q = origin.offsetBy(n >> 6, n >> 3 & 7, n & 7);
        int64_t d[3];
        for (int a = 0; a < 3; ++a) d[a] = int64_t(q[a]) * (1 << shift) - sphere.center[a];
        if (distance.lengthSq(d[0], d[1], d[2]) <= sphere.radiusSq) mask.setOn(n);
    }
    return mask;
}

} // namespace

TEST(LeafVoxels, AreThoseInTheSphereWhateverItsSizeAndDistance)
{
    Random random(8);
    int cut = 0; // leaves that a sphere cuts
    for (const int radius : {0, 1, 5, 60, 291, 293, 2330, 2350, 32000, 1 << 25}) {
        for (int i = 0; i < 200; ++i) {
            const int shift = i % 5 == 4 && radius < 32000 ? 10 : 1 + i % 4;
            const Distance& distance = kDistances[random.between(0, 3)];
            const Coord corner = random.coord(-5, 5);
            const Coord origin(8 * corner[0], 8 * corner[1], 8 * corner[2]);
            Coord center = origin + random.coord(-3, 10);
            center[i % 3] += (i % 2 ? 1 : -1) * radius; // so that it passes through the leaf
            const int64_t reach = int64_t(radius) << shift;
            ExactSphere sphere = ExactSphere::around(
                center, distance.lengthSq(reach, 0, 0) + random.between(0, radius), 1 << shift);
            for (int64_t& c : sphere.center) c += random.between(0, (1 << shift) - 1);
            const LeafMask expected = voxelsOneByOne(sphere, shift, origin, distance);
            ASSERT_EQ(detail::voxelsOf(sphere, shift, origin, distance), expected)
                << toString(distance) << " radius " << radius << " around " << center;
            cut += !expected.none() && !expected.all();
        }
    }
    EXPECT_GT(cut, 500);
}

/// Spheres that the kernel can hold, beside a leaf whose farthest voxel it cannot (kLeafBallReach, kLeafNormReach).
TEST(LeafVoxels, AreThoseInTheSphereAtTheEndOfTheKernelsReach)
{
    for (const Distance& distance : kDistances) {
        const int64_t reach =
            distance.isEuclidean() ? detail::kLeafBallReach : detail::kLeafNormReach;
        for (int64_t radius = reach - 16; radius <= reach + 1; ++radius) {
            for (int side = 0; side < 6; ++side) {
                ExactSphere sphere = ExactSphere::around(Coord(3), 0);
                sphere.center[side / 2] += side % 2 ? radius : -radius;
                sphere.radiusSq = distance.lengthSq(radius, 0, 0);
                const LeafMask mask = detail::voxelsOf(sphere, 1, Coord(0), distance);
                ASSERT_EQ(mask, voxelsOneByOne(sphere, 1, Coord(0), distance))
                    << toString(distance) << " radius " << radius << " side " << side;
            }
        }
    }
}

/// Where the shortcuts for all voxels and for none begin and end.
TEST(LeafVoxels, AreAllFromTheFarthestVoxelOnAndNoneBeforeTheNearest)
{
    Random random(9);
    for (int i = 0; i < 400; ++i) {
        const int shift = i % 5 == 4 ? 10 : 1 + i % 4;
        const Distance& distance = kDistances[i / 4 % 4];
        const Coord origin(8, -16, 0);
        ExactSphere sphere = ExactSphere::around(origin + random.coord(-20, 28), 0, 1 << shift);
        for (int64_t& c : sphere.center) c += random.between(0, (1 << shift) - 1);
        int64_t nearest = INT64_MAX, farthest = 0;
        for (uint32_t n = 0; n < kLeafVoxels; ++n) {
            const Coord q = origin.offsetBy(n >> 6, n >> 3 & 7, n & 7);
            int64_t d[3];
            for (int a = 0; a < 3; ++a) d[a] = int64_t(q[a]) * (1 << shift) - sphere.center[a];
            const int64_t apart = distance.lengthSq(d[0], d[1], d[2]);
            nearest = std::min(nearest, apart);
            farthest = std::max(farthest, apart);
        }
        for (const int64_t radiusSq : {nearest - 1, nearest, farthest - 1, farthest}) {
            sphere.radiusSq = radiusSq;
            const LeafMask mask = detail::voxelsOf(sphere, shift, origin, distance);
            ASSERT_EQ(mask, voxelsOneByOne(sphere, shift, origin, distance)) << toString(distance);
            ASSERT_EQ(mask.none(), radiusSq < nearest);
            ASSERT_EQ(mask.all(), radiusSq >= farthest);
        }
    }
}

TEST(LeafVoxels, OfAnEmptySphereAreNone)
{
    EXPECT_TRUE(detail::voxelsOf(ExactSphere(), 1, Coord(0)).none());
    EXPECT_TRUE(detail::voxelsOf(ExactSphere::around(Coord(1 << 30), 0, 16), 4, Coord(0)).none());
}
