// SPDX-License-Identifier: Apache-2.0
/// @file TestPairCost.cc
/// @brief What questions to two bodies cost: blocks that are tested, which are the same on every machine. If trees, their
/// blocks or the way through them get worse, this shows, where times on a shared machine would not.

#include "QuerySamples.h"
#include "support/GeneratedShapes.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/query/BodyDistance.h>
#include <openvdb_spheretree/query/Collide.h>
#include <openvdb_spheretree/query/ContinuousCollide.h>

#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <string>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

/// Mean blocks a question: collide() near contact, slightly and deeply inside, distance() near contact, and
/// continuousCollide() of a screw to there.
constexpr std::array<const char*, 5> kQuestions = {"near", "slight", "deep", "distance", "screw"};
using Cost = std::array<double, 5>;

Cost costOf(const QueryTree& tree)
{
    constexpr int kPoses = 300;
    Random random(17);
    Cost sum = {};
    for (int i = 0; i < kPoses; ++i) {
        const RigidTransform turn = randomRotation(random);
        const Vec3d along = randomDirection(random);
        const auto at = [&](double offset) {
            return RigidTransform::fromTranslation(
                       tree.center() + offset * along - turn.rotate(tree.center()))
                * turn;
        };
        double low = 0, high = 2 * tree.radius();
        for (int step = 0; step < 24; ++step) {
            const double middle = 0.5 * (low + high);
            (collide(tree, {}, tree, at(middle)).isCollision() ? low : high) = middle;
        }
        const double amount = uniform(random, 0, 1);
        const RigidTransform near = at(high + 0.1 * amount * tree.radius());
        const auto start = RigidTransform::fromTranslation(3 * tree.radius() * along)
            * randomRotation(random) * near;
        sum[0] += double(collide(tree, {}, tree, near).blocks);
        sum[1] += double(collide(tree, {}, tree, at(high - 0.1 * amount * tree.radius())).blocks);
        sum[2] += double(collide(tree, {}, tree, at(0.7 * amount * high)).blocks);
        sum[3] += double(distance(tree, {}, tree, near).blocks);
        sum[4] += double(continuousCollide(tree, {}, tree, RigidMotion::screw(start, near)).blocks);
    }
    for (double& of : sum) of /= kPoses;
    return sum;
}

constexpr double kTolerance = 0.05;

void expectNear(const Cost& found, const Cost& expected, const std::string& what)
{
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_NEAR(found[i], expected[i], kTolerance * expected[i])
            << what << ": " << kQuestions[i];
    }
}

struct Expectation {
    std::string name;
    Shape shape;
    Cost own;   ///< of the tree's own spheres
    Cost plain; ///< of a hierarchy over its leaves that knows nothing of the tree
};

void PrintTo(const Expectation& expected, std::ostream* out) { *out << expected.name; }

class PairCost : public testing::TestWithParam<Expectation> {};

TEST_P(PairCost, IsWithinAFewPerCentOfWhatItWas)
{
    const Expectation& expected = GetParam();
    TightOptions options;
    options.quality = Quality::Fast;
    SphereTreeSettings settings = options;
    settings.topology = false;
    const SphereTree tree = buildSphereTree(*made(expected.shape, 30000), settings);
    expectNear(costOf(makeQueryTree(tree)), expected.own, "own");
    expectNear(costOf(makeQueryTree(tree, Exactness::LeafUnion)), expected.plain, "plain");
}

INSTANTIATE_TEST_SUITE_P(Of, PairCost,
    testing::Values(Expectation{"Gyroid", Shape::Gyroid, {25.8, 19.0, 13.0, 76.1, 58.6},
                        {41.4, 25.3, 11.9, 135.0, 83.6}},
        Expectation{"Terrain", Shape::Terrain, {91.8, 59.7, 42.4, 359.4, 181.0},
            {91.5, 65.5, 32.0, 439.9, 199.5}}),
    [](const auto& info) { return info.param.name; });

} // namespace
