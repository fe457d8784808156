// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/merge/MergeForest.h>

#include "support/FineBalls.h"

#include <openvdb/util/NullInterrupter.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// Balls whose merge is a ball around both; pairs of idle leaves need none. If costs depend on
/// others, then on the merged balls that meet a pair.
class ToyModel : public MergeModel {
public:
    ToyModel(int leaves, bool depends, double idle, Random& random) : mDepends(depends)
    {
        mBalls = randomBalls(leaves, random, -100, 100, 3);
        for (int i = 0; i < leaves; ++i) mIdle.push_back(i > 0 && random.chance(idle));
        mLeaves = mBalls;
        mEnded.resize(mBalls.size());
    }
    /// Leaves of @a count groups, by turns.
    void group(int count) { mGroups = count; }
    int32_t groupOf(int32_t leaf) const override { return leaf % mGroups; }
    std::vector<ExactSphere> leafBalls() const override { return mLeaves; }
    MergeCandidate evaluate(int32_t a, int32_t b) const override
    {
        EXPECT_LT(a, b);
        EXPECT_FALSE(mEnded[a] || mEnded[b]);
        if (mIdle[a] && mIdle[b]) return {-1e300, a, b, ExactSphere(), 0};
        ExactSphere ball = mBalls[a];
        const double reach = centerDistance(mBalls[a], mBalls[b]) + mBalls[b].radius() + 1;
        const double radius = std::max(reach, ball.radius() + 1);
        ball.radiusSq = int64_t(radius * radius) & ~kMark;
        return {radius + 40 * meeting(a, b), a, b, ball, 0};
    }
    /// Leaves a mark, that is asked for when the merge is done.
    void complete(MergeCandidate& c) const override { c.ball.radiusSq |= kMark; }
    void merge(const std::vector<MergeCandidate>& merges, int32_t node) override
    {
        ASSERT_FALSE(merges.empty());
        for (const MergeCandidate& c : merges) {
            ASSERT_EQ(c.cost, evaluate(c.a, c.b).cost) << "of another time";
        }
        if (mDepends) {
            ASSERT_NO_FATAL_FAILURE(expectApart(merges));
        }
        for (std::size_t i = 0; i < merges.size(); ++i) {
            for (const int32_t child : {merges[i].a, merges[i].b}) {
                ASSERT_FALSE(mEnded[child]);
                mEnded[child] = 1;
            }
            if (merges[i].ball.empty()) continue;
            ASSERT_TRUE(merges[i].ball.radiusSq & kMark) << "not completed";
            ASSERT_EQ(std::size_t(node) + i, mBalls.size());
            mBalls.push_back(merges[i].ball);
            mIdle.push_back(0);
            mEnded.push_back(0);
        }
        mMostAtOnce = std::max(mMostAtOnce, merges.size());
    }
    bool dependsOnOthers() const override { return mDepends; }
    std::size_t mostAtOnce() const { return mMostAtOnce; }

private:
    static constexpr int64_t kMark = 1; ///< of squared radii
    int meeting(int32_t a, int32_t b) const
    {
        int count = 0;
        for (std::size_t i = mLeaves.size(); mDepends && i < mBalls.size(); ++i) {
            if (mEnded[i] || int32_t(i) == a || int32_t(i) == b) continue;
            count += gapBetween(mBalls[i], mBalls[a]) <= 0 || gapBetween(mBalls[i], mBalls[b]) <= 0;
        }
        return count;
    }
    /// What one merge takes away meets nothing that another one takes away or puts there.
    void expectApart(const std::vector<MergeCandidate>& merges) const
    {
        for (std::size_t later = 1; later < merges.size(); ++later) {
            for (std::size_t i = 0; i < later; ++i) {
                const MergeCandidate& c = merges[i];
                for (const int32_t node : {merges[later].a, merges[later].b}) {
                    ASSERT_GT(gapBetween(mBalls[node], mBalls[c.a]), 0);
                    ASSERT_GT(gapBetween(mBalls[node], mBalls[c.b]), 0);
                    if (!c.ball.empty()) {
                        ASSERT_GT(gapBetween(mBalls[node], c.ball), 0);
                    }
                }
            }
        }
    }

    bool mDepends;
    int mGroups = 1;
    std::vector<ExactSphere> mBalls, mLeaves;
    std::vector<char> mIdle, mEnded;
    std::size_t mMostAtOnce = 0;
};

/// @param roots  there are in the end
void expectForest(const std::vector<ForestNode>& forest, int leaves, int roots = 1)
{
    std::vector<int> count(std::size_t(leaves) + 1, 0);
    std::vector<int> children(forest.size(), 0);
    for (std::size_t i = 0; i < forest.size(); ++i) {
        const ForestNode& node = forest[i];
        ASSERT_EQ(int(i) < leaves, node.last == leaves);
        ASSERT_LE(1, node.first);
        ASSERT_LE(node.first, node.last);
        for (int n = node.first; n <= node.last; ++n) ++count[std::size_t(n)];
        if (node.parent < 0) continue;
        ASSERT_LT(i, std::size_t(node.parent));
        ASSERT_EQ(forest[node.parent].last, node.first - 1);
        ++children[node.parent];
    }
    for (int n = roots; n <= leaves; ++n) ASSERT_EQ(count[std::size_t(n)], n);
    for (std::size_t i = 0; i < forest.size(); ++i) ASSERT_EQ(children[i], int(i) < leaves ? 0 : 2);
}

