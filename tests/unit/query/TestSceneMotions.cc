// SPDX-License-Identifier: Apache-2.0
/// @file TestSceneMotions.cc
/// @brief When bodies of a scene that all move first touch, against every two of them.

#include "QuerySamples.h"
#include "RandomScene.h"
#include "support/Messages.h"

#include <openvdb_spheretree/base/Interrupted.h>

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;
using Motions = std::vector<RigidMotion>;

/// Bodies on their ways through a box: along lines, on screws, about far axes, and some that stand still.
struct MovingScene : RandomScene {
    Motions motions;

    MovingScene(Random& random, int count, const Vec3d& box) : RandomScene(random, count, box)
    {
        std::vector<RigidTransform> starts;
        for (int i = 0; i < count; ++i) starts.push_back(scene.pose(i));
        shake(random, box);
        for (int i = 0; i < count; ++i) {
            const RigidTransform &start = starts[std::size_t(i)], &end = scene.pose(i);
            const Vec3d way = end.translation() - start.translation();
            switch (i % 4) {
            case 0: motions.push_back(RigidMotion::line(start, way)); break;
            case 1: motions.push_back(RigidMotion::screw(start, end)); break;
            case 2: {
                const Vec3d axis = randomDirection(random);
                const auto turn = RigidTransform::fromRotation(axis, 1e-6);
                motions.push_back(
                    RigidMotion::screw(start, RigidTransform::fromTranslation(way) * start * turn));
                break;
            }
            default: motions.push_back(RigidMotion::line(start, Vec3d(0.0)));
            }
        }
    }

    ContinuousCollisionResult movingAlone(
        int a, int b, const ContinuousCollisionRequest& request) const
    {
        return continuousCollide(scene.tree(a), motions[std::size_t(a)], scene.tree(b),
            motions[std::size_t(b)], request);
    }
};

void expectSame(const ContinuousCollisionResult& one, const ContinuousCollisionResult& other)
{
    EXPECT_EQ(one.isCollide, other.isCollide);
    EXPECT_EQ(one.isDecided, other.isDecided);
    EXPECT_EQ(one.timeOfContact, other.timeOfContact);
    EXPECT_EQ(one.freeUntil, other.freeUntil);
    EXPECT_EQ(one.blocks, other.blocks);
    ASSERT_EQ(one.contact.has_value(), other.contact.has_value());
    if (one.contact) {
        EXPECT_EQ(one.contact->nodes, other.contact->nodes);
    }
}

/// @return how many pairs touch.
int expectAllPairs(const MovingScene& moving, const ContinuousCollisionRequest& request)
{
    const std::vector<MovingPair> found = moving.scene.firstContacts(moving.motions, request);
    auto next = found.begin();
    for (int a = 0; a < moving.scene.size(); ++a) {
        for (int b = a + 1; b < moving.scene.size(); ++b) {
            const ContinuousCollisionResult alone = moving.movingAlone(a, b, request);
            if (!alone.isCollide && alone.isDecided) continue;
            if (next == found.end() || next->a != a || next->b != b) {
                ADD_FAILURE() << "bodies " << a << " and " << b << " are not among the answers";
                return 0;
            }
            expectSame((next++)->result, alone);
        }
    }
    EXPECT_EQ(next, found.end());
    return int(found.size());
}

} // namespace

TEST(SceneMotions, PairsAreThoseThatTouchWhereEveryTwoAreAsked)
{
    Random random(29);
    int touching = 0;
    for (const Vec3d box : {Vec3d(30, 2, 2), Vec3d(4, 4, 40), Vec3d(12, 12, 12)}) {
        const MovingScene moving(random, 24, box);
        touching += expectAllPairs(moving, {});
        ContinuousCollisionRequest early, bounded, wide;
        early.endTime = 0.3;
        bounded.maxBlocks = 40;
        wide.securityMargin = 1;
        EXPECT_GT(expectAllPairs(moving, wide), expectAllPairs(moving, {}));
        const int before = expectAllPairs(moving, early);
        EXPECT_GT(before, 0);
        EXPECT_LT(before, expectAllPairs(moving, bounded));
    }
    EXPECT_GT(touching, 25);
}

TEST(SceneMotions, BodiesWithinTheMarginAreAskedAboutThatAreFarOtherwise)
{
    const QueryTree dot = makeQueryTree(querySample("one voxel").tree);
    QueryScene scene;
    Motions motions;
    for (const double y : {0.0, 20.0, 60.0}) {
        scene.add(dot);
        motions.push_back(
            RigidMotion::line(RigidTransform::fromTranslation(Vec3d(0, y, 0)), Vec3d(1, 0, 0)));
    }
    EXPECT_TRUE(scene.firstContacts(motions).empty());
    ContinuousCollisionRequest request;
    request.securityMargin = 30;
    const auto found = scene.firstContacts(motions, request);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(std::pair(found[0].a, found[0].b), std::pair(0, 1));
    EXPECT_EQ(found[0].result.timeOfContact, 0);
}

