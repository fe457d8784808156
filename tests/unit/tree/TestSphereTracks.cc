// SPDX-License-Identifier: Apache-2.0

#include <openvdb_spheretree/tree/SphereTracks.h>

#include "support/Messages.h"
#include "support/SampleTrees.h"

#include <openvdb/Exceptions.h>
#include <openvdb/math/Transform.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <set>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// A tree of one level, in voxels of 1.
SphereTree treeAt(const std::vector<openvdb::Vec3d>& centers, const std::vector<double>& radii)
{
    SphereTree tree;
    tree.transform = openvdb::math::Transform::createLinearTransform(1);
    tree.spheres.resize(centers.size());
    for (std::size_t i = 0; i < centers.size(); ++i) {
        tree.spheres.center[i] = centers[i];
        tree.spheres.radiusWorld[i] = float(radii[i]);
        tree.spheres.parent[i] = -1;
    }
    tree.levels.resize(1);
    tree.levels.front().end = tree.size();
    return tree;
}

/// The same with the tracks 100, 101, ...
SphereTree lastAt(const std::vector<openvdb::Vec3d>& centers, const std::vector<double>& radii)
{
    SphereTree tree = treeAt(centers, radii);
    tree.track.resize(centers.size());
    std::iota(tree.track.begin(), tree.track.end(), 100);
    tree.nextTrack = 100 + int32_t(centers.size());
    return tree;
}

std::vector<openvdb::Vec3d> scattered(std::size_t count, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-100, 100);
    std::vector<openvdb::Vec3d> centers(count);
    for (auto& center : centers) center = {place(random), place(random), place(random)};
    return centers;
}

TEST(SphereTracks, TheFirstFrameHasItsIds)
{
    SphereTree tree = randomTree(40, 3), next = tree;
    const SphereTree without = tree;
    startTracks(tree);
    EXPECT_EQ(tree.nextTrack, tree.size());
    for (int32_t id = 0; id < tree.size(); ++id) EXPECT_EQ(tree.track[id], id);
    continueTracks(next, without);
    EXPECT_EQ(next.track, tree.track) << "ids stand for tracks that are not there";
    EXPECT_EQ(next.nextTrack, tree.nextTrack);
    EXPECT_NO_THROW(tree.validate());
}

TEST(SphereTracks, ATreeThatStaysKeepsAll)
{
    SphereTree tree = randomTree(700, 5); // levels of more than 256 spheres, too
    startTracks(tree);
    std::shuffle(tree.track.begin(), tree.track.end(), std::mt19937(1));
    SphereTree next = tree;
    continueTracks(next, tree);
    EXPECT_EQ(next.track, tree.track);
    EXPECT_EQ(next.nextTrack, tree.nextTrack);
}

TEST(SphereTracks, ABodyThatMovesKeepsAllHoweverFast)
{
    SphereTree tree = randomTree(700, 5);
    startTracks(tree);
    SphereTree next = tree;
    for (auto& center : next.spheres.center) center += openvdb::Vec3d(1e5, -3e4, 12.5);
    continueTracks(next, tree);
    EXPECT_EQ(next.track, tree.track);
    const auto turned = openvdb::math::Transform::createLinearTransform(tree.voxelSize());
    turned->postRotate(2, openvdb::math::Y_AXIS);
    turned->postTranslate({1e5, -3e4, 12.5});
    next.transform = turned;
    continueTracks(next, tree);
    EXPECT_EQ(next.track, tree.track);
}

TEST(SphereTracks, EachGoesWithTheOneThatLeastMovementInAllPairsItWith)
{
    // The first could take the place of the second at once; then the second would have to go far.
    const auto last = lastAt({{0, 0, 0}, {10, 0, 0}, {40, 0, 0}}, {1, 1, 1});
    SphereTree tree = treeAt({{9, 0, 0}, {19, 0, 0}, {22, 0, 0}}, {1, 1, 1});
    continueTracks(tree, last);
    EXPECT_EQ(tree.track, (std::vector<int32_t>{100, 101, 102}));
}

TEST(SphereTracks, ARowThatMovesAlongItselfIsNoRowWithANewEnd)
{
    const auto last = lastAt({{0, 0, 0}, {10, 0, 0}, {20, 0, 0}}, {1, 1, 1});
    SphereTree tree = treeAt({{10, 0, 0}, {20, 0, 0}, {30, 0, 0}}, {1, 1, 1});
    continueTracks(tree, last);
    EXPECT_EQ(tree.track, (std::vector<int32_t>{100, 101, 102}));
}

TEST(SphereTracks, RadiiCountAsCentersDo)
{
    const auto last = lastAt({{0, 0, 0}, {2, 0, 0}}, {1, 9});
    SphereTree tree = treeAt({{0, 0, 0}, {2, 0, 0}}, {9, 1});
    continueTracks(tree, last);
    EXPECT_EQ(tree.track, (std::vector<int32_t>{101, 100}));
}

TEST(SphereTracks, NewSpheresGetTracksThatNoneHad)
{
    SphereTree tree = treeAt({{0, 0, 0}, {50, 0, 0}, {100, 0, 0}}, {1, 1, 1});
    auto last = lastAt({{0, 0, 0}, {100, 0, 0}}, {1, 1});
    last.nextTrack = 777; // others have been, and are gone
    continueTracks(tree, last);
    EXPECT_EQ(tree.track, (std::vector<int32_t>{100, 777, 101}));
    EXPECT_EQ(tree.nextTrack, 778);
    SphereTree fewer = treeAt({{0, 0, 0}, {100, 0, 0}}, {1, 1});
    continueTracks(fewer, tree);
    EXPECT_EQ(fewer.track, (std::vector<int32_t>{100, 101}));
    EXPECT_EQ(fewer.nextTrack, 778);
}

