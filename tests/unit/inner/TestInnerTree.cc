// SPDX-License-Identifier: Apache-2.0
/// @file TestInnerTree.cc
/// @brief Inner spheres: the greedy order against a search that counts everything anew, and the
/// trees made of it.

#include <openvdb_spheretree/base/Rounding.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/inner/InnerBalls.h>
#include <openvdb_spheretree/inner/InnerOrder.h>
#include <openvdb_spheretree/inner/UncoveredVoxels.h>
#include <openvdb_spheretree/measure/LevelErrors.h>

#include "support/BuiltTrees.h"
#include "support/Messages.h"

#include <openvdb_spheretree/base/Interrupted.h>

#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <map>
#include <random>

namespace {

using namespace openvdb_spheretree;
using openvdb_spheretree::detail::InnerOrder;
using openvdb_spheretree::detail::innerOrder;
using namespace spheretree_test;
using openvdb::Vec3d;

Voxels voxelsIn(const MedialBall& ball, int dim)
{
    const int reach = int(std::sqrt(double(ball.radiusSq)));
    const Coord corner(reach, reach, dim == 2 ? 0 : reach);
    Voxels voxels;
    for (const Coord& v : voxelsOfBox(CoordBBox(ball.center - corner, ball.center + corner))) {
        if (squaredDistance(v, ball.center) < ball.radiusSq) voxels.push_back(v);
    }
    return voxels;
}

/// Counts all balls anew before each choice; of equals the larger, then the first by center.
InnerOrder naiveOrder(const Voxels& object, const std::vector<MedialBall>& balls, int dim)
{
    std::set<Coord> left(object.begin(), object.end());
    std::vector<Voxels> voxels;
    for (const MedialBall& ball : balls) voxels.push_back(voxelsIn(ball, dim));
    InnerOrder order;
    while (!left.empty()) {
        std::size_t best = 0;
        int64_t most = -1;
        for (std::size_t i = 0; i < balls.size(); ++i) {
            int64_t gain = 0;
            for (const Coord& v : voxels[i]) gain += int64_t(left.count(v));
            const bool larger = gain == most && balls[i].radiusSq > balls[best].radiusSq;
            if (gain < most || (gain == most && !larger)) continue;
            most = gain;
            best = i;
        }
        for (const Coord& v : voxels[best]) left.erase(v);
        order.ball.push_back(int32_t(best));
        order.covered.push_back(int64_t(object.size() - left.size()));
    }
    return order;
}

SphereTreeSettings innerSettings(const std::vector<int64_t>& spheres = {})
{
    SphereTreeSettings settings = InnerOptions();
    settings.budgeted().budget.spheres = spheres;
    return settings;
}

/// A shell with holes in it.
Voxels severalBalls()
{
    Random random(7);
    return shapes::pricked(shapes::ball(90, 16), 0.02, random);
}

bool contains(const Voxels& voxels, const Coord& voxel)
{
    return std::binary_search(voxels.begin(), voxels.end(), voxel);
}

} // namespace

TEST(InnerOrder, IsStrictlyGreedy)
{
    for (const RandomObject& object : someObjects(0, 66)) {
        for (const int dim : {3, 2}) {
            SCOPED_TRACE(object.name + ", dim " + std::to_string(dim));
            const Voxels voxels = dim == 2 ? flattened(object.voxels) : object.voxels;
            const CoreStages stages(*maskOf(voxels), dim);
            const InnerOrder order = innerOrder(stages.layout, stages.balls, dim);
            const InnerOrder naive = naiveOrder(voxels, stages.balls, dim);
            ASSERT_EQ(order.ball, naive.ball);
            ASSERT_EQ(order.covered, naive.covered);
        }
    }
}

