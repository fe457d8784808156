// SPDX-License-Identifier: Apache-2.0
#include "MergeForest.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/tight/fit/BallGrid.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

using Pair = std::pair<int32_t, int32_t>;

/// The queue is rebuilt when the count has shrunk to this part: sooner where costs depend on other
/// balls.
constexpr double kRebuild = 0.7, kRebuildDependent = 0.85;
constexpr int32_t kShare = 64; // a round merges one pair for so many balls
constexpr double kLock = 1;    // balls may share a voxel where they touch, and gaps are rounded
constexpr double kTimeOfMerging = 0.6;
constexpr double kTouch = 8 * kFine; // pairs of balls this near to a merge are stale

class Forest {
public:
    Forest(MergeModel& model, int neighbours, openvdb::util::NullInterrupter* interrupter)
        : mModel(model), mNeighbours(std::size_t(neighbours)), mInterrupter(interrupter)
    {
        const std::vector<ExactSphere> leafBalls = model.leafBalls();
        mLeafBalls = mLive = int32_t(leafBalls.size());
        int32_t groups = 1;
        for (int32_t i = 0; i < mLive; ++i) groups = std::max(groups, model.groupOf(i) + 1);
        mGrids.resize(std::size_t(groups));
        for (int32_t i = 0; i < mLive; ++i) addNode(leafBalls[i], model.groupOf(i));
    }

    std::vector<ForestNode> run(int64_t count)
    {
        int32_t rebuildAt = mLive;
        while (mLive > count) {
            detail::checkInterrupt(mInterrupter, percentDone());
            const detail::Stage round("", mInterrupter, nullptr); // its loops are details
            if (mLive <= rebuildAt || mQueue.empty()) {
                rebuildQueue();
                if (mQueue.empty()) break; // each group is one ball
                rebuildAt =
                    int32_t(mLive * (mModel.dependsOnOthers() ? kRebuildDependent : kRebuild));
            }
            refreshTop();
            doMerges(takeMerges());
        }
        return std::move(mNodes);
    }

private:
    bool alive(int32_t node) const { return !mGone[node]; }
    int32_t perRound() const { return std::max(1, mLive / kShare); }

    /// The fewer balls are left, the longer a merge takes: time was measured to go as this.
    int percentDone() const
    {
        return int(100 * (1 - std::pow(double(mLive) / mLeafBalls, kTimeOfMerging)));
    }

    /// @return whether there are groups, and models that look at all balls, whatever their group.
    bool needsAllGroups() const { return mGrids.size() > 1 && mModel.dependsOnOthers(); }

    /// The node is in the cuts of mLive balls and less.
    void addNode(const ExactSphere& ball, int32_t group)
    {
        mGrids[group].add(int32_t(mNodes.size()), ball);
        if (needsAllGroups()) mAllGroups.add(int32_t(mNodes.size()), ball);
        mGroup.push_back(group);
        mNodes.push_back({ball, -1, 1, mLive});
        mGone.push_back(0);
        mTouched.push_back(mRound);
        mLocked.push_back(-1);
    }

    // ---- The queue: a heap, the cheapest first

    static bool later(const MergeCandidate& x, const MergeCandidate& y) { return y < x; }

    void push(const MergeCandidate& candidate)
    {
        mQueue.push_back(candidate);
        std::push_heap(mQueue.begin(), mQueue.end(), later);
    }

    /// Takes the cheapest pair of living nodes; false if there is none.
    bool pop(MergeCandidate& candidate)
    {
        while (!mQueue.empty()) {
            std::pop_heap(mQueue.begin(), mQueue.end(), later);
            candidate = mQueue.back();
            mQueue.pop_back();
            if (alive(candidate.a) && alive(candidate.b)) return true;
        }
        return false;
    }

    bool isStale(const MergeCandidate& c) const
    {
        return mModel.dependsOnOthers() && std::max(mTouched[c.a], mTouched[c.b]) > c.round;
    }

    std::vector<MergeCandidate> evaluateAll(const std::vector<Pair>& pairs)
    {
        std::vector<MergeCandidate> candidates(pairs.size());
        detail::parallelFor(pairs.size(), mInterrupter, [&](std::size_t i) {
            candidates[i] = mModel.evaluate(pairs[i].first, pairs[i].second);
            candidates[i].round = mRound;
        });
        return candidates;
    }

