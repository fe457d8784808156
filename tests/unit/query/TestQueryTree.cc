// SPDX-License-Identifier: Apache-2.0
/// @file TestQueryTree.cc
/// @brief Blocks of a tree of queries: every leaf is there once, spheres hold what they promise, in
/// floats; what trees are refused.

#include "QuerySamples.h"
#include "support/Messages.h"
#include "support/SampleTrees.h"
#include "support/TreeSettings.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/query/QueryData.h>
#include <openvdb_spheretree/query/SphereForest.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <set>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using detail::FloatSphere;
using detail::QueryData;
using detail::SphereBlock;
using detail::SphereBlocks;
using openvdb::Vec3d;

/// Calls @a visit with every lane in use, the lanes above it (the last is its parent's), and its depth.
using Lanes = std::vector<FloatSphere>;
void visitLanes(const SphereBlocks& blocks,
    const std::function<void(const FloatSphere&, int32_t, const Lanes&)>& visit)
{
    Lanes above{blocks.root};
    const std::function<void(int32_t)> descend = [&](int32_t number) {
        const SphereBlock& block = blocks.blocks.at(std::size_t(number));
        for (int lane = 0; lane < detail::kBlockWidth; ++lane) {
            if (isEmptyLane(block, lane)) continue;
            const FloatSphere sphere = block.sphere(lane);
            visit(sphere, block.child[lane], above);
            if (block.child[lane] < 0) continue;
            above.push_back(sphere);
            descend(block.child[lane]);
            above.pop_back();
        }
    };
    descend(0);
}

bool holds(const FloatSphere& outer, const FloatSphere& inner)
{
    // Products of floats are exact in long doubles, and what is left is far below a float's rounding.
    const long double x = (long double)outer.x - inner.x, y = (long double)outer.y - inner.y,
                      z = (long double)outer.z - inner.z;
    return std::sqrt(x * x + y * y + z * z) + inner.r <= outer.r * (1 + 1e-7L);
}

bool holds(const FloatSphere& sphere, const Vec3d& point)
{
    return (point - Vec3d(sphere.x, sphere.y, sphere.z)).length() <= sphere.r * (1 + 1e-12);
}

std::string refusal(const SphereTree& tree, const QueryTreeSettings& settings = {})
{
    return messageOf<openvdb::ValueError>([&] { makeQueryTree(tree, settings); });
}

} // namespace

TEST(QueryTree, HasEveryLeafOnceAndKnowsWhereItIs)
{
    for (const QuerySample& sample : querySamples()) {
        for (const Exactness exactness : {Exactness::Object, Exactness::LeafUnion}) {
            SCOPED_TRACE(sample.name);
            const QueryTree query = makeQueryTree(sample.tree, exactness);
            const SphereBlocks& blocks = query.data().spheres;
            ASSERT_EQ(query.leafCount(), sample.tree.levels[0].size());
            std::set<int32_t> leaves;
            std::size_t depth = 0;
            visitLanes(blocks, [&](const FloatSphere& sphere, int32_t child, const Lanes& above) {
                depth = std::max(depth, above.size());
                if (child >= 0) return;
                EXPECT_TRUE(leaves.insert(~child).second);
                const FloatSphere found = blocks.leaf(~child);
                EXPECT_EQ(std::memcmp(&found, &sphere, sizeof(sphere)), 0);
            });
            EXPECT_EQ(leaves.size(), std::size_t(query.leafCount()));
            EXPECT_EQ(*leaves.begin(), 0);
            EXPECT_EQ(*leaves.rbegin(), query.leafCount() - 1);
            EXPECT_EQ(depth, std::size_t(blocks.depth));
        }
    }
}

TEST(QueryTree, ALeafHoldsTheStoredSphereAndIsHardlyLarger)
{
    for (const QuerySample& sample : querySamples()) {
        const QueryTree query = makeQueryTree(sample.tree);
        const std::vector<WorldBall> balls = leafBalls(sample.tree);
        for (int32_t leaf = 0; leaf < query.leafCount(); ++leaf) {
            const double moved = (query.leafCenter(leaf) - balls[leaf].center).length();
            EXPECT_GE(query.leafRadius(leaf), balls[leaf].radius + moved - 1e-14) << sample.name;
            EXPECT_LE(query.leafRadius(leaf), balls[leaf].radius + moved + 1e-6) << sample.name;
            EXPECT_LT(moved, 1e-6);
            EXPECT_EQ(query.leafOf(query.nodeId(leaf)), leaf);
        }
        EXPECT_THROW(query.leafOf(query.nodeId(query.leafCount())), openvdb::LookupError);
        EXPECT_THROW(query.leafOf(-1), openvdb::LookupError);
    }
}

