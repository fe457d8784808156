// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/TightLevels.h>

#include "support/FineBalls.h"

#include <cmath>
#include <numeric>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

using Counts = std::vector<int64_t>;
using Forest = std::vector<ForestNode>;

/// Random balls, that merge two by two or end by twos.
Forest randomForest(int leaves, double dropping, Random& random)
{
    Forest forest;
    std::vector<int32_t> living;
    const auto add = [&](int last) {
        living.push_back(int32_t(forest.size()));
        forest.push_back({randomBall(random, -30, 30, 5), -1, 1, last});
    };
    for (int i = 0; i < leaves; ++i) add(leaves);
    const auto end = [&](int count, int32_t parent) {
        const auto place = std::size_t(random.between(0, int(living.size()) - 1));
        forest[living[place]].first = count;
        forest[living[place]].parent = parent;
        living.erase(living.begin() + long(place));
    };
    for (int count = leaves; count > 1; --count) {
        if (count > 2 && random.chance(dropping)) {
            end(count--, -1);
            end(count, -1);
            continue;
        }
        const auto parent = int32_t(forest.size());
        end(count, parent);
        end(count, parent);
        add(count - 1);
    }
    return forest;
}

std::vector<MedialBall> someLeaves(int count, Random& random)
{
    std::vector<MedialBall> leaves;
    for (int i = 0; i < count; ++i) {
        leaves.push_back({random.coord(-9, 9), random.between(1, 99)});
    }
    return leaves;
}

bool isIn(const ForestNode& node, int64_t count)
{
    return node.first <= count && node.last >= count;
}

double protrusion(const ExactSphere& ball, const ExactSphere& out)
{
    return centerDistance(ball, out) + ball.radius() - out.radius();
}

TEST(TightLevels, OfACountAreTheNodesThatLiveThen)
{
    Random random(1);
    for (int turn = 0; turn < 40; ++turn) {
        const int leaves = random.between(1, 40);
        const Forest forest = randomForest(leaves, turn % 2 ? 0.3 : 0, random);
        for (int64_t count = 1; count <= leaves; ++count) {
            const auto cut = cutOf(forest, count);
            ASSERT_EQ(cut.size(), std::size_t(count));
            ASSERT_TRUE(std::is_sorted(cut.begin(), cut.end()));
            for (const int32_t node : cut) ASSERT_TRUE(isIn(forest[node], count));
        }
    }
}

/// The parent of node @a id among a coarser cut, or the ball it sticks out of least.
void expectParent(
    const Forest& forest, int32_t id, const std::vector<int32_t>& above, int32_t place)
{
    ASSERT_LE(0, place);
    ASSERT_LT(std::size_t(place), above.size());
    for (int32_t node = id; node >= 0; node = forest[node].parent) {
        const auto found = std::find(above.begin(), above.end(), node);
        if (found == above.end()) continue;
        ASSERT_EQ(place, found - above.begin());
        return;
    }
    const ExactSphere& ball = forest[id].ball;
    for (const int32_t other : above) {
        ASSERT_LE(
            protrusion(ball, forest[above[place]].ball), protrusion(ball, forest[other].ball));
    }
}

TEST(TightLevels, AreStuckOutOfLeastByBallsThatAreThere)
{
    const ExactSphere none, small{{0, 0, 0}, 16 * 16}, large{{320, 0, 0}, 160 * 160};
    EXPECT_EQ(leastProtruding(small, {none, none, large}), 2);
    EXPECT_EQ(leastProtruding(small, {large, none, small}), 2);
    EXPECT_EQ(leastProtruding({{200, 0, 0}, 100}, {small, large, large}), 1) << "the first";
}

TEST(TightLevels, TheLeastProtrudingBallIsFoundAmongThoseNear)
{
    Random random(3);
    for (int round = 0; round < 60; ++round) {
        const int spread = 20 << (round % 3 * 3); // far apart, too
        std::vector<ExactSphere> level = randomBalls(40, random, -spread, spread, 1 << round % 6);
        level.push_back(level[5]); // two are equal
        level[7] = ExactSphere();  // one is empty
        const BallGrid grid(level);
        for (int i = 0; i < 20; ++i) {
            const ExactSphere ball = randomBall(random, -2 * spread, 2 * spread, 1 << i % 5);
            ASSERT_EQ(leastProtruding(ball, level, grid), leastProtruding(ball, level)) << round;
        }
    }
    EXPECT_EQ(leastProtruding({{0, 0, 0}, 9}, {ExactSphere()}, BallGrid()), 0);
}

