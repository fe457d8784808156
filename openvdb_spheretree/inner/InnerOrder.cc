// SPDX-License-Identifier: Apache-2.0
#include "InnerOrder.h"

#include "UncoveredVoxels.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/ParallelSort.h>

#include <algorithm>
#include <numeric>

namespace openvdb_spheretree::detail {

namespace {

class GreedyOrder {
public:
    GreedyOrder(const LeafLayout& layout, const std::vector<MedialBall>& balls, int dim,
        openvdb::util::NullInterrupter* interrupter)
        : mBalls(balls), mUncovered(layout, dim), mInterrupter(interrupter)
    {}

    InnerOrder run(int64_t most)
    {
        countAll();
        while (taken() < most && mUncovered.left() > 0 && !mQueue.empty()) {
            if (isCurrent(mQueue.front())) take();
            else countNext();
        }
        return std::move(mOrder);
    }

private:
    /// What a ball would add, counted when so many balls were taken. It never adds more later.
    struct Candidate {
        int64_t gain;
        int32_t ball;
        uint32_t taken;
    };

    /// So many are counted at a time; 8 and 256 take as long.
    static constexpr std::size_t kBatch = 64;

    /// @return whether a comes after b. A total order: the greedy choice is unique.
    auto order() const
    {
        return [this](const Candidate& a, const Candidate& b) {
            if (a.gain != b.gain) return a.gain < b.gain;
            const int32_t x = mBalls[a.ball].radiusSq, y = mBalls[b.ball].radiusSq;
            return x != y ? x < y : a.ball > b.ball;
        };
    }

    int64_t taken() const { return int64_t(mOrder.ball.size()); }
    int64_t covered() const { return mOrder.covered.empty() ? 0 : mOrder.covered.back(); }

    /// At first a ball adds all its voxels: as many as any other ball of its radius.
    void countAll()
    {
        std::vector<int32_t> byRadius(mBalls.size());
        std::iota(byRadius.begin(), byRadius.end(), 0);
        parallelSort(byRadius.begin(), byRadius.end(), mInterrupter,
            [this](int32_t a, int32_t b) { return mBalls[a].radiusSq < mBalls[b].radiusSq; });
        std::vector<std::size_t> begins; // of those with one radius
        for (std::size_t i = 0; i < byRadius.size(); ++i) {
            const bool same =
                i > 0 && mBalls[byRadius[i]].radiusSq == mBalls[byRadius[i - 1]].radiusSq;
            if (!same) begins.push_back(i);
        }
        begins.push_back(byRadius.size());
        mQueue.resize(mBalls.size());
        parallelFor(begins.size() - 1, mInterrupter, [&](std::size_t group) {
            const int64_t gain = mUncovered.countIn(mBalls[byRadius[begins[group]]]);
            for (std::size_t i = begins[group]; i < begins[group + 1]; ++i) {
                mQueue[i] = {gain, byRadius[i], 0};
            }
        });
        std::make_heap(mQueue.begin(), mQueue.end(), order());
    }

    bool isCurrent(const Candidate& c) const
    {
        return c.taken == taken() || !mUncovered.mayHaveChanged(mBalls[c.ball], c.taken);
    }

    Candidate pop()
    {
        std::pop_heap(mQueue.begin(), mQueue.end(), order());
        const Candidate top = mQueue.back();
        mQueue.pop_back();
        return top;
    }

    /// The top of the queue is current: no other ball adds as much.
    void take()
    {
        const MedialBall& ball = mBalls[mOrder.ball.emplace_back(pop().ball)];
        const int64_t all = covered() + mUncovered.left();
        mUncovered.cover(ball, uint32_t(taken()));
        mOrder.covered.push_back(all - mUncovered.left());
    }

    /// Counts the top of the queue again, and with it what is next and not current.
    void countNext()
    {
        mBatch.clear();
        while (mBatch.size() < kBatch && !mQueue.empty() && !isCurrent(mQueue.front())) {
            mBatch.push_back(pop());
        }
        const double all = double(covered() + mUncovered.left());
        checkInterrupt(mInterrupter, int(100.0 * double(covered()) / all));
        parallelFor(mBatch.size(), nullptr, [&](std::size_t i) {
            mBatch[i].gain = mUncovered.countIn(mBalls[mBatch[i].ball]);
            mBatch[i].taken = uint32_t(taken());
        });
        for (const Candidate& candidate : mBatch) {
            if (candidate.gain == 0) continue; // and never more
            mQueue.push_back(candidate);
            std::push_heap(mQueue.begin(), mQueue.end(), order());
        }
    }

    const std::vector<MedialBall>& mBalls;
    UncoveredVoxels mUncovered;
    openvdb::util::NullInterrupter* mInterrupter;
    std::vector<Candidate> mQueue, mBatch; ///< a heap, and what is counted next
    InnerOrder mOrder;
};

} // namespace

InnerOrder innerOrder(const LeafLayout& layout, const std::vector<MedialBall>& balls, int dim,
    int64_t most, openvdb::util::NullInterrupter* interrupter)
{
    return GreedyOrder(layout, balls, dim, interrupter).run(most);
}

std::vector<MedialBall> ballsInOrder(
    const std::vector<MedialBall>& balls, const InnerOrder& order, const FlatAxis& flat)
{
    std::vector<MedialBall> result;
    result.reserve(order.ball.size());
    for (const int32_t i : order.ball) {
        result.push_back({flat.fromZ(balls[i].center), balls[i].radiusSq});
    }
    return result;
}

} // namespace openvdb_spheretree::detail