TEST(MergeForest, HasACutOfEveryNumberOfNodes)
{
    Random random(1);
    for (const int leaves : {1, 2, 3, 10, 127, 128, 450}) {
        for (const bool depends : {false, true}) {
            for (const double idle : {0.0, 0.3, 0.95}) {
                ToyModel model(leaves, depends, idle, random);
                ASSERT_NO_FATAL_FAILURE(expectForest(mergeToRoots(model, 6, nullptr), leaves))
                    << leaves << " leaves, idle " << idle;
                const bool many = leaves == 450;
                ASSERT_TRUE(
                    many ? model.mostAtOnce() > 1 : model.mostAtOnce() <= 1 || leaves > 127);
            }
        }
    }
}

/// Takes notice of the percentages of the outermost stage.
class Listener : public openvdb::util::NullInterrupter {
public:
    void start(const char*) override { ++mDepth; }
    void end() override { --mDepth; }
    bool wasInterrupted(int percent) override
    {
        if (percent >= 0 && mDepth == 0) mHeard.push_back(percent);
        return false;
    }
    const std::vector<int>& heard() const { return mHeard; }

private:
    std::atomic<int> mDepth{0}; ///< loops within a stage report from many threads
    std::vector<int> mHeard;
};

TEST(MergeForest, TellsHowFarItIsAndNoDetails)
{
    Random random(3);
    ToyModel model(450, true, 0.3, random);
    Listener listener;
    mergeToRoots(model, 6, &listener);
    const std::vector<int>& heard = listener.heard();
    ASSERT_GT(heard.size(), 50u);
    EXPECT_EQ(heard.front(), 0);
    EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
    EXPECT_GT(heard.back(), 90) << "two balls are left of 450";
    EXPECT_LT(heard.back(), 100);
    EXPECT_GT(heard[heard.size() / 2], 20);
}

/// Merges of other groups are near, and what is born stays in its group.
TEST(MergeForest, KeepsGroupsApart)
{
    Random random(4);
    for (const int leaves : {3, 50, 400}) {
        for (const bool depends : {false, true}) {
            ToyModel model(leaves, depends, 0, random);
            model.group(3);
            const auto forest = mergeToRoots(model, 6, nullptr);
            ASSERT_NO_FATAL_FAILURE(expectForest(forest, leaves, 3));
            std::vector<int32_t> group;
            std::vector<int> roots(3, 0);
            for (int i = 0; i < int(forest.size()); ++i) group.push_back(i < leaves ? i % 3 : -1);
            for (std::size_t i = 0; i < forest.size(); ++i) {
                const int32_t parent = forest[i].parent;
                if (parent < 0) {
                    ++roots[group[i]];
                    continue;
                }
                ASSERT_TRUE(group[parent] == -1 || group[parent] == group[i]);
                group[parent] = group[i];
            }
            ASSERT_EQ(roots, std::vector<int>(3, 1));
        }
    }
}

/// The forest of the same merges, when all pairs are looked at in every round.
std::vector<ForestNode> naiveForest(ToyModel& model)
{
    std::vector<ForestNode> forest;
    std::vector<int32_t> living;
    for (const ExactSphere& ball : model.leafBalls()) {
        living.push_back(int32_t(forest.size()));
        forest.push_back({ball, -1, 1, int32_t(model.leafBalls().size())});
    }
    while (living.size() > 1) {
        std::vector<MergeCandidate> pairs, taken;
        for (const int32_t a : living) {
            for (const int32_t b : living) {
                if (a < b) pairs.push_back(model.evaluate(a, b));
            }
        }
        std::sort(pairs.begin(), pairs.end());
        for (MergeCandidate& c : pairs) {
            const bool meets = std::any_of(taken.begin(), taken.end(), [&](const auto& t) {
                return t.a == c.a || t.a == c.b || t.b == c.a || t.b == c.b;
            });
            if (meets) continue;
            model.complete(c);
            taken.push_back(c);
            if (taken.size() == std::max<std::size_t>(1, living.size() / 64)) break;
        }
        model.merge(taken, int32_t(forest.size()));
        for (const MergeCandidate& c : taken) {
            const auto parent = int32_t(forest.size()), count = int32_t(living.size());
            for (const int32_t child : {c.a, c.b}) {
                forest[child].parent = parent;
                forest[child].first = count;
                living.erase(std::find(living.begin(), living.end(), child));
            }
            living.push_back(parent);
            forest.push_back({c.ball, -1, 1, count - 1});
        }
    }
    return forest;
}

/// Where all pairs are known, and none depends on others.
TEST(MergeForest, TakesTheCheapestPairsOfEachRound)
{
    for (const int leaves : {60, 150}) {
        Random random(2);
        ToyModel model(leaves, false, 0, random), same = model;
        const auto forest = mergeToRoots(model, leaves, nullptr), naive = naiveForest(same);
        ASSERT_EQ(forest.size(), naive.size());
        for (std::size_t i = 0; i < forest.size(); ++i) {
            ASSERT_TRUE(forest[i].ball == naive[i].ball) << i;
            ASSERT_EQ(forest[i].parent, naive[i].parent) << i;
            ASSERT_EQ(forest[i].first, naive[i].first) << i;
            ASSERT_EQ(forest[i].last, naive[i].last) << i;
        }
        EXPECT_EQ(model.mostAtOnce(), leaves == 60 ? 1u : 2u);
    }
}

} // namespace