TEST(QueryTree, SpheresAboveALeafHoldItWherePromised)
{
    int promised = 0;
    for (const QuerySample& sample : querySamples()) {
        for (const Exactness exactness : {Exactness::Object, Exactness::LeafUnion}) {
            SCOPED_TRACE(sample.name);
            const QueryTree query = makeQueryTree(sample.tree, exactness);
            EXPECT_TRUE(query.holdsLeaves() || exactness == Exactness::Object);
            promised += query.holdsLeaves();
            if (!query.holdsLeaves()) continue;
            visitLanes(query.data().spheres,
                [&](const FloatSphere& sphere, int32_t child, const Lanes& above) {
                    if (child >= 0) return;
                    for (const FloatSphere& outer : above) EXPECT_TRUE(holds(outer, sphere));
                });
        }
    }
    EXPECT_GT(promised, int(querySamples().size()));
}

TEST(QueryTree, SpheresThatAreATouchTooSmallAreMadeToHoldTheirLeaves)
{
    // Stored radii are rounded one by one: here by far more.
    SphereTree tree = querySample("a row, balls").tree;
    ASSERT_GT(tree.levels.size(), 1u);
    for (int32_t id = 0; id < tree.levels[0].begin; ++id) tree.spheres.radiusWorld[id] *= 0.9f;
    const QueryTree query = makeQueryTree(tree);
    ASSERT_TRUE(query.holdsLeaves());
    int held = 0;
    visitLanes(
        query.data().spheres, [&](const FloatSphere& sphere, int32_t child, const Lanes& above) {
            if (child >= 0) return;
            for (const FloatSphere& outer : above) EXPECT_TRUE(holds(outer, sphere));
            held += int(above.size());
        });
    EXPECT_GT(held, query.leafCount());
}

TEST(QueryTree, EveryVoxelCubeLiesInAChainOfLanesDownToALeaf)
{
    for (const QuerySample& sample : querySamples()) {
        SCOPED_TRACE(sample.name);
        const QueryTree query = makeQueryTree(sample.tree);
        ASSERT_TRUE(query.holdsObject());
        std::set<Coord> held;
        const auto corner = [&](const Coord& voxel, int i) {
            const Vec3d offset(i & 1 ? 0.5 : -0.5, i & 2 ? 0.5 : -0.5, i & 4 ? 0.5 : -0.5);
            return sample.tree.transform->indexToWorld(voxel.asVec3d() + offset)
                - query.data().origin;
        };
        const auto holdsCube = [&](const FloatSphere& sphere, const Coord& voxel) {
            for (int i = 0; i < 8; ++i) {
                if (!holds(sphere, corner(voxel, i))) return false;
            }
            return true;
        };
        visitLanes(query.data().spheres,
            [&](const FloatSphere& sphere, int32_t child, const Lanes& above) {
                if (child >= 0) return;
                for (const Coord& voxel : sample.voxels) {
                    if (held.count(voxel) || !holdsCube(sphere, voxel)) continue;
                    if (std::all_of(above.begin(), above.end(),
                            [&](const FloatSphere& s) { return holdsCube(s, voxel); })) {
                        held.insert(voxel);
                    }
                }
            });
        EXPECT_EQ(held.size(), sample.voxels.size());
    }
}

TEST(QueryTree, ManyRootsAreDividedIntoBlocksOfFewBytes)
{
    const SphereTree tree = oneLevelOf(randomTree(5000, 3), 0);
    const QueryTree query = makeQueryTree(tree);
    EXPECT_TRUE(query.holdsLeaves());
    EXPECT_EQ(query.leafCount(), 5000);
    EXPECT_LT(query.data().spheres.depth, 12);
    EXPECT_LT(double(query.bytes()) / query.leafCount(), 50);
}

TEST(QueryTree, SpheresThatShrinkAgainAndAgainMakeNoDeepTree)
{
    // Ever smaller towards the origin: the cheapest division always takes a few off.
    constexpr int kSpheres = 2000;
    detail::SphereForest forest;
    for (int i = 0; i < kSpheres; ++i) {
        detail::ForestNode node;
        node.center = Vec3d(std::pow(0.75, i), 0, 0);
        node.radius = 0.1 * std::pow(0.75, i);
        node.leaf = i;
        forest.roots.push_back(i);
        forest.nodes.push_back(node);
    }
    divideWideNodes(forest);
    const SphereBlocks blocks = blocksOf(forest, kSpheres);
    EXPECT_LE(blocks.depth, detail::kMostDepth);
    EXPECT_EQ(std::count(blocks.leafPlace.begin(), blocks.leafPlace.end(), -1), 0);
}

