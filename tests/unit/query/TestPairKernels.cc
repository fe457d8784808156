// SPDX-License-Identifier: Apache-2.0
// Searches through trees of the largest depth that there may be, all of whose spheres meet.

#include <openvdb_spheretree/query/PairKernels.h>
#include <openvdb_spheretree/query/SphereForest.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::detail;

namespace {

/// About the origin, with leaves as its children first.
ForestNode ball(double radius, std::vector<int32_t> children = {})
{
    ForestNode node;
    node.radius = radius;
    node.children = std::move(children);
    return node;
}

class Forest {
public:
    int32_t add(const ForestNode& node)
    {
        mForest.nodes.push_back(node);
        if (node.children.empty()) mForest.nodes.back().leaf = mLeaves++;
        return int32_t(mForest.nodes.size()) - 1;
    }

    std::vector<int32_t> leaves(int count, double radius)
    {
        std::vector<int32_t> added;
        for (int i = 0; i < count; ++i) added.push_back(add(ball(radius)));
        return added;
    }

    QueryData of(std::vector<int32_t> roots)
    {
        mForest.roots = std::move(roots);
        QueryData data;
        data.spheres = blocksOf(mForest, mLeaves);
        return data;
    }

private:
    SphereForest mForest;
    int32_t mLeaves = 0;
};

/// Each block has seven leaves and a node, which is larger than any of the other tree.
QueryData deepestTree()
{
    Forest forest;
    std::vector<int32_t> block = forest.leaves(kBlockWidth, 10);
    for (int depth = 1; depth < kMostDepth; ++depth) {
        const int32_t node = forest.add(ball(10 + depth, std::move(block)));
        block = forest.leaves(kBlockWidth - 1, 10);
        block.push_back(node);
    }
    return forest.of(block);
}

QueryData wideTree()
{
    Forest forest;
    std::vector<int32_t> roots;
    for (int i = 0; i < kBlockWidth; ++i)
        roots.push_back(forest.add(ball(2, forest.leaves(kBlockWidth, 1))));
    return forest.of(roots);
}

std::multiset<std::pair<int32_t, int32_t>> allPairs(const QueryData& a, const QueryData& b)
{
    std::multiset<std::pair<int32_t, int32_t>> pairs;
    PairFrame frame(a, {}, b, {});
    frame.enterFloats();
    const PairSink sink{&pairs,
        [](void* context, const NodePair* found, int count) {
            auto& all = *static_cast<std::multiset<std::pair<int32_t, int32_t>>*>(context);
            for (int i = 0; i < count; ++i) all.emplace(found[i].a, found[i].b);
            return true;
        },
        0, 0};
    findAllOverlaps(frame, {}, sink);
    return pairs;
}

TEST(PairKernels, TheDeepestTreesHaveRoomOnTheStack)
{
    const QueryData deep = deepestTree(), wide = wideTree();
    EXPECT_EQ(deep.spheres.depth, kMostDepth);
    const std::size_t leaves = deep.spheres.leafPlace.size();
    ASSERT_EQ(leaves, std::size_t((kBlockWidth - 1) * (kMostDepth - 1) + kBlockWidth));
    const std::vector<std::pair<const QueryData*, const QueryData*>> bodies = {
        {&deep, &wide}, {&wide, &deep}, {&deep, &deep}};
    for (const auto& [a, b] : bodies) {
        const std::size_t all = a->spheres.leafPlace.size() * b->spheres.leafPlace.size();
        const auto pairs = allPairs(*a, *b);
        EXPECT_EQ(pairs.size(), all);
        EXPECT_EQ(std::set(pairs.begin(), pairs.end()).size(), all) << "each once";
        PairFrame frame(*a, {}, *b, {});
        frame.enterFloats();
        std::vector<LeafPair> nearest(all);
        NearestLimits limits;
        limits.wanted = int(all);
        int count = 0;
        findNearest(frame, limits, nearest.data(), count);
        EXPECT_EQ(std::size_t(count), all);
    }
}

} // namespace