TEST(SphereTracks, LevelsOfOneNumberBelongTogether)
{
    SphereTree tree = randomTree(60, 9);
    SphereTree last = tree;
    for (SphereTreeLevel& level : last.levels) level.level += 1;
    continueTracks(tree, last);
    const SphereTreeLevel& finest = tree.levels.front();
    for (int32_t id = finest.begin; id < finest.end; ++id) EXPECT_GE(tree.track[id], last.size());
    const SphereTreeLevel& above = tree.levels[1];
    for (int32_t id = above.begin; id < above.end; ++id) {
        EXPECT_GE(tree.track[id], last.levels[0].begin) << "of the level that had this number";
        EXPECT_LT(tree.track[id], last.levels[0].end);
    }
}

TEST(SphereTracks, ManyThatMoveALittleKeepNearlyAllAndAllArePaired)
{
    const std::size_t count = 3000;
    const auto centers = scattered(count, 2);
    const std::vector<double> radii(count, 1.0);
    auto moved = centers;
    std::mt19937 random(4);
    std::uniform_real_distribution<double> step(-0.2, 0.2);
    for (auto& center : moved) center += openvdb::Vec3d(step(random), step(random), step(random));
    SphereTree tree = treeAt(moved, radii);
    continueTracks(tree, lastAt(centers, radii));
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) kept += tree.track[i] == 100 + int32_t(i);
    EXPECT_GE(kept, count * 95 / 100);
    EXPECT_EQ(std::set<int32_t>(tree.track.begin(), tree.track.end()).size(), count);
    EXPECT_EQ(tree.nextTrack, 100 + int32_t(count)) << "none is new";
}

TEST(SphereTracks, OfUnequalNumbersAllOfTheSmallerArePaired)
{
    for (const auto& [before, now] : {std::pair(2000, 700), {700, 2000}, {1, 900}, {900, 1}}) {
        SphereTree tree =
            treeAt(scattered(std::size_t(now), 6), std::vector<double>(std::size_t(now), 2));
        const auto last =
            lastAt(scattered(std::size_t(before), 7), std::vector<double>(std::size_t(before), 2));
        continueTracks(tree, last);
        const auto kept = std::count_if(tree.track.begin(), tree.track.end(),
            [&](int32_t track) { return track < last.nextTrack; });
        EXPECT_EQ(kept, std::min(before, now));
        EXPECT_EQ(std::set<int32_t>(tree.track.begin(), tree.track.end()).size(), std::size_t(now));
    }
}

TEST(SphereTracks, ALevelAloneKeepsItsTracks)
{
    SphereTree tree = randomTree(60, 9);
    startTracks(tree);
    const SphereTree level = keepLevel(tree, 0);
    ASSERT_EQ(level.track.size(), std::size_t(level.size()));
    EXPECT_EQ(level.track.front(), tree.levels.front().begin);
    EXPECT_EQ(level.nextTrack, tree.nextTrack);
    EXPECT_TRUE(keepLevel(randomTree(60, 9), 0).track.empty());
}

TEST(SphereTracks, WrongTracksAreFound)
{
    const SphereTree fine = [] {
        SphereTree tree = randomTree(30, 2);
        startTracks(tree);
        return tree;
    }();
    const auto why = [](const SphereTree& tree) {
        return messageOf<openvdb::ValueError>([&] { tree.validate(); });
    };
    SphereTree tree = fine;
    tree.track[3] = tree.track[7];
    EXPECT_TRUE(mentions(why(tree), "two nodes have the track 7"));
    tree = fine;
    tree.nextTrack -= 1;
    EXPECT_TRUE(mentions(why(tree), "all should be from 0 to"));
    tree = fine;
    tree.track[0] = -1;
    EXPECT_TRUE(mentions(why(tree), "tracks from -1"));
    tree = fine;
    tree.track.pop_back();
    EXPECT_TRUE(mentions(why(tree), "entries in track"));
}

TEST(SphereTracks, ThereAreNoMoreThanNumbers)
{
    SphereTree tree = treeAt({{0, 0, 0}, {5, 0, 0}}, {1, 1});
    SphereTree last = lastAt({{0, 0, 0}}, {1});
    last.levels.front().level = 7;
    last.nextTrack = std::numeric_limits<int32_t>::max() - 1;
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([&] { continueTracks(tree, last); }), "begin a new one"));
    EXPECT_TRUE(tree.track.empty());
}

/// Two spheres go apart, then grow.
TEST(SphereTracks, MovementIsTheMeanOfPairsInMeanRadiiOfTheFrameBefore)
{
    const SphereTree last = treeAt({{0, 0, 0}, {10, 0, 0}}, {2, 2});
    EXPECT_EQ(movementSince(last, last), 0);
    const SphereTree apart = treeAt({{-1.5, 0, 0}, {11.5, 0, 0}}, {2, 2});
    EXPECT_NEAR(movementSince(last, apart), 1.5 / 2, 1e-9);
    const SphereTree grown = treeAt({{0, 0, 0}, {10, 0, 0}}, {4, 4});
    EXPECT_NEAR(movementSince(last, grown), 2.0 / 2, 1e-9);
    const SphereTree points = treeAt({{0, 0, 0}, {10, 0, 0}}, {0, 0});
    EXPECT_NEAR(movementSince(points, last), 2.0 / 1, 1e-9);
    SphereTree other = apart;
    other.levels.front().level = 1;
    EXPECT_EQ(movementSince(last, other), 0);
}

} // namespace
