// SPDX-License-Identifier: Apache-2.0
#include "CoverRelocation.h"

#include "RandomMoves.h"
#include <openvdb_spheretree/base/Parallel.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace openvdb_spheretree::tight {

CoverChange CoverRelocation::removal(int32_t id) const
{
    constexpr std::size_t kSuccessors = 2;
    const CoverBall& ball = mCover[id];
    if (ball.empty()) return {};
    const std::vector<int32_t> around = mCover.grid().nearest(id, ball.ball, kChangedNeighbours);
    std::vector<int32_t> all(around);
    all.push_back(id);
    const CoverPart before = mFit.around(all);
    CoverPart best;
    std::size_t successors = 0;
    for (const int32_t successor : around) {
        if (mCover[successor].group != ball.group) continue;
        if (++successors > kSuccessors) break;
        CoverPart part = before;
        const bool held = mFit.takeOver(part, part.indexOf(id), part.indexOf(successor));
        if (held && (best.ids.empty() || part.change < best.change)) best = std::move(part);
    }
    if (best.ids.empty()) return {};
    mFit.refitNear(best, around, ball.ball);
    return mFit.changeOf(best);
}

CoverChange CoverRelocation::insertion(uint64_t number) const
{
    Dice dice(~number);
    CoverBall small = mCover[int32_t(dice.below(mCover.size()))];
    if (dice.uniform() < 0.5 || small.empty()) small = mFiner[dice.below(mFiner.size())];
    else small.ball = halved(small.ball, mFit.effort().flat, dice);
    const std::vector<int32_t> around =
        mCover.grid().nearest(kNewBall, small.ball, kChangedNeighbours);
    CoverPart part = mFit.around(around);
    const std::size_t last = mFit.insert(part, small);
    mFit.refitNear(part, around, small.ball);
    mFit.refit(part, last);
    return mFit.changeOf(part);
}

std::vector<CoverChange> CoverRelocation::bestInsertions(std::size_t tries)
{
    std::vector<CoverChange> changes(tries);
    const uint64_t first = mInsertions;
    mInsertions += tries;
    detail::parallelFor(tries, mInterrupter,
        [&](std::size_t t) { changes[t] = insertion(mFit.effort().seed + first + t); });
    std::stable_sort(changes.begin(), changes.end(),
        [](const CoverChange& a, const CoverChange& b) { return a.change < b.change; });
    return changes;
}

void CoverRelocation::apply(const CoverChange& change, int32_t slot)
{
    tight::apply(change, mCover, slot);
    mChange += change.change;
}

void CoverRelocation::relocate()
{
    if (mCover.size() < 4 || mFiner.empty()) return;
    fill();
    std::vector<CoverChange> removals(mCover.size());
    detail::parallelFor(
        removals.size(), mInterrupter, [&](std::size_t i) { removals[i] = removal(int32_t(i)); });
    std::vector<std::size_t> order(removals.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
        [&](std::size_t a, std::size_t b) { return removals[a].change < removals[b].change; });
    const std::vector<CoverChange> put = bestInsertions(mCover.size());
    std::vector<FineBox> taken;
    std::size_t next = 0;
    for (const std::size_t i : order) {
        while (next < put.size() && put[next].box.meetsAny(taken)) ++next;
        if (next == put.size() || !(removals[i].change + put[next].change < 0)) break;
        const FineBox &from = removals[i].box, &to = put[next].box;
        if (from.meetsAny(taken) || from.meets(to)) continue;
        apply(removals[i]);
        apply(put[next], int32_t(i));
        taken.insert(taken.end(), {from, to});
    }
    fill();
}

void CoverRelocation::fill()
{
    constexpr std::size_t kTries = 64;
    if (mFiner.empty()) return;
    for (std::size_t i = 0; i < mCover.size(); ++i) {
        if (!mCover[int32_t(i)].empty()) continue;
        const CoverChange best = bestInsertions(kTries).front();
        if (!best.improves()) return;
        apply(best, int32_t(i));
    }
}

} // namespace openvdb_spheretree::tight
