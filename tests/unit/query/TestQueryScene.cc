// SPDX-License-Identifier: Apache-2.0
/// @file TestQueryScene.cc
/// @brief Which bodies of a scene touch, against all pairs of bodies and of their leaf spheres.

#include "QuerySamples.h"
#include "RandomScene.h"
#include "support/Messages.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/query/QueryScene.h>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;
using Pairs = std::vector<std::pair<int, int>>;

/// Leaves grow by rounding to floats: gaps this near to 0 may be either.
constexpr double kRounding = 2e-5;

Pairs pairsOf(const std::vector<ScenePair>& found)
{
    Pairs pairs;
    for (const ScenePair& pair : found) pairs.emplace_back(pair.a, pair.b);
    return pairs;
}

bool isAmong(const Pairs& pairs, int a, int b)
{
    return std::binary_search(pairs.begin(), pairs.end(), std::make_pair(a, b));
}

/// @return how many pairs touch.
int expectAllPairs(const RandomScene& random, double margin)
{
    CollisionRequest request;
    request.securityMargin = margin;
    const Pairs found = pairsOf(random.scene.touchingPairs(request));
    const Pairs near = random.scene.nearPairs(margin);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    int touching = 0;
    for (int a = 0; a < random.scene.size(); ++a) {
        for (int b = a + 1; b < random.scene.size(); ++b) {
            const double gap = random.smallestGap(a, b) - margin;
            EXPECT_TRUE(gap > kRounding || isAmong(near, a, b)) << a << " " << b << " " << gap;
            if (std::abs(gap) < kRounding) continue;
            EXPECT_EQ(isAmong(found, a, b), gap < 0) << a << " " << b << " " << gap;
            touching += gap < 0;
        }
    }
    return touching;
}

} // namespace

TEST(QueryScene, FindsThePairsThatTouchAndNoOthers)
{
    Random random(71);
    int touching = 0;
    for (const Vec3d box : {Vec3d(30, 2, 2), Vec3d(2, 30, 3), Vec3d(4, 4, 40), Vec3d(12, 12, 12)}) {
        RandomScene scene(random, 30, box);
        for (int step = 0; step < 4; ++step) {
            touching += expectAllPairs(scene, 0) + expectAllPairs(scene, 1.5);
            scene.shake(random, box);
        }
    }
    EXPECT_GT(touching, 300);
}

TEST(QueryScene, FarFromTheOriginAndInALineAtOnePlace)
{
    Random random(5);
    RandomScene far(random, 20, Vec3d(4, 4, 4));
    for (int i = 0; i < far.scene.size(); ++i) {
        const RigidTransform away = RigidTransform::fromTranslation(Vec3d(1e4, -2e4, 3e4));
        far.scene.setPose(i, away * far.scene.pose(i));
    }
    EXPECT_GT(expectAllPairs(far, 0), 3);
    RandomScene same(random, 12, Vec3d(0.0));
    EXPECT_GT(expectAllPairs(same, 0), 20);
}

TEST(QueryScene, IgnoredPairsAreNotAmongTheAnswersUntilTheyAreAgain)
{
    Random random(11);
    RandomScene random12(random, 12, Vec3d(3, 3, 3));
    QueryScene& scene = random12.scene;
    const Pairs all = pairsOf(scene.touchingPairs());
    ASSERT_GT(all.size(), 4u);
    scene.ignore(all[1].second, all[1].first);
    EXPECT_TRUE(scene.isIgnored(all[1].first, all[1].second));
    EXPECT_FALSE(scene.isIgnored(all[0].first, all[0].second));
    Pairs rest = all;
    rest.erase(rest.begin() + 1);
    EXPECT_EQ(pairsOf(scene.touchingPairs()), rest);
    EXPECT_FALSE(isAmong(scene.nearPairs(), all[1].first, all[1].second));
    scene.ignore(all[1].first, all[1].second, false);
    EXPECT_EQ(pairsOf(scene.touchingPairs()), all);
}

TEST(QueryScene, AnswersAreThoseOfCollideForAnyNumberOfThreads)
{
    Random random(3);
    const RandomScene scene(random, 25, Vec3d(6, 6, 6));
    CollisionRequest request;
    request.enableContact = true;
    std::vector<ScenePair> found[2];
    for (const int threads : {1, 4}) {
        tbb::task_arena arena(threads);
        arena.execute([&] { found[threads > 1] = scene.scene.touchingPairs(request); });
    }
    ASSERT_EQ(pairsOf(found[0]), pairsOf(found[1]));
    ASSERT_FALSE(found[0].empty());
    for (std::size_t i = 0; i < found[0].size(); ++i) {
        const ScenePair& one = found[0][i];
        const CollisionResult alone = scene.alone(one.a, one.b, request);
        for (const ScenePair& pair : {one, found[1][i]}) {
            EXPECT_EQ(pair.result.verdict, alone.verdict);
            EXPECT_EQ(pair.result.blocks, alone.blocks);
            EXPECT_EQ(pair.result.contact->nodes, alone.contact->nodes);
        }
    }
}