TEST(InnerOrder, EndsWhereItIsTold)
{
    const CoreStages stages(*maskOf(severalBalls()));
    const InnerOrder all = innerOrder(stages.layout, stages.balls);
    ASSERT_GT(all.ball.size(), 5u);
    const InnerOrder some = innerOrder(stages.layout, stages.balls, 3, 5);
    EXPECT_EQ(some.ball, std::vector<int32_t>(all.ball.begin(), all.ball.begin() + 5));
    EXPECT_EQ(some.covered, std::vector<int64_t>(all.covered.begin(), all.covered.begin() + 5));
    EXPECT_TRUE(innerOrder(stages.layout, stages.balls, 3, 0).ball.empty());
}

TEST(InnerOrder, IsTheSameForAnyNumberOfThreads)
{
    using Control = tbb::global_control;
    Random random(1);
    Voxels voxels = shapes::noise(Coord(60, 50, 40), 0.97, random);
    const CoreStages stages(*maskOf(voxels));
    std::vector<InnerOrder> orders;
    for (const std::size_t threads : {1, 2, 5}) {
        const Control control(Control::max_allowed_parallelism, threads);
        orders.push_back(innerOrder(stages.layout, stages.balls));
    }
    for (const InnerOrder& order : orders) {
        EXPECT_EQ(order.ball, orders[0].ball);
        EXPECT_EQ(order.covered, orders[0].covered);
    }
}

TEST(InnerOrder, CanBeInterrupted)
{
    const CoreStages stages(*maskOf(shapes::ball(90)));
    StopAfter stop;
    EXPECT_THROW(innerOrder(stages.layout, stages.balls, 3, INT64_MAX, &stop), Interrupted);
}

TEST(InnerBalls, LieInsideTheObjectAndTogetherAreTheObject)
{
    for (const RandomObject& object : someObjects(100, 33)) {
        for (const int dim : {3, 2}) {
            SCOPED_TRACE(object.name + ", dim " + std::to_string(dim));
            const Voxels voxels = dim == 2 ? flattened(object.voxels) : object.voxels;
            std::set<Coord> covered;
            for (const MedialBall& ball : innerBalls(*gridOf(voxels), INT64_MAX, dim)) {
                for (const Coord& v : voxelsIn(ball, dim)) {
                    ASSERT_TRUE(contains(voxels, v)) << v;
                    covered.insert(v);
                }
            }
            ASSERT_EQ(covered.size(), voxels.size());
        }
    }
}

TEST(InnerBalls, OfAnObjectFlatAlongAnotherAxisAreTurnedWithIt)
{
    const Voxels flat = flattened(randomObject(20).voxels);
    Voxels turned;
    for (const Coord& v : flat) turned.emplace_back(v[2], v[0], v[1]);
    const auto upright = innerBalls(*gridOf(flat), 7, 2);
    const auto balls = innerBalls(*gridOf(turned), 7, 2);
    ASSERT_EQ(balls.size(), upright.size());
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const Coord& c = upright[i].center;
        EXPECT_EQ(balls[i].center, Coord(c[2], c[0], c[1]));
        EXPECT_EQ(balls[i].radiusSq, upright[i].radiusSq);
    }
}

TEST(InnerTree, HasTheFirstBallsOfTheOrderOnEachLevel)
{
    for (const RandomObject& object : someObjects(200, 33)) {
        SCOPED_TRACE(object.name);
        const auto grid = gridOf(object.voxels);
        const auto order = innerBalls(*grid, INT64_MAX);
        const SphereTree tree = buildSphereTree(*grid, innerSettings());
        const auto counts = SphereBudget().counts(int64_t(order.size()));
        ASSERT_EQ(tree.levels.size(), counts.size());
        for (std::size_t k = 0; k < counts.size(); ++k) {
            const SphereTreeLevel& level = tree.levels[k];
            ASSERT_EQ(level.level, int(k));
            ASSERT_EQ(level.size(), counts[k]);
            std::map<Coord, int32_t> expected;
            for (int64_t i = 0; i < counts[k]; ++i) {
                expected[order[i].center] = order[i].radiusSq;
            }
            auto next = expected.begin(); // in the order of centers
            for (int32_t id = level.begin; id < level.end; ++id, ++next) {
                ASSERT_EQ(tree.ijk[id], next->first);
                ASSERT_EQ(tree.radiusSq[id], next->second);
                ASSERT_EQ(tree.spheres.center[id], next->first.asVec3d());
                ASSERT_EQ(tree.spheres.coverRadiusSq[id], 4 * (int64_t(next->second) - 1));
            }
        }
    }
}