TEST(TightLevels, HaveTheirAncestorsAsParents)
{
    Random random(2);
    for (int turn = 0; turn < 60; ++turn) {
        const int size = random.between(1, 40);
        const Forest forest = randomForest(size, turn % 2 ? 0.3 : 0, random);
        const auto leaves = someLeaves(size, random);
        Counts counts;
        for (int64_t n = size - turn % 3; n > 0; n -= random.between(1, 9)) counts.push_back(n);
        const auto levels = levelsOf(forest, counts, leaves);
        ASSERT_EQ(levels.size(), counts.size());
        for (std::size_t k = 0; k < counts.size(); ++k) {
            const auto cut = cutOf(forest, counts[k]);
            ASSERT_EQ(levels[k].balls.size(), cut.size());
            ASSERT_EQ(levels[k].digital.size(), counts[k] == size ? leaves.size() : 0);
            const bool last = k + 1 == counts.size();
            ASSERT_EQ(levels[k].parent.size(), last ? 0 : cut.size());
            for (std::size_t i = 0; i < cut.size(); ++i) {
                ASSERT_EQ(levels[k].balls[i], forest[cut[i]].ball);
                if (last) continue;
                ASSERT_NO_FATAL_FAILURE(expectParent(
                    forest, cut[i], cutOf(forest, counts[k + 1]), levels[k].parent[i]));
            }
        }
    }
}

/// root >= sqrt(square) in integers; a radius in voxels is a root in 1/16.
bool isRootOrMore(double root, int64_t square)
{
    int exponent;
    auto mantissa = __int128(std::ldexp(std::frexp(root, &exponent), 53));
    for (exponent -= 53; exponent > 0; --exponent) mantissa *= 2;
    return mantissa * mantissa >= (__int128(square) << (-2 * exponent));
}

void expectNode(const SphereTree& tree, int32_t id, const ExactSphere& ball, int flatAxis)
{
    const int axes[3][3] = {{2, 0, 1}, {0, 2, 1}, {0, 1, 2}}; // where x, y and z come from
    for (int a = 0; a < 3; ++a) {
        const int64_t c = ball.center[axes[flatAxis][a]];
        ASSERT_EQ(16 * tree.spheres.center[id][a], double(c));
        ASSERT_EQ(tree.ijk[id][a], (c + 8) >> 4) << "nearest voxel";
    }
    ASSERT_EQ(tree.spheres.coverRadiusSq[id], ball.radiusSq);
    ASSERT_TRUE(isRootOrMore(16 * tree.spheres.radius[id], ball.radiusSq));
    const bool tight =
        !isRootOrMore(16 * std::nextafter(tree.spheres.radius[id], 0.0), ball.radiusSq);
    ASSERT_TRUE(tight || ball.radiusSq == 0 || ball.radiusSq > int64_t(1) << 53);
}

/// Levels of random balls, the last one of a single ball; some of voxels that are the same.
std::vector<TightLevel> randomLevels(Random& random)
{
    std::vector<TightLevel> levels(std::size_t(random.between(1, 4)));
    for (std::size_t k = 0; k < levels.size(); ++k) {
        const bool top = k + 1 == levels.size();
        levels[k].balls = randomBalls(top ? 1 : random.between(1, 30), random, -1, 1, 9);
        if (random.chance(0.2)) {
            ExactSphere& huge = levels[k].balls[0];
            huge = randomBall(random, -(1 << 24), 1 << 24, 1 << 24);
        }
    }
    for (std::size_t k = 0; k + 1 < levels.size(); ++k) {
        const int above = int(levels[k + 1].balls.size());
        for (std::size_t i = 0; i < levels[k].balls.size(); ++i) {
            levels[k].parent.push_back(random.between(0, above - 1));
        }
    }
    if (random.chance(0.5)) {
        levels[0].digital = someLeaves(int(levels[0].balls.size()), random);
    }
    return levels;
}

/// @return the places of a level's balls in the order of their ids: by voxel, equals as they come.
std::vector<int32_t> orderOf(const TightLevel& level, int flatAxis)
{
    const auto voxel = [&](int32_t i) {
        Coord ijk;
        for (int a = 0; a < 3; ++a) ijk[a] = int32_t((level.balls[i].center[a] + 8) >> 4);
        if (flatAxis == 0) return Coord(ijk[2], ijk[0], ijk[1]);
        return flatAxis == 1 ? Coord(ijk[0], ijk[2], ijk[1]) : ijk;
    };
    std::vector<int32_t> order(level.balls.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
        return std::make_pair(voxel(a), a) < std::make_pair(voxel(b), b);
    });
    return order;
}