TEST(QueryTree, AScaleScalesEverySphereAboutTheOriginOfTheWorld)
{
    const QuerySample& sample = querySamples().front();
    QueryTreeSettings settings;
    settings.scale = 3;
    const QueryTree one = makeQueryTree(sample.tree), three = makeQueryTree(sample.tree, settings);
    for (int32_t leaf = 0; leaf < one.leafCount(); ++leaf) {
        EXPECT_LT((three.leafCenter(leaf) - 3.0 * one.leafCenter(leaf)).length(), 1e-5);
        EXPECT_NEAR(three.leafRadius(leaf), 3 * one.leafRadius(leaf), 1e-5);
    }
    EXPECT_NEAR(three.leafReach(), 3 * one.leafReach(), 1e-9);
    EXPECT_NEAR(three.leafInset(), 3 * one.leafInset(), 1e-9);
}

TEST(QueryTree, InsetAndReachHaveRoomForTheRoundingOfLeaves)
{
    // Two voxels far apart, at places that no float has: little is left for each.
    const QuerySample sample =
        querySample("", {Coord(0, 0, 0), Coord(20003, 7, -5)}, TightOptions());
    const SphereTree& tree = sample.tree;
    QueryTreeSettings settings;
    settings.scale = 1.1;
    const QueryTree query = makeQueryTree(tree, settings);
    const double exact =
        settings.scale * (tree.settings.paddingVoxels() + std::sqrt(0.75)) * tree.voxelSize();
    for (int32_t leaf = 0; leaf < query.leafCount(); ++leaf) {
        const int32_t id = query.nodeId(leaf);
        const double moved =
            (query.leafCenter(leaf) - settings.scale * tree.centerWorld(id)).length();
        const double grown =
            moved + query.leafRadius(leaf) - settings.scale * double(tree.spheres.radiusWorld[id]);
        EXPECT_GT(grown, 1e-5 * exact); // else this test shows nothing
        EXPECT_GE(query.leafInset(), exact + grown);
        EXPECT_GE(query.leafReach(), exact + grown);
    }
}

TEST(QueryTree, ACoarserLevelHoldsTheObjectToo)
{
    const QuerySample& sample = querySamples().front();
    ASSERT_GT(sample.tree.levels.size(), 2u);
    QueryTreeSettings settings;
    settings.level = 1;
    const QueryTree query = makeQueryTree(sample.tree, settings);
    EXPECT_EQ(query.leafCount(), sample.tree.levels[1].size());
    EXPECT_EQ(query.nodeId(0), sample.tree.levels[1].begin);
    EXPECT_TRUE(query.holdsObject());
    EXPECT_EQ(query.leafInset(), std::numeric_limits<double>::infinity());
    settings.level = 99;
    EXPECT_THROW(makeQueryTree(sample.tree, settings), openvdb::ValueError);
}

TEST(QueryTree, PromisesNothingOfTheObjectWithoutPaddingForCubes)
{
    const Voxels voxels = randomObject(2).voxels;
    TightOptions options;
    options.quality = Quality::Fast;
    SphereTreeSettings settings = options;
    settings.padding = 0;
    const QueryTree query = makeQueryTree(querySample("", voxels, settings).tree);
    EXPECT_FALSE(query.holdsObject());
}

TEST(QueryTree, RefusesWhatItCannotAnswerFor)
{
    const Voxels voxels = shapes::box(Coord(20, 9, 7));
    const QuerySample reversible = querySample("", voxels, ReversibleOptions());
    ASSERT_GT(reversible.tree.levels.size(), 1u);
    EXPECT_NE(refusal(reversible.tree).find("Exactness::LeafUnion"), std::string::npos);
    EXPECT_TRUE(makeQueryTree(reversible.tree, Exactness::LeafUnion).holdsLeaves());
    EXPECT_NE(
        refusal(querySample("", voxels, FitOptions()).tree).find("side=fit"), std::string::npos);
    ExtendedOptions norm;
    norm.dist = distanceFromString("l1");
    EXPECT_NE(refusal(querySample("", voxels, norm).tree).find("norm"), std::string::npos);
    EXPECT_NE(refusal(SphereTree()), "");

    const SphereTree& tree = querySamples().front().tree;
    for (const double scale : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
        QueryTreeSettings settings;
        settings.scale = scale;
        EXPECT_NE(refusal(tree, settings).find("cannot be scaled by"), std::string::npos) << scale;
    }
    QueryTreeSettings settings;
    settings.scale = 1e30;
    EXPECT_NE(refusal(tree, settings).find("choose another unit"), std::string::npos);
}
