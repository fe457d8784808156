// SPDX-License-Identifier: Apache-2.0
/// @file TestNextSphereTree.cc
/// @brief Trees of the frames of a sequence: spheres start where they were.

#include <openvdb_spheretree/build/BuildSphereTree.h>

#include "support/BuiltTrees.h"
#include "support/TightObjects.h"

#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/tree/SphereTracks.h>

#include <openvdb/math/Transform.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// Balls of all sizes along x, which turns around it, more the farther along.
Voxels twisted(double turn, const Coord& at = Coord(0))
{
    constexpr int kBalls = 14, kReach = 24;
    Random random(3);
    std::set<Coord> voxels;
    for (int i = 0; i < kBalls; ++i) {
        const int x = 5 * i, radius = random.between(3, 8);
        const double away = random.between(0, 14);
        const double angle = random.between(0, 628) / 100.0 + turn * i / kBalls;
        const double y = away * std::cos(angle), z = away * std::sin(angle);
        for (const Coord& voxel : shapes::box(Coord(2 * kReach + 1))) {
            const Coord offset = voxel.offsetBy(-kReach);
            if (std::hypot(offset[0], offset[1] - y, offset[2] - z) > radius) continue;
            voxels.insert(at + offset.offsetBy(x, 0, 0));
        }
    }
    return {voxels.begin(), voxels.end()};
}

SphereTreeSettings settingsOf(Quality quality)
{
    SphereTreeSettings settings = tightSettings(quality);
    settings.budgeted().budget = SphereBudget();
    settings.budgeted().budget.spheres = {24, 6, 1};
    return settings;
}

SphereTree firstTree(const Voxels& voxels, Quality quality = Quality::Normal)
{
    SphereTree tree = buildSphereTree(*gridOf(voxels), settingsOf(quality));
    startTracks(tree);
    return tree;
}

/// How far the spheres of the finest level have moved, on average; voxels.
double meanMovement(const SphereTree& now, const SphereTree& last)
{
    std::map<int32_t, openvdb::Vec3d> before;
    for (int32_t id = 0; id < last.size(); ++id) before[last.track[id]] = last.spheres.center[id];
    double sum = 0;
    const SphereTreeLevel& finest = now.levels.front();
    for (int32_t id = finest.begin; id < finest.end; ++id) {
        const auto found = before.find(now.track[id]);
        if (found != before.end()) sum += (now.spheres.center[id] - found->second).length();
    }
    return sum / finest.size();
}

TEST(NextSphereTree, SpheresOfABodyThatTwistsStartWhereTheyWere)
{
    SphereTree last = firstTree(twisted(0), Quality::Fast), lastAnew = last;
    double moved = 0, movedAnew = 0;
    for (int frame = 1; frame <= 6; ++frame) {
        SCOPED_TRACE(frame);
        const Voxels voxels = twisted(0.06 * frame);
        const auto grid = gridOf(voxels);
        SphereTree next = buildNextSphereTree(last, *grid, settingsOf(Quality::Fast));
        SphereTree anew = buildSphereTree(*grid, settingsOf(Quality::Fast));
        continueTracks(anew, lastAnew);
        expectSound(next, *grid, voxels);
        computeLevelErrors(next, *grid);
        computeLevelErrors(anew, *grid);
        ASSERT_EQ(next.levels.size(), anew.levels.size());
        for (std::size_t k = 0; k < next.levels.size(); ++k) {
            EXPECT_LE(next.levels[k].size(), k == 0 ? 24 : k == 1 ? 6 : 1);
            // What is asked of samples, and a twentieth more.
            EXPECT_LE(
                next.levels[k].error->hammingPercent, 1.2 * anew.levels[k].error->hammingPercent);
        }
        moved += meanMovement(next, last);
        movedAnew += meanMovement(anew, lastAnew);
        last = std::move(next);
        lastAnew = std::move(anew);
    }
    EXPECT_LT(moved, 0.75 * movedAnew);
}

/// With `fast`, the tree would be another one.
TEST(NextSphereTree, SpheresOfABodyThatOnlyMovesMoveWithIt)
{
    const Coord way(37, -120, 9);
    const SphereTree last = firstTree(twisted(1), Quality::Best);
    const auto grid = gridOf(twisted(1, way));
    const SphereTree next = buildNextSphereTree(last, *grid, settingsOf(Quality::Fast));
    ASSERT_EQ(next.size(), last.size());
    for (int32_t id = 0; id < next.size(); ++id) {
        EXPECT_EQ(next.spheres.center[id] - last.spheres.center[id], way.asVec3d());
        EXPECT_EQ(next.spheres.coverRadiusSq[id], last.spheres.coverRadiusSq[id]);
        EXPECT_EQ(next.spheres.parent[id], last.spheres.parent[id]);
        EXPECT_EQ(next.track[id], last.track[id]);
    }
}

