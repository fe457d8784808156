// SPDX-License-Identifier: Apache-2.0
/// @file TestNextSphereTree.cc
/// @brief Trees of the frames of a sequence: spheres start where they were.

#include <openvdb_spheretree/build/BuildSphereTree.h>

#include "support/BuiltTrees.h"
#include "support/CheckedTrees.h"
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

/// No level has a larger error than what is asked of samples, and a twentieth more.
void expectAboutAsGood(SphereTree next, SphereTree anew, const openvdb::BoolGrid& object)
{
    computeLevelErrors(next, object);
    computeLevelErrors(anew, object);
    ASSERT_EQ(next.levels.size(), anew.levels.size());
    for (std::size_t k = 0; k < next.levels.size(); ++k) {
        EXPECT_LE(next.levels[k].error->hammingPercent, 1.2 * anew.levels[k].error->hammingPercent);
    }
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
        expectAboutAsGood(next, anew, *grid);
        for (std::size_t k = 0; k < next.levels.size(); ++k) {
            EXPECT_LE(next.levels[k].size(), k == 0 ? 24 : k == 1 ? 6 : 1);
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
    const auto grid = gridOf(rest);
    SphereTreeSettings settings = settingsOf(Quality::Best);
    settings.budgeted().budget.spheres = {23};
    SphereTree last = buildSphereTree(*grid, settings);
    addSphere(last, openvdb::Vec3d(40, 60, 0), 0, -1); // of one voxel
    last.levels.front().end = last.size();
    settings.tight().quality = Quality::Fast;
    settings.budgeted().budget.spheres = {24};
    const SphereTree next = buildNextSphereTree(last, *grid, settings);
    expectChains(next, rest);
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

TEST(NextSphereTree, IsAboutAsGoodHoweverFarABodyHasTurned)
{
    const auto grid = gridOf(twisted(1));
    const SphereTree anew = buildSphereTree(*grid, settingsOf(Quality::Fast));
    for (const double turn : {-2.0, -1.0, -0.5, 0.0, 0.4, 0.7, 1.4, 2.0}) {
        SCOPED_TRACE(turn);
        const SphereTree last = firstTree(twisted(turn), Quality::Fast);
        const SphereTree next = buildNextSphereTree(last, *grid, settingsOf(Quality::Fast));
        expectAboutAsGood(next, anew, *grid);
    }
}

/// They hold all voxels, but are far too large.
TEST(NextSphereTree, SpheresThatAreTooLargeDoNotStay)
{
    const auto grid = gridOf(twisted(1));
    SphereTree last = firstTree(twisted(1), Quality::Fast);
    for (int64_t& radiusSq : last.spheres.coverRadiusSq) radiusSq *= 4;
    const SphereTree next = buildNextSphereTree(last, *grid, settingsOf(Quality::Fast));
    expectAboutAsGood(next, buildSphereTree(*grid, settingsOf(Quality::Fast)), *grid);
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
