// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/merge/StrictMerging.h>

#include "support/ChosenObjects.h"
#include "support/FineBalls.h"

#include <openvdb_spheretree/tight/region/PowerCells.h>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

constexpr FitEffort kEffort{false, 4, 1, false, 40};

/// Merges, and knows what each node has to hold and what it costs.
class WatchedMerging : public MergeModel {
public:
    WatchedMerging(const Voxels& voxels, const std::vector<ExactSphere>& leaves,
        const HeldByLeafBalls& held, bool flat = false, const FitEffort& effort = kEffort)
        : mVoxels(voxels), mObject(sampled(voxels)),
          mModel(mObject, ungrouped(leaves), held, effort, flat, nullptr),
          mVoxelsOnly(held.areVoxels), mBalls(leaves), mHeld(held.held)
    {}
    /// They are not asked for: of discs they are those of balls, and of large balls estimates.
    void leaveOutCosts() { mCosts = false; }
    std::vector<ExactSphere> leafBalls() const override { return mModel.leafBalls(); }
    MergeCandidate evaluate(int32_t a, int32_t b) const override { return mModel.evaluate(a, b); }
    void complete(MergeCandidate& merge) const override { mModel.complete(merge); }
    bool dependsOnOthers() const override { return mModel.dependsOnOthers(); }
    void merge(const std::vector<MergeCandidate>& merges, int32_t node) override
    {
        ASSERT_EQ(std::size_t(node), mBalls.size());
        for (const MergeCandidate& c : merges) {
            Held both = mHeld[c.a];
            both.insert(both.end(), mHeld[c.b].begin(), mHeld[c.b].end());
            ASSERT_NO_FATAL_FAILURE(expectHeld(c, both));
            if (mCosts) {
                ASSERT_NO_FATAL_FAILURE(expectCost(c));
            }
            mBalls.push_back(c.ball);
            mHeld.push_back(both);
        }
        mModel.merge(merges, node);
    }

private:
    /// All of it, and in the smallest ball with that center.
    void expectHeld(const MergeCandidate& c, const Held& held) const
    {
        ExactSphere smaller = c.ball;
        --smaller.radiusSq;
        bool needsAll = held.empty();
        for (const ExactSphere& ball : held) {
            ASSERT_TRUE(contains(c.ball, ball));
            needsAll = needsAll || !contains(smaller, ball);
        }
        ASSERT_TRUE(needsAll);
    }
    void expectCost(const MergeCandidate& c) const
    {
        const auto own = [&](const ExactSphere& ball) { return double(excess({ball}, mVoxels)); };
        const double freed = own(mBalls[c.a]) + own(mBalls[c.b]);
        // Around balls in place of voxels, a radius in floats can be too short for a last voxel.
        ASSERT_NEAR(c.cost, own(c.ball) - freed, mVoxelsOnly ? 0 : 30);
    }

    Voxels mVoxels;
    SampledObject mObject;
    StrictMerging mModel;
    bool mVoxelsOnly, mCosts = true;
    std::vector<ExactSphere> mBalls;
    std::vector<Held> mHeld;
};

std::vector<ExactSphere> medialLeaves(const Voxels& voxels, int dim = 3)
{
    std::vector<ExactSphere> leaves;
    for (const auto& ball : CoreStages(*maskOf(voxels), dim).balls) {
        leaves.push_back(fineBall(ball));
    }
    return leaves;
}

void expectSound(WatchedMerging& model, const std::string& name)
{
    SCOPED_TRACE(name);
    const std::size_t leaves = model.leafBalls().size();
    const auto forest = mergeToRoots(model, 6, nullptr);
    ASSERT_EQ(forest.size(), 2 * leaves - 1);
    ASSERT_EQ(forest.back().parent, -1);
}

/// Of leaves below a node, the voxels of all cells are in its ball.
TEST(StrictMerging, HoldsTheVoxelsOfAllCellsBelow)
{
    for (const RandomObject& object : objectsNoWiderThan(15, 500, 540, 9)) {
        const auto leaves = medialLeaves(object.voxels);
        const auto cells = powerCellPoints(leaves, sampled(object.voxels).level(0), nullptr);
        WatchedMerging model(object.voxels, leaves, heldVoxels(cells, true));
        ASSERT_NO_FATAL_FAILURE(expectSound(model, object.name));
    }
}

