// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/merge/SlackMerging.h>

#include "support/ChosenObjects.h"
#include "support/FineBalls.h"

#include <map>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

constexpr FitEffort kEffort{true, 6, 1, false, 40};

Voxels unionOf(const Voxels& a, const Voxels& b)
{
    Voxels both = a;
    both.insert(both.end(), b.begin(), b.end());
    sortVoxels(both);
    return both;
}

Voxels heldOf(const Voxels& voxels, const ExactSphere& ball)
{
    Voxels held;
    for (const Coord& v : voxels) {
        if (holds(ball, v)) held.push_back(v);
    }
    return held;
}

/// Merges, and keeps the regions of living nodes voxel by voxel.
class WatchedMerging : public MergeModel {
public:
    WatchedMerging(const Voxels& voxels, const std::vector<ExactSphere>& leaves, bool flat)
        : mVoxels(voxels), mObject(sampled(voxels)),
          mModel(mObject, ungrouped(leaves), regionsOf(leaves, mObject.level(0), nullptr), kEffort,
              flat, nullptr, true),
          mLeafCount(int32_t(leaves.size())), mFlat(flat)
    {
        for (const ExactSphere& leaf : leaves) {
            mLiving[int32_t(mLiving.size())] = {leaf, heldOf(voxels, leaf)};
        }
    }
    std::vector<ExactSphere> leafBalls() const override { return mModel.leafBalls(); }
    MergeCandidate evaluate(int32_t a, int32_t b) const override { return mModel.evaluate(a, b); }
    bool dependsOnOthers() const override { return mModel.dependsOnOthers(); }
    void merge(const std::vector<MergeCandidate>& merges, int32_t node) override
    {
        for (const MergeCandidate& c : merges) ASSERT_NO_FATAL_FAILURE(expectFitted(c));
        for (const MergeCandidate& c : merges) ASSERT_NO_FATAL_FAILURE(expectCost(c.a, c.b));
        const int32_t some = anyLiving(), other = anyLiving(); // dearer ones, too
        if (some != other) {
            ASSERT_NO_FATAL_FAILURE(expectFitted(mModel.evaluate(some, other)));
            ASSERT_NO_FATAL_FAILURE(expectCost(some, other));
        }
        mModel.merge(merges, node);
        for (std::size_t i = 0; i < merges.size(); ++i) {
            const MergeCandidate& c = merges[i];
            const Voxels both = unionOf(mLiving.at(c.a).region, mLiving.at(c.b).region);
            mLiving.erase(c.a);
            mLiving.erase(c.b);
            mDropped += c.ball.empty();
            if (!c.ball.empty()) mLiving[node + int32_t(i)] = {c.ball, heldOf(both, c.ball)};
        }
        Voxels covered;
        for (const auto& [id, living] : mLiving) {
            covered.insert(covered.end(), living.region.begin(), living.region.end());
        }
        sortVoxels(covered);
        ASSERT_EQ(covered, mVoxels);
        mMostAtOnce = std::max(mMostAtOnce, merges.size());
    }
    int dropped() const { return mDropped; }
    std::size_t mostAtOnce() const { return mMostAtOnce; }

private:
    struct Living {
        ExactSphere ball;
        Voxels region;
    };
    int32_t anyLiving()
    {
        return std::next(mLiving.begin(), mRandom.between(0, int(mLiving.size()) - 1))->first;
    }
    /// What only these two have.
    Voxels uncoveredWithout(int32_t a, int32_t b) const
    {
        std::map<Coord, int> others;
        for (const auto& [id, living] : mLiving) {
            if (id == a || id == b) continue;
            for (const Coord& v : living.region) ++others[v];
        }
        Voxels uncovered;
        for (const Coord& v : unionOf(mLiving.at(a).region, mLiving.at(b).region)) {
            if (!others.count(v)) uncovered.push_back(v);
        }
        return uncovered;
    }
    /// The ball holds what is uncovered, and is no larger than that around its center.
    void expectFitted(const MergeCandidate& c) const
    {
        const Voxels uncovered = uncoveredWithout(c.a, c.b);
        ASSERT_EQ(c.ball.radiusSq, neededRadiusSq(c.ball, uncovered))
            << uncovered.size() << " voxels";
        if (mFlat && !c.ball.empty()) {
            ASSERT_EQ(c.ball.center[2], 16 * mVoxels[0][2]);
        }
    }
    /// What the merge adds to the excess of all balls together.
    void expectCost(int32_t a, int32_t b) const
    {
        const MergeCandidate c = mModel.evaluate(a, b);
        if (c.ball.empty()) return;
        std::vector<ExactSphere> before, after{c.ball};
        for (const auto& [id, living] : mLiving) {
            if (id < mLeafCount) continue; // which have none
            before.push_back(living.ball);
            if (id != a && id != b) after.push_back(living.ball);
        }
        ASSERT_EQ(c.cost, double(excess(after, mVoxels) - excess(before, mVoxels)));
    }

    Voxels mVoxels;
    SampledObject mObject;
    SlackMerging mModel;
    int32_t mLeafCount;
    bool mFlat;
    std::map<int32_t, Living> mLiving;
    Random mRandom{1};
    int mDropped = 0;
    std::size_t mMostAtOnce = 0;
};

std::vector<ExactSphere> medialLeaves(const Voxels& voxels, int dim)
{
    std::vector<ExactSphere> leaves;
    for (const auto& ball : CoreStages(*maskOf(voxels), dim).balls) {
        leaves.push_back(fineBall(ball));
    }
    return leaves;
}

/// Balls small enough for costs to be counted on every voxel.
TEST(SlackMerging, KeepsTheObjectCoveredAtTheCostItSays)
{
    const auto objects = chosenObjects(400, 455, 7, [](uint32_t, const RandomObject& object) {
        const auto size = boxOf(object.voxels).extents().asVec3i();
        return size.lengthSqr() <= 15 * 15 && object.voxels.size() <= 250;
    });
    int dropped = 0;
    for (const RandomObject& object : objects) {
        WatchedMerging model(object.voxels, medialLeaves(object.voxels, 3), false);
        SCOPED_TRACE(object.name);
        mergeToRoots(model, 6, nullptr);
        if (testing::Test::HasFatalFailure()) return;
        dropped += model.dropped();
    }
    EXPECT_GT(dropped, 0);
}

TEST(SlackMerging, KeepsFlatObjectsCoveredByBallsOfTheirPlane)
{
    Random random(1);
    for (int turn = 0; turn < 6; ++turn) {
        const Voxels voxels =
            translated(shapes::noise(Coord(10, 9, 1), 0.7, random), Coord(-3, 5, turn));
        WatchedMerging model(voxels, medialLeaves(voxels, 2), true);
        mergeToRoots(model, 6, nullptr);
        if (testing::Test::HasFatalFailure()) return;
    }
}

/// Two merges a round.
TEST(SlackMerging, KeepsTheObjectCoveredBySeveralMergesAtOnce)
{
    Random random(2);
    const Voxels voxels = shapes::noise(Coord(14, 13, 12), 0.08, random);
    const auto leaves = medialLeaves(voxels, 3);
    ASSERT_GT(leaves.size(), 128u);
    WatchedMerging model(voxels, leaves, false);
    mergeToRoots(model, 6, nullptr);
    EXPECT_EQ(model.mostAtOnce(), leaves.size() / 64);
}

} // namespace
