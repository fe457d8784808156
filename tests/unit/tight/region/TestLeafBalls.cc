// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/region/LeafBalls.h>

#include "support/FineBalls.h"

#include <openvdb_spheretree/tree/GivenTree.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;
using openvdb::Vec3d;

double between(Random& random, double low, double high)
{
    constexpr int kSteps = 1000003;
    return low + (high - low) * random.between(0, kSteps) / kSteps;
}

/// Spheres around an object's voxels, and some that hold none.
WorldSpheres someSpheres(const Voxels& voxels, Random& random)
{
    WorldSpheres spheres;
    const int count = random.between(1, 12);
    for (int i = 0; i < count; ++i) {
        const Coord& v = voxels[random.between(0, int(voxels.size()) - 1)];
        Vec3d center = v.asVec3d();
        for (int axis = 0; axis < 3; ++axis) center[axis] += between(random, -1.5, 1.5);
        spheres.center.push_back(center);
        spheres.radius.push_back(between(random, 0.05, i % 3 ? 6 : 0.6));
    }
    return spheres;
}

bool holdsVoxel(const Vec3d& center, double radius, const Coord& v)
{
    return (v.asVec3d() - center).length() <= radius;
}

LeafBalls leavesOf(const WorldSpheres& spheres, const Voxels& voxels)
{
    const auto object = gridOf(voxels);
    const SphereTree given = givenTree(spheres, *object);
    return givenLeaves(
        given, FlatAxis(2), *maskOf(voxels), sampled(voxels).level(0), /*interrupter=*/nullptr);
}

std::string refusalOf(const WorldSpheres& spheres, const Voxels& voxels)
{
    try {
        leavesOf(spheres, voxels);
    } catch (const openvdb::ValueError& error) {
        return error.what();
    }
    return "";
}

/// @return the voxels that no sphere holds, not even if it were larger by @a margin.
Voxels bareVoxels(const WorldSpheres& spheres, const Voxels& voxels, double margin)
{
    Voxels bare;
    for (const Coord& v : voxels) {
        bool held = false;
        for (std::size_t i = 0; i < spheres.size(); ++i) {
            held = held || holdsVoxel(spheres.center[i], spheres.radius[i] + margin, v);
        }
        if (!held) bare.push_back(v);
    }
    return bare;
}

/// Adds one around all voxels.
void addSphereAround(const Voxels& voxels, WorldSpheres& spheres)
{
    const openvdb::CoordBBox box = boxOf(voxels);
    spheres.center.push_back(box.getCenter());
    spheres.radius.push_back(0.51 * box.extents().asVec3d().length() + 1);
}

/// In voxels.
Vec3d centerOf(const ExactSphere& ball)
{
    return Vec3d(double(ball.center[0]), double(ball.center[1]), double(ball.center[2]))
        / double(kFine);
}

bool holdsAny(const Vec3d& center, double radius, const Voxels& voxels)
{
    return std::any_of(voxels.begin(), voxels.end(),
        [&](const Coord& v) { return holdsVoxel(center, radius, v); });
}

/// Each leaf ball is a sphere that was given, in their order, grown by what its center moved.
/// @return how many spheres were left out; they hold no voxel.
int expectLeavesOf(const WorldSpheres& spheres, const Voxels& voxels)
{
    const LeafBalls leaves = leavesOf(spheres, voxels);
    EXPECT_TRUE(leaves.digital.empty());
    int leftOut = 0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const double given = spheres.radius[i];
        const bool here = next < leaves.balls.size()
            && (centerOf(leaves.balls[next]) - spheres.center[i]).length() < 0.056;
        leftOut += !here;
        EXPECT_TRUE(here || !holdsAny(spheres.center[i], given, voxels)) << "sphere " << i;
        if (!here) continue;
        const ExactSphere& ball = leaves.balls[next++];
        const double moved = (centerOf(ball) - spheres.center[i]).lengthSqr();
        const double radius = ball.radius() / double(kFine);
        EXPECT_GE(radius, given + std::sqrt(moved)) << "it contains what was given";
        EXPECT_LE(radius, given + std::sqrt(moved) + 0.06);
    }
    EXPECT_EQ(next, leaves.balls.size());
    return leftOut;
}

TEST(LeafBalls, OfGivenSpheresContainThemAndAreNoLarger)
{
    Random random(1);
    int covered = 0, refused = 0, leftOut = 0;
    for (uint32_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        const Voxels voxels = randomObject(seed).voxels;
        WorldSpheres spheres = someSpheres(voxels, random);
        const std::size_t bare = bareVoxels(spheres, voxels, 0).size();
        // A ball moves and grows by 0.055 voxel at most: what is held in that rim does not count.
        const std::size_t surely = bareVoxels(spheres, voxels, 0.112).size();
        if (bare > 0 && surely == bare) {
            const std::string number = ": " + std::to_string(surely) + " voxel";
            const std::string why = refusalOf(spheres, voxels);
            ASSERT_NE(why.find(number), std::string::npos) << why;
            ++refused;
        }
        if (bare > 0) addSphereAround(voxels, spheres); // then they cover
        leftOut += expectLeavesOf(spheres, voxels);
        ASSERT_FALSE(testing::Test::HasFailure());
        ++covered;
    }
    EXPECT_EQ(covered, 60);
    EXPECT_GE(refused, 5);
    EXPECT_GT(leftOut, 10);
}

TEST(LeafBalls, ASphereLargerThanThereIsRoomForIsRefused)
{
    WorldSpheres spheres;
    spheres.center = {Vec3d(0.5), Vec3d(0.25)};
    spheres.radius = {3, 32768};
    const std::string why = refusalOf(spheres, {Coord(0)});
    EXPECT_NE(why.find("sphere 1 has a radius of 32768 voxels"), std::string::npos) << why;
    spheres.radius[1] = 32767;
    EXPECT_EQ(refusalOf(spheres, {Coord(0)}), "");
}

} // namespace