/// More of them than are looked at while a ball is sought, too.
TEST(StrictMerging, HoldsTheLeafBallsBelow)
{
    std::size_t most = 0;
    for (const RandomObject& object : objectsNoWiderThan(15, 540, 580, 10)) {
        const auto leaves = medialLeaves(object.voxels);
        WatchedMerging model(object.voxels, leaves, heldBalls(leaves, true));
        ASSERT_NO_FATAL_FAILURE(expectSound(model, object.name));
        most = std::max(most, leaves.size());
    }
    EXPECT_GT(most, 100u);
}

/// The last one of many is further out than all others, but between directions in which it is not.
TEST(StrictMerging, HoldsLeafBallsThatWereNotLookedAtWhileABallWasSought)
{
    Voxels voxels{Coord(474, 158, 0)}; // 500 from the origin
    for (const Coord& u : voxelsOfBox(CoordBBox(Coord(-2), Coord(2)))) {
        const bool even = u[0] % 2 == 0 && u[1] % 2 == 0 && u[2] % 2 == 0;
        if (!even) voxels.push_back(Coord::round(497 / u.asVec3d().length() * u.asVec3d()));
    }
    std::vector<ExactSphere> leaves;
    for (const Coord& v : voxels) leaves.push_back(voxelBall(v));
    sortVoxels(voxels);
    WatchedMerging model(voxels, leaves, heldBalls(leaves, true), false, {false, 0, 1, false, 4});
    model.leaveOutCosts();
    ASSERT_NO_FATAL_FAILURE(expectSound(model, "star"));
}

TEST(StrictMerging, CountsWhatLeavesHaveOutsideTheObject)
{
    Random random(1);
    for (int turn = 0; turn < 10; ++turn) {
        const Voxels voxels = shapes::noise(Coord(8, 9, 7), 0.4, random);
        const auto leaves = randomBalls(random.between(2, 30), random, 0, 8, 3);
        HeldByLeafBalls held =
            heldVoxels(powerCellPoints(leaves, sampled(voxels).level(0), nullptr), true);
        held.areInside = false;
        WatchedMerging model(voxels, leaves, held);
        ASSERT_NO_FATAL_FAILURE(expectSound(model, "with cells"));
        held = heldBalls(leaves, true);
        EXPECT_TRUE(held.areInside);
        held.areInside = false;
        WatchedMerging whole(voxels, leaves, held);
        ASSERT_NO_FATAL_FAILURE(expectSound(whole, "with balls"));
    }
}

TEST(StrictMerging, OfNodesWithoutCellsIsOneOfThem)
{
    const Voxels voxels = shapes::box(Coord(3));
    const ExactSphere a{{0, 0, 0}, 400}, b{{99, 0, 0}, 500};
    HeldByLeafBalls held = heldVoxels({{}, {}}, true);
    held.areInside = false;
    WatchedMerging model(voxels, {a, b}, held);
    const auto forest = mergeToRoots(model, 6, nullptr);
    EXPECT_TRUE(forest[2].ball == a || forest[2].ball == b);
}

TEST(StrictMerging, KeepsFlatObjectsInTheirPlane)
{
    Random random(2);
    for (int turn = 0; turn < 6; ++turn) {
        const Voxels voxels =
            translated(shapes::noise(Coord(10, 9, 1), 0.7, random), Coord(-3, 5, turn));
        const auto leaves = medialLeaves(voxels, 2);
        const auto held = turn % 2
            ? heldBalls(leaves, true)
            : heldVoxels(powerCellPoints(leaves, sampled(voxels).level(0), nullptr), true);
        WatchedMerging model(voxels, leaves, held, true);
        model.leaveOutCosts();
        for (const ForestNode& node : mergeToRoots(model, 6, nullptr)) {
            ASSERT_EQ(node.ball.center[2], 16 * turn);
        }
    }
}

} // namespace