TEST(QueryScene, ContactsOfAPairAreThoseOfCollide)
{
    Random random(8);
    const RandomScene scene(random, 20, Vec3d(4, 4, 4));
    CollisionRequest request;
    request.maxContacts = 5;
    std::size_t several = 0;
    for (const ScenePair& pair : scene.scene.touchingPairs(request)) {
        std::vector<Contact> contacts;
        scene.alone(pair.a, pair.b, request, &contacts);
        ASSERT_EQ(pair.contacts.size(), contacts.size());
        for (std::size_t k = 0; k < contacts.size(); ++k) {
            EXPECT_EQ(pair.contacts[k].nodes, contacts[k].nodes);
            EXPECT_EQ(pair.contacts[k].distance, contacts[k].distance);
        }
        several += contacts.size() > 1;
    }
    EXPECT_GT(several, 10u);
    for (const ScenePair& pair : scene.scene.touchingPairs()) EXPECT_TRUE(pair.contacts.empty());
}

TEST(QueryScene, WhatIsUndecidedIsAmongTheAnswers)
{
    Random random(19);
    const RandomScene scene(random, 25, Vec3d(5, 5, 5));
    CollisionRequest request;
    request.maxBlocks = 1;
    std::size_t undecided = 0;
    const auto bounded = scene.scene.touchingPairs(request);
    for (const ScenePair& pair : bounded) {
        undecided += pair.result.verdict == Verdict::Undecided;
    }
    EXPECT_GT(undecided, 0u);
    EXPECT_GE(bounded.size(), scene.scene.touchingPairs().size());
}

TEST(QueryScene, HasNoAnswersWithoutTwoBodies)
{
    QueryScene scene;
    EXPECT_TRUE(scene.nearPairs().empty());
    EXPECT_TRUE(scene.touchingPairs().empty());
    scene.add(makeQueryTree(querySamples().front().tree));
    EXPECT_TRUE(scene.touchingPairs().empty());
}

TEST(QueryScene, RefusesBodiesThatAreNotThereAndMarginsThatAreNone)
{
    QueryScene scene;
    scene.add(makeQueryTree(querySamples().front().tree));
    for (const int body : {-1, 1}) {
        const auto why = messageOf<openvdb::IndexError>([&] { scene.setPose(body, {}); });
        EXPECT_TRUE(mentions(why, "no body " + std::to_string(body)));
        EXPECT_THROW(scene.pose(body), openvdb::IndexError);
        EXPECT_THROW(scene.tree(body), openvdb::IndexError);
        EXPECT_THROW(scene.ignore(0, body), openvdb::IndexError);
        EXPECT_THROW(scene.isIgnored(body, 0), openvdb::IndexError);
    }
    for (const double margin : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW(scene.nearPairs(margin), openvdb::ValueError);
    }
    const QueryTree tree = scene.tree(0);
    scene.add(tree);
    CollisionRequest request;
    request.maxContacts = -3;
    const auto why = messageOf<openvdb::ValueError>([&] { scene.touchingPairs(request); });
    EXPECT_TRUE(mentions(why, "bodies 0 and 1"));
}

TEST(QueryScene, CanBeInterrupted)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    QueryScene scene;
    const QueryTree tree = makeQueryTree(querySamples().front().tree);
    scene.add(tree);
    scene.add(tree);
    EXPECT_THROW(scene.touchingPairs({}, &stop), Interrupted);
}

TEST(QueryScene, BodiesThatAreRemovedTouchNothing)
{
    const QueryTree tree = makeQueryTree(querySamples().front().tree);
    QueryScene scene;
    for (int i = 0; i < 4; ++i) scene.add(tree);
    scene.ignore(0, 1);
    scene.remove(1);
    EXPECT_EQ(scene.size(), 4);
    EXPECT_FALSE(scene.has(1));
    EXPECT_TRUE(scene.has(2));
    EXPECT_FALSE(scene.has(4));
    const auto pairs = scene.nearPairs();
    EXPECT_EQ(pairs, (std::vector<std::pair<int, int>>{{0, 2}, {0, 3}, {2, 3}}));
    EXPECT_EQ(scene.touchingPairs().size(), 3u);
    EXPECT_THROW(scene.setPose(1, {}), openvdb::IndexError);
    EXPECT_THROW(scene.remove(1), openvdb::IndexError);
    EXPECT_THROW(scene.isIgnored(0, 1), openvdb::IndexError);
    EXPECT_EQ(scene.add(tree), 4);
    EXPECT_EQ(scene.nearPairs().size(), 6u);
    for (const int body : {0, 2, 3, 4}) scene.remove(body);
    EXPECT_TRUE(scene.touchingPairs().empty());
}