TEST(InnerTree, HangsABallBelowItselfOrTheNearestByPower)
{
    int own = 0, others = 0;
    for (const RandomObject& object : someObjects(300, 33)) {
        SCOPED_TRACE(object.name);
        SphereTreeSettings settings = innerSettings();
        settings.budgeted().budget.branching = 3;
        const SphereTree tree = buildSphereTree(*gridOf(object.voxels), settings);
        ASSERT_TRUE(endsAtOneRoot(tree));
        for (std::size_t k = 0; k + 1 < tree.levels.size(); ++k) {
            const SphereTreeLevel& above = tree.levels[k + 1];
            for (int32_t id = tree.levels[k].begin; id < tree.levels[k].end; ++id) {
                int32_t expected = -1;
                int64_t least = INT64_MAX;
                for (int32_t t = above.begin; t < above.end; ++t) {
                    const bool same = tree.ijk[t] == tree.ijk[id];
                    const int64_t power = same
                        ? INT64_MIN
                        : squaredDistance(tree.ijk[t], tree.ijk[id]) - tree.radiusSq[t];
                    if (power < least) expected = t;
                    least = std::min(least, power);
                }
                ASSERT_EQ(tree.spheres.parent[id], expected);
                (tree.ijk[expected] == tree.ijk[id] ? own : others) += 1;
            }
        }
    }
    EXPECT_GT(own, 100);
    EXPECT_GT(others, 100);
}

TEST(InnerTree, HasNoExcessAndMissesWhatItDoesNotCover)
{
    for (const RandomObject& object : someObjects(400, 33)) {
        SCOPED_TRACE(object.name);
        const auto grid = gridOf(object.voxels);
        SphereTree tree = buildSphereTree(*grid, innerSettings());
        computeLevelErrors(tree, *grid);
        for (const SphereTreeLevel& level : tree.levels) {
            ASSERT_EQ(level.error->excess, 0);
            ASSERT_EQ(level.error->hausdorff, 0);
            ASSERT_EQ(level.error->covered, level.pyramidVoxels);
            ASSERT_EQ(level.error->missing, tree.object.voxels - level.pyramidVoxels);
        }
        ASSERT_EQ(tree.levels[0].error->missing, 0);
        ASSERT_TRUE(tree.levels[0].topology.has_value());
    }
}

TEST(InnerTree, StopsAtTheLargestNumberAskedFor)
{
    const auto grid = gridOf(severalBalls());
    const SphereTree all = buildSphereTree(*grid, innerSettings());
    ASSERT_GT(all.levels[0].size(), 8);
    const SphereTree tree = buildSphereTree(*grid, innerSettings({2, 6}));
    ASSERT_EQ(tree.levels.size(), 2u);
    EXPECT_EQ(tree.levels[0].size(), 6);
    EXPECT_EQ(tree.root().size(), 2);
    EXPECT_EQ(tree.spheres.parent[0], -1);
    EXPECT_EQ(tree.spheres.parent[1], -1);
    EXPECT_FALSE(tree.levels[0].topology.has_value()) << "level 0 is not the object";
    const SphereTree more = buildSphereTree(*grid, innerSettings({1 << 20}));
    ASSERT_EQ(more.levels.size(), 1u);
    EXPECT_EQ(more.levels[0].size(), all.levels[0].size());
}

