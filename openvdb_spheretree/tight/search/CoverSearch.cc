// SPDX-License-Identifier: Apache-2.0
#include "CoverSearch.h"

#include "CoverRelocation.h"
#include "CoverTrial.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>

#include <algorithm>
#include <deque>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// Takes the first balls off the list whose surroundings do not meet. Empty ones go, too. Only the
/// first few are looked at, as a list may be long.
std::vector<int32_t> takeApart(std::deque<int32_t>& ids, const BallCover& cover)
{
    constexpr std::size_t kMost = 64, kSeen = 4 * kMost;
    std::vector<FineBox> boxes;
    std::vector<int32_t> taken, waiting;
    while (!ids.empty() && taken.size() < kMost && boxes.size() < kSeen) {
        const int32_t id = ids.front();
        ids.pop_front();
        const ExactSphere& ball = cover[id].ball;
        if (ball.empty()) continue;
        const FineBox box(ball, 0.5 * ball.radius() + 4 * kFine);
        (box.meetsAny(boxes) ? waiting : taken).push_back(id);
        boxes.push_back(box); // those that wait keep their turn
    }
    ids.insert(ids.begin(), waiting.begin(), waiting.end());
    return taken;
}

/// The loops of a search. About how many turns they have is known before, so it can tell how far it
/// is.
class SearchLoops {
public:
    SearchLoops(
        std::size_t balls, const SearchEffort& effort, openvdb::util::NullInterrupter* interrupter)
        : mTurns(balls * usualTurns(effort)), mInterrupter(interrupter)
    {}

    /// Calls body(i) for i in [0, count), in parallel.
    template <typename Body>
    void run(std::size_t count, const Body& body)
    {
        constexpr std::size_t kAll = 100;
        detail::checkInterrupt(mInterrupter, int(std::min(kAll, kAll * mDone / mTurns)));
        const detail::Stage loop("", mInterrupter, nullptr);
        detail::parallelFor(count, mInterrupter, body);
        mDone += count;
    }

private:
    /// @return how often a ball is placed anew, in all sweeps, or tried.
    static std::size_t usualTurns(const SearchEffort& effort)
    {
        const std::size_t placings = effort.sweeps > kFewSweeps ? 3 : 2;
        const auto trials = std::size_t(effort.trialsPerBall);
        return trials == 0 ? placings : 2 * placings + trials;
    }

    const std::size_t mTurns;
    std::size_t mDone = 0;
    openvdb::util::NullInterrupter* mInterrupter;
};

/// Places every ball anew, the largest first, in sweeps until nothing changes. A ball that no
/// change came near since it was placed stays.
/// @param change  the change of the cost is added to it
void placeAll(BallCover& cover, const PartFit& fit, double& change, SearchLoops& loops)
{
    std::vector<char> isStale(cover.size(), 1);
    for (int sweep = 0; sweep < fit.effort().sweeps; ++sweep) {
        std::deque<int32_t> left;
        for (int32_t id = 0; id < int32_t(cover.size()); ++id) {
            if (isStale[id]) left.push_back(id);
        }
        if (left.empty()) return;
        std::stable_sort(left.begin(), left.end(),
            [&](int32_t a, int32_t b) { return cover[a].ball.radiusSq > cover[b].ball.radiusSq; });
        while (!left.empty()) {
            const std::vector<int32_t> ids = takeApart(left, cover);
            std::vector<CoverChange> changes(ids.size());
            std::vector<std::vector<int32_t>> near(ids.size()); // that a change comes near
            loops.run(ids.size(), [&](std::size_t k) {
                CoverPart part = fit.around({ids[k]});
                fit.refit(part, part.indexOf(ids[k]));
                changes[k] = fit.changeOf(part);
                if (!changes[k].ids.empty()) near[k] = part.meeting(changes[k].box, ids[k]);
            });
            for (const int32_t id : ids) isStale[id] = 0;
            for (std::size_t k = 0; k < ids.size(); ++k) {
                apply(changes[k], cover);
                change += changes[k].change;
                for (const int32_t id : near[k]) isStale[id] = 1;
            }
        }
    }
}

} // namespace

SearchedCover improveCover(std::vector<CoverBall> balls, const std::vector<CoverBall>& finer,
    const SampledObject& object, const CoverGoal& goal, const SearchEffort& effort,
    openvdb::util::NullInterrupter* interrupter)
{
    BallCover cover(std::move(balls));
    const PartFit fit(cover, object, goal, effort);
    CoverRelocation relocation(cover, fit, finer, interrupter);
    const std::size_t size = cover.size();
    SearchLoops loops(size, effort, interrupter);
    double change = 0;
    placeAll(cover, fit, change, loops);
    const std::size_t batch = std::max<std::size_t>(4, std::min<std::size_t>(64, size / 8));
    const std::size_t trials = size * std::size_t(effort.trialsPerBall);
    const std::size_t perRelocation = std::max<std::size_t>(1, trials / effort.relocations);
    for (std::size_t done = 0; done < trials; done += batch) {
        if (done % perRelocation < batch) {
            const detail::Stage relocating("", interrupter, nullptr);
            relocation.relocate();
        }
        std::vector<CoverChange> changes(batch);
        loops.run(batch,
            [&](std::size_t t) { changes[t] = tryChange(cover, fit, effort.seed + done + t); });
        std::vector<FineBox> taken;
        for (const CoverChange& some : changes) {
            if (!some.improves() || some.box.meetsAny(taken)) continue;
            apply(some, cover);
            change += some.change;
            taken.push_back(some.box);
        }
    }
    if (trials > 0) placeAll(cover, fit, change, loops);
    const detail::Stage filling("", interrupter, nullptr);
    relocation.fill();
    return {cover.balls(), change + relocation.change()};
}

} // namespace openvdb_spheretree::tight