TEST(SceneMotions, PosesTakeNoPartNorDoBodiesThatAreRemovedOrPairsThatAreIgnored)
{
    Random random(31);
    MovingScene moving(random, 12, Vec3d(4, 4, 4));
    QueryScene& scene = moving.scene;
    const auto all = scene.firstContacts(moving.motions);
    ASSERT_GT(all.size(), 6u);
    scene.setPose(0, RigidTransform::fromTranslation(Vec3d(1e6, 0, 0)));
    EXPECT_EQ(scene.firstContacts(moving.motions).size(), all.size());
    scene.ignore(all[0].b, all[0].a);
    const auto without = scene.firstContacts(moving.motions);
    ASSERT_EQ(without.size(), all.size() - 1);
    EXPECT_EQ(std::make_pair(without[0].a, without[0].b), std::make_pair(all[1].a, all[1].b));
    const int gone = all[1].a;
    scene.remove(gone);
    std::size_t others = 0;
    for (const MovingPair& pair : without) others += pair.a != gone && pair.b != gone;
    ASSERT_LT(others, without.size());
    EXPECT_EQ(scene.firstContacts(moving.motions).size(), others);
}

TEST(SceneMotions, AnswersAreTheSameForAnyNumberOfThreads)
{
    Random random(37);
    const MovingScene moving(random, 20, Vec3d(6, 6, 6));
    std::vector<MovingPair> found[2];
    for (const int threads : {1, 4}) {
        tbb::task_arena arena(threads);
        arena.execute([&] { found[threads > 1] = moving.scene.firstContacts(moving.motions); });
    }
    ASSERT_EQ(found[0].size(), found[1].size());
    ASSERT_FALSE(found[0].empty());
    for (std::size_t i = 0; i < found[0].size(); ++i) {
        EXPECT_EQ(found[0][i].a, found[1][i].a);
        EXPECT_EQ(found[0][i].b, found[1][i].b);
        expectSame(found[0][i].result, found[1][i].result);
    }
}

/// The sphere around a way holds its end, too.
TEST(SceneMotions, BodiesThatMeetAtTheEndOfHalfATurnAreFound)
{
    const QueryTree tree = makeQueryTree(querySamples().front().tree);
    const Vec3d center = tree.center();
    const auto placed = [&](const Vec3d& at) {
        return RigidTransform::fromTranslation(at - center);
    };
    for (const double radius : {10.0, 1e3, 1e6}) {
        QueryScene scene;
        scene.add(tree), scene.add(tree);
        const Motions motions = {
            RigidMotion::screw(placed(Vec3d(radius, 0, 0)), Vec3d(0.0), Vec3d(0, 0, 1), M_PI, 0),
            RigidMotion::line(placed(Vec3d(-radius, 0, 0)), Vec3d(0.0))};
        const auto found = scene.firstContacts(motions);
        ASSERT_EQ(found.size(), 1u) << radius;
        EXPECT_GT(found[0].result.timeOfContact, 1 - 3 * tree.radius() / radius) << radius;
    }
}

TEST(SceneMotions, RefusesQuestionsThatMeanNothing)
{
    QueryScene scene;
    EXPECT_TRUE(scene.firstContacts({}).empty());
    const QueryTree tree = makeQueryTree(querySamples().front().tree);
    scene.add(tree), scene.add(tree);
    const RigidMotion still = RigidMotion::line({}, Vec3d(0.0));
    for (const std::size_t count : {0u, 1u, 3u}) {
        const auto why =
            messageOf<openvdb::ValueError>([&] { scene.firstContacts(Motions(count, still)); });
        EXPECT_TRUE(mentions(why, "2 bodies, and there are " + std::to_string(count) + " motions"));
    }
    ContinuousCollisionRequest request;
    for (const double end : {0.0, -1.0, 1.5, std::nan("")}) {
        request.endTime = end;
        EXPECT_THROW(scene.firstContacts({still, still}, request), openvdb::ValueError) << end;
    }
    request.endTime = 1;
    for (const double tolerance : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        request.tolerance = tolerance;
        EXPECT_THROW(scene.firstContacts({still, still}, request), openvdb::ValueError);
    }
    const RigidMotion far = RigidMotion::screw({}, Vec3d(0.0), Vec3d(0, 0, 1), 0, 1e200);
    const auto tooFar = messageOf<openvdb::ValueError>([&] { scene.firstContacts({still, far}); });
    EXPECT_TRUE(mentions(tooFar, "ValueError: a motion goes 1e+200")) << tooFar;
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    EXPECT_THROW(scene.firstContacts({still, still}, {}, &stop), Interrupted);
}