TEST(NextSphereTree, IsMadeAnewWhereTheOneBeforeIsOfNoUse)
{
    const Voxels voxels = twisted(1);
    const auto grid = gridOf(voxels);
    const SphereTree anew = buildSphereTree(*grid, settingsOf(Quality::Fast));
    const auto expectAnew = [&](const SphereTree& last, const std::string& what) {
        EXPECT_TRUE(sameNodes(buildNextSphereTree(last, *grid, settingsOf(Quality::Fast)), anew))
            << what;
    };
    expectAnew(firstTree(shapes::ball(200), Quality::Fast), "another object");
    expectAnew(firstTree(twisted(0.5, Coord(100000, 0, 1)), Quality::Fast), "somewhere else");
    expectAnew(firstTree(twisted(-1.5), Quality::Fast), "one that has turned too far");
    const SphereTree best = firstTree(voxels, Quality::Best);
    SphereTree wide = best;
    wide.transform = openvdb::math::Transform::createLinearTransform(2);
    expectAnew(wide, "voxels of another size");
    SphereTree huge = best;
    huge.spheres.coverRadiusSq.back() = INT64_MAX / 4;
    expectAnew(huge, "a radius that no sphere of this object has");
    expectAnew(keepLevel(best, 1), "other levels");
    expectAnew(buildSphereTree(*grid, settingsFor(TreeType::Extended)), "another kind");
    EXPECT_FALSE(sameNodes(buildNextSphereTree(best, *grid, settingsOf(Quality::Fast)), anew));
}

/// Its sphere costs next to nothing, and every other voxel keeps its chain.
TEST(NextSphereTree, TheSphereOfAPartThatIsGoneGoes)
{
    const Voxels rest = twisted(1);
    Voxels voxels = rest;
    for (int z = 0; z < 3; ++z) voxels.push_back(Coord(40, 4, 20 + z));
    voxels.push_back(rest.back().offsetBy(1, 0, 0)); // so that the box changes
    SphereTreeSettings settings = settingsOf(Quality::Fast);
    const SphereTree last = buildSphereTree(*gridOf(voxels), settings);
    const auto grid = gridOf(rest);
    const SphereTree next = buildNextSphereTree(last, *grid, settings);
    expectSound(next, *grid, rest);
    for (int32_t id = next.levels.front().begin; id < next.levels.front().end; ++id) {
        const auto isHeld = [&](const Coord& voxel) { return holds(next, id, voxel); };
        EXPECT_TRUE(std::any_of(rest.begin(), rest.end(), isHeld)) << "sphere " << id;
    }
}

TEST(NextSphereTree, APartThatComesFarAwayIsCovered)
{
    const SphereTree last = firstTree(twisted(1), Quality::Fast);
    Voxels voxels = twisted(1);
    for (const Coord& voxel : shapes::ball(9)) voxels.push_back(voxel.offsetBy(300, 200, 100));
    const auto grid = gridOf(voxels);
    expectSound(buildNextSphereTree(last, *grid, settingsOf(Quality::Fast)), *grid, voxels);
}

/// They hold all voxels, but are far too large.
TEST(NextSphereTree, SpheresThatAreTooLargeDoNotStay)
{
    const auto grid = gridOf(twisted(1));
    SphereTree last = firstTree(twisted(1), Quality::Fast);
    for (int64_t& radiusSq : last.spheres.coverRadiusSq) radiusSq *= 4;
    SphereTree next = buildNextSphereTree(last, *grid, settingsOf(Quality::Fast));
    SphereTree anew = buildSphereTree(*grid, settingsOf(Quality::Fast));
    computeLevelErrors(next, *grid);
    computeLevelErrors(anew, *grid);
    for (std::size_t k = 0; k < next.levels.size(); ++k) {
        EXPECT_LE(next.levels[k].error->hammingPercent, 1.2 * anew.levels[k].error->hammingPercent);
    }
}

TEST(NextSphereTree, OfAFlatObject)
{
    SphereTreeSettings settings = settingsOf(Quality::Normal);
    settings.dim = 2;
    const auto flat = [](double turn) {
        Voxels voxels;
        for (const Coord& voxel : twisted(turn)) {
            if (voxel[2] == 0) voxels.push_back(Coord(voxel[0], 3, voxel[1])); // flat along y
        }
        return voxels;
    };
    SphereTree last = buildSphereTree(*gridOf(flat(0)), settings);
    int followed = 0;
    for (int frame = 1; frame <= 3; ++frame) {
        const Voxels voxels = flat(0.05 * frame);
        const auto grid = gridOf(voxels);
        SphereTree next = buildNextSphereTree(last, *grid, settings);
        expectSound(next, *grid, voxels);
        if (!sameNodes(next, buildSphereTree(*grid, settings))) ++followed;
        last = std::move(next);
    }
    EXPECT_GE(followed, 1);
}

} // namespace