void expectLevels(const std::vector<TightLevel>& levels, const SphereTree& tree, int flatAxis)
{
    ASSERT_EQ(tree.levels.size(), levels.size());
    int32_t begin = 0;
    std::vector<int32_t> idsAbove; // of the places of a level
    for (std::size_t k = levels.size(); k-- > 0;) {
        const TightLevel& level = levels[k];
        const bool digital = !level.digital.empty();
        ASSERT_EQ(tree.levels[k].level, int(k));
        ASSERT_EQ(tree.levels[k].begin, begin);
        ASSERT_EQ(tree.levels[k].pyramidVoxels, digital ? tree.object.voxels : 0);
        std::vector<int32_t> ids(level.balls.size());
        int32_t id = begin;
        for (const int32_t place : orderOf(level, flatAxis)) {
            ASSERT_NO_FATAL_FAILURE(expectNode(tree, id, level.balls[place], flatAxis));
            const int32_t parent = idsAbove.empty() ? -1 : idsAbove[level.parent[place]];
            ASSERT_EQ(tree.spheres.parent[id], parent);
            ASSERT_EQ(tree.radiusSq[id], digital ? level.digital[place].radiusSq : -1);
            ids[place] = id++;
        }
        ASSERT_EQ(tree.levels[k].end, id);
        begin = id;
        idsAbove = ids;
    }
    ASSERT_EQ(tree.size(), begin);
}

TEST(TightLevels, AreAppendedFromTheRootDownByVoxel)
{
    Random random(3);
    for (int turn = 0; turn < 90; ++turn) {
        const auto levels = randomLevels(random);
        SphereTree tree;
        tree.flatAxis = turn % 3;
        tree.object.voxels = 77;
        appendLevels(levels, tree);
        ASSERT_EQ(tree.subdivision, 16);
        ASSERT_NO_FATAL_FAILURE(expectLevels(levels, tree, turn % 3)) << turn;
    }
}

TEST(TightLevels, HaveCutsThatAreTheForest)
{
    Random random(4);
    for (int turn = 0; turn < 9; ++turn) {
        const Forest forest = randomForest(20, 0.2, random);
        SphereTree tree; // of the balls, to compare with
        tree.flatAxis = turn % 3;
        const SphereCuts cuts = cutsOf(forest, tree.flatAxis);
        ASSERT_EQ(cuts.spheres.center.size(), forest.size());
        tree.spheres.center = cuts.spheres.center;
        tree.spheres.radius = cuts.spheres.radius;
        tree.spheres.coverRadiusSq = cuts.spheres.coverRadiusSq;
        for (const auto& center : cuts.spheres.center)
            tree.ijk.push_back(Coord::floor(center + 0.5));
        for (std::size_t i = 0; i < forest.size(); ++i) {
            ASSERT_NO_FATAL_FAILURE(expectNode(tree, int32_t(i), forest[i].ball, turn % 3));
            ASSERT_EQ(cuts.spheres.parent[i], forest[i].parent);
            ASSERT_EQ(cuts.first[i], forest[i].first);
            ASSERT_EQ(cuts.last[i], forest[i].last);
        }
        for (int64_t n = 1; n <= 20; ++n) ASSERT_EQ(cutNodes(cuts, n), cutOf(forest, n));
    }
}

TEST(TightLevels, BallsWithoutChildrenAreDropped)
{
    Random random(12);
    TightLevel level, finer;
    for (int b = 0; b < 5; ++b) {
        level.balls.push_back(randomBall(random, -30, 30, 5));
        level.parent.push_back(10 + b);
    }
    const auto balls = level.balls;
    finer.parent = {3, 1, 3, 4};
    dropChildless(level, finer);
    EXPECT_EQ(finer.parent, (std::vector<int32_t>{1, 0, 1, 2}));
    EXPECT_EQ(level.parent, (std::vector<int32_t>{11, 13, 14}));
    ASSERT_EQ(level.balls.size(), 3u);
    for (const auto& [now, before] : {std::pair(0, 1), std::pair(1, 3), std::pair(2, 4)}) {
        for (int a = 0; a < 3; ++a) {
            EXPECT_EQ(level.balls[now].center[a], balls[before].center[a]);
        }
        EXPECT_EQ(level.balls[now].radiusSq, balls[before].radiusSq);
    }
}

} // namespace
