// SPDX-License-Identifier: Apache-2.0
#include "CoverSearch.h"

#include "CoverRelocation.h"
#include "CoverTrial.h"
#include <openvdb_spheretree/base/Parallel.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

constexpr std::size_t kRelocations = 6;

/// Takes balls off the list whose surroundings do not meet, the first ones.
std::vector<int32_t> takeApart(std::vector<int32_t>& ids, const BallCover& cover)
{
    constexpr std::size_t kMost = 64;
    std::vector<FineBox> boxes;
    std::vector<int32_t> taken, left;
    for (const int32_t id : ids) {
        const ExactSphere& ball = cover[id].ball;
        if (ball.empty()) continue;
        const FineBox box(ball, 0.5 * ball.radius() + 4 * kFine);
        const bool free = taken.size() < kMost && !box.meetsAny(boxes);
        (free ? taken : left).push_back(id);
        if (taken.size() < kMost) boxes.push_back(box); // those that wait keep their turn
    }
    ids.swap(left);
    return taken;
}

class Search {
public:
    Search(std::vector<CoverBall> balls, const std::vector<CoverBall>& finer,
        const SampledObject& object, const CoverGoal& goal, const SearchEffort& effort,
        openvdb::util::NullInterrupter* interrupter)
        : mCover(std::move(balls)), mFit(mCover, object, goal, effort),
          mRelocation(mCover, mFit, finer, interrupter), mInterrupter(interrupter)
    {}

    SearchedCover run()
    {
        sweeps();
        const std::size_t size = mCover.size();
        const std::size_t batch = std::max<std::size_t>(4, std::min<std::size_t>(64, size / 8));
        const std::size_t trials = size * std::size_t(mFit.effort().trialsPerBall);
        const std::size_t perRelocation = std::max<std::size_t>(1, trials / kRelocations);
        for (std::size_t done = 0; done < trials; done += batch) {
            if (done % perRelocation < batch) mRelocation.relocate();
            tryBatch(done, batch);
        }
        sweeps();
        mRelocation.fill();
        return {mCover.balls(), mChange + mRelocation.change()};
    }

private:
    /// Makes the changes that lower the cost, as far as they do not meet.
    void tryBatch(std::size_t first, std::size_t count)
    {
        std::vector<CoverChange> changes(count);
        detail::parallelFor(count, mInterrupter, [&](std::size_t t) {
            changes[t] = tryChange(mCover, mFit, mFit.effort().seed + first + t);
        });
        std::vector<FineBox> taken;
        for (const CoverChange& change : changes) {
            if (!change.improves() || change.box.meetsAny(taken)) continue;
            apply(change, mCover);
            mChange += change.change;
            taken.push_back(change.box);
        }
    }

    /// Places every ball anew, the largest first, until nothing changes.
    void sweeps()
    {
        constexpr int kMost = 10;
        std::vector<int32_t> order(mCover.size());
        std::iota(order.begin(), order.end(), 0);
        for (int sweep = 0; sweep < kMost; ++sweep) {
            std::stable_sort(order.begin(), order.end(), [&](int32_t a, int32_t b) {
                return mCover[a].ball.radiusSq > mCover[b].ball.radiusSq;
            });
            std::vector<int32_t> left(order);
            bool any = false;
            while (!left.empty()) {
                const std::vector<int32_t> ids = takeApart(left, mCover);
                std::vector<CoverChange> changes(ids.size());
                detail::parallelFor(ids.size(), mInterrupter, [&](std::size_t k) {
                    CoverPart part = mFit.around({ids[k]});
                    mFit.refit(part, part.indexOf(ids[k]));
                    changes[k] = mFit.changeOf(part);
                });
                for (const CoverChange& change : changes) {
                    any = any || !change.ids.empty();
                    apply(change, mCover);
                    mChange += change.change;
                }
            }
            if (!any) return;
        }
    }

    BallCover mCover;
    PartFit mFit;
    CoverRelocation mRelocation;
    double mChange = 0;
    openvdb::util::NullInterrupter* mInterrupter;
};

} // namespace

SearchedCover improveCover(std::vector<CoverBall> balls, const std::vector<CoverBall>& finer,
    const SampledObject& object, const CoverGoal& goal, const SearchEffort& effort,
    openvdb::util::NullInterrupter* interrupter)
{
    return Search(std::move(balls), finer, object, goal, effort, interrupter).run();
}

} // namespace openvdb_spheretree::tight