TEST(InnerTree, StoresRadiiRoundedDownAndAddsNothing)
{
    const auto transform = openvdb::math::Transform::createLinearTransform(0.1);
    transform->postRotate(0.7, openvdb::math::X_AXIS);
    transform->postTranslate(Vec3d(1e5, -1e5, 1e5 / 3));
    for (const RandomObject& object : someObjects(500, 22)) {
        SCOPED_TRACE(object.name);
        const auto grid = gridOf(object.voxels);
        grid->setTransform(transform->copy());
        SphereTreeSettings settings = innerSettings();
        settings.padding = 3;
        const SphereTree tree = buildSphereTree(*grid, settings);
        ASSERT_EQ(tree.settings.padding, 3) << "what was asked for";
        ASSERT_EQ(tree.settings.paddingVoxels(), 0);
        for (int32_t id = 0; id < tree.size(); ++id) {
            const long double exact = std::sqrt((long double)(tree.radiusSq[id] - 1));
            ASSERT_LE((long double)(tree.spheres.radius[id]), exact);
            ASSERT_NEAR(tree.spheres.radius[id], double(exact), 1e-12);
            ASSERT_LE(
                double(tree.spheres.radiusWorld[id]), tree.spheres.radius[id] * tree.voxelSize());
            ASSERT_NEAR(tree.spheres.radiusWorld[id], 0.1 * tree.spheres.radius[id], 1e-6);
            const Coord reach(int(tree.spheres.radius[id]) + 2);
            for (const Coord& q :
                voxelsOfBox(CoordBBox(tree.ijk[id] - reach, tree.ijk[id] + reach))) {
                const Vec3d at = tree.transform->indexToWorld(q.asVec3d());
                if ((at - tree.centerWorld(id)).length() > double(tree.spheres.radiusWorld[id]))
                    continue;
                ASSERT_TRUE(contains(object.voxels, q)) << q;
            }
        }
    }
}

TEST(InnerTree, InTwoDimensionsIsTurnedWithItsObject)
{
    for (const RandomObject& object : someObjects(600, 11)) {
        const Voxels flat = flattened(object.voxels);
        SphereTreeSettings settings = innerSettings();
        settings.dim = 2;
        const SphereTree upright = buildSphereTree(*gridOf(flat), settings);
        Voxels turned;
        for (const Coord& v : flat) turned.emplace_back(v[2], v[0], v[1]);
        if (boxOf(flat).min()[0] == boxOf(flat).max()[0]) continue; // flat along two axes
        if (boxOf(flat).min()[1] == boxOf(flat).max()[1]) continue;
        SphereTree tree = buildSphereTree(*gridOf(turned), settings);
        for (Coord& ijk : tree.ijk) ijk = Coord(ijk[1], ijk[2], ijk[0]);
        for (Vec3d& center : tree.spheres.center) center = Vec3d(center[1], center[2], center[0]);
        EXPECT_TRUE(sameNodes(tree, upright)) << object.name;
    }
}

TEST(InnerTree, WithCutsHasABallInEveryCutFromItsOwnOn)
{
    const auto grid = gridOf(severalBalls());
    SphereTreeSettings settings = innerSettings({3});
    EXPECT_TRUE(buildSphereTree(*grid, settings).cuts.empty());
    settings.budgeted().cuts = true;
    const SphereTree tree = buildSphereTree(*grid, settings);
    const auto order = innerBalls(*grid, INT64_MAX);
    EXPECT_EQ(tree.size(), 3);
    ASSERT_EQ(tree.cuts.size(), int32_t(order.size()));
    for (int32_t i = 0; i < tree.cuts.size(); ++i) {
        EXPECT_EQ(tree.cuts.spheres.center[i], order[i].center.asVec3d());
        EXPECT_EQ(tree.cuts.spheres.coverRadiusSq[i], 4 * (int64_t(order[i].radiusSq) - 1));
        EXPECT_EQ(tree.cuts.spheres.radius[i], detail::sqrtDown(order[i].radiusSq - 1.0));
        EXPECT_LE(double(tree.cuts.spheres.radiusWorld[i]), tree.cuts.spheres.radius[i]);
        EXPECT_EQ(tree.cuts.spheres.parent[i], -1);
        EXPECT_EQ(tree.cuts.first[i], i + 1);
        EXPECT_EQ(tree.cuts.last[i], tree.cuts.size());
    }
}