    /// @return the pairs of nodes with their nearest, unique and sorted.
    std::vector<Pair> pairsOf(const std::vector<int32_t>& nodes)
    {
        std::vector<std::vector<int32_t>> nearest(nodes.size());
        detail::parallelFor(nodes.size(), mInterrupter, [&](std::size_t i) {
            const BallGrid& grid = mGrids[mGroup[nodes[i]]];
            nearest[i] = grid.nearest(nodes[i], mNodes[nodes[i]].ball, mNeighbours);
        });
        std::vector<Pair> pairs;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            for (const int32_t other : nearest[i]) pairs.push_back(std::minmax(nodes[i], other));
        }
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        return pairs;
    }

    void rebuildQueue()
    {
        std::vector<int32_t> living;
        for (int32_t node = 0; node < int32_t(mNodes.size()); ++node) {
            if (alive(node)) living.push_back(node);
        }
        std::vector<MergeCandidate> fresh;
        for (const MergeCandidate& c : mQueue) {
            if (alive(c.a) && alive(c.b) && !isStale(c)) fresh.push_back(c);
        }
        const auto byPair = [](const MergeCandidate& x, const MergeCandidate& y) {
            return std::make_pair(x.a, x.b) < std::make_pair(y.a, y.b);
        };
        std::sort(fresh.begin(), fresh.end(), byPair);
        std::vector<Pair> unknown;
        mQueue.clear();
        for (const Pair& pair : pairsOf(living)) {
            MergeCandidate key;
            std::tie(key.a, key.b) = pair;
            const auto known = std::lower_bound(fresh.begin(), fresh.end(), key, byPair);
            const bool found = known != fresh.end() && known->a == key.a && known->b == key.b;
            if (found) mQueue.push_back(*known);
            else unknown.push_back(pair);
        }
        const auto evaluated = evaluateAll(unknown);
        mQueue.insert(mQueue.end(), evaluated.begin(), evaluated.end());
        std::make_heap(mQueue.begin(), mQueue.end(), later);
    }

    /// Evaluates stale pairs until none is left among the cheapest, as many as the round takes.
    void refreshTop()
    {
        if (!mModel.dependsOnOthers()) return;
        const auto count = std::size_t(perRound());
        const std::size_t batch = std::max<std::size_t>(8, 2 * count);
        for (bool staleAhead = true; staleAhead;) {
            std::vector<MergeCandidate> top;
            std::vector<Pair> stale;
            MergeCandidate c;
            while (top.size() + stale.size() < (stale.empty() ? count : batch) && pop(c)) {
                if (isStale(c)) stale.emplace_back(c.a, c.b);
                else top.push_back(c);
            }
            for (const MergeCandidate& candidate : top) push(candidate);
            for (const MergeCandidate& candidate : evaluateAll(stale)) push(candidate);
            staleAhead = !stale.empty();
        }
    }

    // ---- Merges

    /// Sets @a marks to this round at the living nodes near the two balls of a merge and the new
    /// one.
    void markAround(const MergeCandidate& c, double slack, std::vector<int32_t>& marks) const
    {
        const BallGrid& all = mGrids.size() > 1 ? mAllGroups : mGrids.front();
        for (const ExactSphere& ball : {mNodes[c.a].ball, mNodes[c.b].ball, c.ball}) {
            if (ball.empty()) continue;
            for (const int32_t node : all.near(ball, slack)) marks[node] = mRound;
        }
    }

    std::vector<MergeCandidate> takeMerges()
    {
        std::vector<MergeCandidate> taken, aside;
        MergeCandidate c;
        while (int32_t(taken.size()) < perRound() && int32_t(taken.size()) + 1 < mLive && pop(c)) {
            const bool locked = mLocked[c.a] == mRound || mLocked[c.b] == mRound;
            if (!taken.empty() && (locked || isStale(c))) {
                aside.push_back(c);
                if (isStale(c)) break; // what comes after it may not be the cheapest
                if (aside.size() > std::size_t(4 * perRound())) break;
                continue;
            }
            if (mModel.dependsOnOthers()) markAround(c, kLock, mLocked);
            else mLocked[c.a] = mLocked[c.b] = mRound;
            taken.push_back(c);
        }
        detail::parallelFor(
            taken.size(), mInterrupter, [&](std::size_t i) { mModel.complete(taken[i]); });
        for (const MergeCandidate& waiting : aside) push(waiting);
        return taken;
    }

    void retire(int32_t node, int32_t parent)
    {
        mNodes[node].parent = parent;
        mNodes[node].first = mLive;
        mGone[node] = 1;
        mGrids[mGroup[node]].remove(node, mNodes[node].ball);
        if (needsAllGroups()) mAllGroups.remove(node, mNodes[node].ball);
    }

    void doMerges(const std::vector<MergeCandidate>& taken)
    {
        std::vector<MergeCandidate> merges, dropped;
        std::vector<int32_t> born;
        const auto firstNode = int32_t(mNodes.size());
        for (const MergeCandidate& c : taken) {
            if (c.ball.empty()) {
                for (const int32_t node : {c.a, c.b}) {
                    retire(node, -1);
                    --mLive;
                }
                dropped.push_back(c);
                continue;
            }
            const auto node = int32_t(mNodes.size());
            retire(c.a, node);
            retire(c.b, node);
            --mLive;
            addNode(c.ball, mGroup[c.a]);
            born.push_back(node);
            merges.push_back(c);
        }
        if (!dropped.empty()) mModel.merge(dropped, -1);
        if (!merges.empty()) mModel.merge(merges, firstNode);
        ++mRound; // what is evaluated from here on knows of these merges
        if (mModel.dependsOnOthers()) {
            for (const MergeCandidate& c : taken) markAround(c, kTouch, mTouched);
        }
        for (const MergeCandidate& c : evaluateAll(pairsOf(born))) push(c);
    }

    MergeModel& mModel;
    std::size_t mNeighbours;
    openvdb::util::NullInterrupter* mInterrupter;
    std::vector<BallGrid> mGrids; ///< of the groups: living nodes
    BallGrid mAllGroups;          ///< of all together, where needsAllGroups()
    std::vector<ForestNode> mNodes;
    std::vector<int32_t> mGroup;
    std::vector<char> mGone;
    std::vector<int32_t> mTouched; ///< the last round that changed something near a node
    std::vector<int32_t> mLocked;  ///< the last round that took a merge near a node
    std::vector<MergeCandidate> mQueue;
    int32_t mLeafBalls = 0, mLive = 0, mRound = 0;
};

} // namespace

std::vector<ForestNode> mergeToCount(
    MergeModel& model, int neighbours, int64_t count, openvdb::util::NullInterrupter* interrupter)
{
    return Forest(model, neighbours, interrupter).run(std::max<int64_t>(1, count));
}

std::vector<ForestNode> mergeToRoots(
    MergeModel& model, int neighbours, openvdb::util::NullInterrupter* interrupter)
{
    return mergeToCount(model, neighbours, 1, interrupter);
}

} // namespace openvdb_spheretree::tight
