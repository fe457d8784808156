// SPDX-License-Identifier: Apache-2.0
/// @file TestQueryCost.cc
/// @brief What questions to one tree cost: blocks that are tested, which are the same on every
/// machine. If trees, their blocks or the way through them get worse, this shows, where times on a
/// shared machine would not.

#include "ObjectReference.h"
#include "QuerySamples.h"
#include "support/GeneratedShapes.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/query/PointQuery.h>
#include <openvdb_spheretree/query/RayQuery.h>

#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

/// Mean blocks a question: of rays towards the object, and of points in and around it.
struct Cost {
    double ray = 0, point = 0, pointNear = 0;
};

Cost costOf(const QueryTree& tree, const std::vector<WorldBall>& balls)
{
    constexpr int kQuestions = 2000;
    Random random(51);
    Cost sum;
    for (int i = 0; i < kQuestions; ++i) {
        const Vec3d from = tree.center() + 2 * tree.radius() * randomDirection(random);
        const Vec3d at = randomPoint(random, balls);
        sum.ray += intersect(tree, {from, at - from}).blocks;
        sum.point += nearest(tree, at).blocks;
        sum.pointNear += nearest(tree, at, 0.02 * tree.radius()).blocks;
    }
    return {sum.ray / kQuestions, sum.point / kQuestions, sum.pointNear / kQuestions};
}

struct Expectation {
    std::string name;
    Shape shape;
    int branching;
    Cost own;   ///< of the tree's own spheres
    Cost plain; ///< of a hierarchy over its leaves that knows nothing of the tree
};

void PrintTo(const Expectation& expected, std::ostream* out) { *out << expected.name; }

void expectNear(double found, double expected, const std::string& what)
{
    EXPECT_NEAR(found, expected, 0.05 * expected) << what << " takes " << found << " blocks";
}

class QueryCost : public testing::TestWithParam<Expectation> {};

TEST_P(QueryCost, IsWithinAFewPerCentOfWhatItWas)
{
    const Expectation& expected = GetParam();
    TightOptions options;
    options.quality = Quality::Fast;
    options.budget.branching = expected.branching;
    SphereTreeSettings settings = options;
    settings.topology = false;
    const SphereTree tree = buildSphereTree(*made(expected.shape, 30000), settings);
    const auto balls = leafBalls(tree);
    const Cost own = costOf(makeQueryTree(tree), balls);
    expectNear(own.ray, expected.own.ray, "a ray");
    expectNear(own.point, expected.own.point, "a point");
    expectNear(own.pointNear, expected.own.pointNear, "a point with a cut-off");
    const Cost plain = costOf(makeQueryTree(tree, Exactness::LeafUnion), balls);
    expectNear(plain.ray, expected.plain.ray, "a ray, plain,");
    expectNear(plain.point, expected.plain.point, "a point, plain,");
    expectNear(plain.pointNear, expected.plain.pointNear, "a point with a cut-off, plain,");
}

INSTANTIATE_TEST_SUITE_P(Of, QueryCost,
    testing::Values(Expectation{"Gyroid", Shape::Gyroid, 8, {5.43, 6.96, 3.95}, {6.79, 8.15, 4.46}},
        Expectation{"GyroidByTwos", Shape::Gyroid, 2, {4.91, 6.31, 3.58}, {6.79, 8.15, 4.46}},
        Expectation{"Terrain", Shape::Terrain, 8, {6.48, 8.42, 4.28}, {6.58, 8.43, 4.22}}),
    [](const auto& info) { return info.param.name; });

} // namespace
