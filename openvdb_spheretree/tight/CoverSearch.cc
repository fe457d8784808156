// SPDX-License-Identifier: Apache-2.0
#include "CoverSearch.h"

#include "../detail/Hash.h"
#include "../detail/Parallel.h"
#include "BallGrid.h"
#include "DebtFit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace openvdb_spheretree {
namespace tight {

namespace {

using openvdb::Coord;

/// A part of the cover, and what has become of it in a trial.
struct Part {
    std::vector<int32_t> ids;    ///< ascending
    std::vector<FineBall> balls; ///< of these
    FineBox box;                 ///< no change may reach out of it
    FineBox changed;             ///< of the balls that are not what they were, before and after
    double change = 0;           ///< of the cover's cost, voxels

    std::size_t indexOf(int32_t id) const
    {
        return std::size_t(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
    }
};

bool meet(const FineBox& a, const FineBox& b)
{
    for (int axis = 0; axis < 3; ++axis) {
        if (a.hi[axis] < b.lo[axis] || b.hi[axis] < a.lo[axis]) return false;
    }
    return true;
}

/// Random numbers of one trial.
class Dice {
public:
    explicit Dice(uint64_t trial) : mState(detail::hash(trial)) {}
    double uniform() { return detail::unitInterval(mState = detail::hash(mState)); }
    std::size_t below(std::size_t n) { return std::min(n - 1, std::size_t(uniform() * double(n))); }

private:
    uint64_t mState;
};

constexpr std::size_t kNeighbours = 10;
constexpr std::size_t kRelocations = 6;
constexpr int32_t kNew = std::numeric_limits<int32_t>::max(); ///< a ball that has no slot yet

class Search {
public:
    Search(std::vector<FineBall> balls, const std::vector<FineBall>& leaves,
        const SampledObject& object, const CoverDebt& debt, const SearchEffort& effort,
        openvdb::util::NullInterrupter* interrupter)
        : mBalls(std::move(balls)), mLeaves(leaves), mObject(object), mDebt(debt), mEffort(effort),
          mInterrupter(interrupter)
    {
        for (std::size_t i = 0; i < mBalls.size(); ++i) mGrid.add(int32_t(i), mBalls[i]);
    }

    std::vector<FineBall> run()
    {
        sweeps();
        const std::size_t batch = std::max<std::size_t>(4, std::min<std::size_t>(64, size() / 8));
        const std::size_t trials = size() * std::size_t(mEffort.trialsPerBall);
        const std::size_t perRelocation = std::max<std::size_t>(1, trials / kRelocations);
        for (std::size_t done = 0; done < trials; done += batch) {
            if (done % perRelocation < batch) relocate();
            runBatch(done, batch);
        }
        sweeps();
        fill();
        return mBalls;
    }

private:
    std::size_t size() const { return mBalls.size(); }

    /// @return the part of the cover that @a centre and its neighbours are in; room for them to grow.
    Part partAround(const std::vector<int32_t>& ids) const
    {
        Part part;
        for (const int32_t id : ids) {
            const FineBall& ball = mBalls[id];
            part.box.expand(ball, 0.5 * ball.radius() + 4 * kFine);
        }
        part.ids = mGrid.meeting(part.box);
        for (const int32_t id : part.ids) part.balls.push_back(mBalls[id]);
        return part;
    }

    /// @return what ball @a i costs beside the others.
    double costOf(const Part& part, std::size_t i, DebtFit& fit) const
    {
        return costs(mObject, part, i, part.balls[i], fit, mEffort.fit.samples).first;
    }

    /// @return what one ball costs beside the others, and what another in its place would.
    static std::pair<double, double> costs(const SampledObject& object, const Part& part,
        std::size_t i, const FineBall& instead, DebtFit& fit, int samples)
    {
        fit.open(object, std::vector<FineBall>{instead}, {part.balls[i]}, samples);
        coverOthers(part, i, fit);
        return {fit.costOf({part.balls[i]}), fit.costOf({instead})};
    }

    static void coverOthers(const Part& part, std::size_t i, DebtFit& fit)
    {
        for (std::size_t k = 0; k < part.balls.size(); ++k) {
            const FineBall& other = part.balls[k];
            if (k == i || other.empty()) continue;
            FineBox box;
            box.expand(other);
            if (meet(box, fit.box())) fit.cover(other);
        }
    }

    void debtOf(const Part& part, std::size_t i, std::vector<Coord>& points) const
    {
        std::vector<FineBall> others;
        for (std::size_t k = 0; k < part.balls.size(); ++k) {
            if (k != i && !part.balls[k].empty() && gapBetween(part.balls[k], part.balls[i]) <= 0) {
                others.push_back(part.balls[k]);
            }
        }
        std::sort(others.begin(), others.end(), // the largest one may hold it all
            [](const FineBall& a, const FineBall& b) { return a.radiusSq > b.radiusSq; });
        mDebt.collect({part.balls[i]}, others, points);
    }

    /// Places a ball anew for what it alone owes, if that costs less.
    /// @return whether it changed.
    bool refit(Part& part, std::size_t i, DebtFit& fit) const
    {
        const FineBall old = part.balls[i];
        if (old.empty()) return false;
        std::vector<Coord> points;
        debtOf(part, i, points);
        if (points.empty()) {
            part.change -= costOf(part, i, fit);
            part.balls[i] = FineBall();
            return true;
        }
        fit.open(mObject, points, {old}, mEffort.fit.samples);
        coverOthers(part, i, fit);
        const double before = fit.costOf({old});
        const PaidDebt paid = fit.pay(mEffort.fit, mEffort.flat);
        const bool better =
            paid.cost < before || (paid.cost == before && paid.ball.radiusSq < old.radiusSq);
        if (!better || !inside(paid.ball, part.box)) return false;
        part.change += paid.cost - before;
        part.balls[i] = paid.ball;
        return true;
    }

    static bool inside(const FineBall& ball, const FineBox& box)
    {
        FineBox own;
        own.expand(ball);
        for (int a = 0; a < 3; ++a) {
            if (own.lo[a] < box.lo[a] || own.hi[a] > box.hi[a]) return false;
        }
        return true;
    }

    /// @return the changes of a part, when all are made. Another part whose changed balls do not
    /// meet these neither relies on them nor shares their costs.
    Part closed(const Part& part) const
    {
        Part changes;
        changes.change = part.change;
        for (std::size_t k = 0; k < part.ids.size(); ++k) {
            const FineBall before = part.ids[k] == kNew ? FineBall() : mBalls[part.ids[k]];
            if (part.balls[k] == before) continue;
            changes.ids.push_back(part.ids[k]);
            changes.balls.push_back(part.balls[k]);
            for (const FineBall& ball : {before, part.balls[k]}) {
                if (!ball.empty()) changes.changed.expand(ball);
            }
        }
        return changes;
    }

    // ---- Trials

    FineBall grown(const FineBall& ball, Dice& dice) const
    {
        const double r = ball.radius();
        const double larger = dice.uniform() < 0.5 ? r * (1 + 0.3 * dice.uniform())
                                                   : r + double(kFine) * (0.3 + 2 * dice.uniform());
        FineBall result = ball;
        result.radiusSq = int64_t(larger * larger);
        return result;
    }

    /// @return the ball, moved by @a step in some direction.
    FineBall shifted(const FineBall& ball, double step, Dice& dice) const
    {
        const double z = mEffort.flat ? 0 : 2 * dice.uniform() - 1;
        const double angle = 2 * M_PI * dice.uniform(), xy = std::sqrt(1 - z * z);
        FineBall result = ball;
        result.center[0] += std::lrint(step * xy * std::cos(angle));
        result.center[1] += std::lrint(step * xy * std::sin(angle));
        result.center[2] += std::lrint(step * z);
        return result;
    }

    /// Somewhere else, and as large as it has to be there.
    FineBall moved(const FineBall& ball, const std::vector<Coord>& points, Dice& dice) const
    {
        FineBall result = shifted(ball, std::max(1.0, ball.radius() * 0.4 * dice.uniform()), dice);
        result.radiusSq = 0;
        for (const Coord& p : points) {
            result.radiusSq = std::max(result.radiusSq, radiusSqToHold(result, voxelBall(p)));
        }
        return result;
    }

    /// Those of the balls that touch @a ball are placed anew.
    void refitNear(
        Part& part, const std::vector<int32_t>& ids, const FineBall& ball, DebtFit& fit) const
    {
        for (const int32_t id : ids) {
            if (gapBetween(mBalls[id], ball) <= double(kFine)) refit(part, part.indexOf(id), fit);
        }
    }

    Part runTrial(uint64_t number) const
    {
        thread_local DebtFit fit;
        Dice dice(number);
        Part part;
        const auto id = int32_t(dice.below(size()));
        const FineBall ball = mBalls[id];
        if (ball.empty()) return part;
        std::vector<int32_t> around = mGrid.nearest(id, ball, kNeighbours);
        std::vector<int32_t> all(around);
        all.push_back(id);
        part = partAround(all);
        const std::size_t i = part.indexOf(id);
        const bool grow = dice.uniform() < 0.5;
        std::vector<Coord> points;
        if (!grow) debtOf(part, i, points);
        const FineBall spoilt = grow ? grown(ball, dice) : moved(ball, points, dice);
        if (!inside(spoilt, part.box)) return Part();
        const auto [before, after] = costs(mObject, part, i, spoilt, fit, mEffort.fit.samples);
        part.change += after - before;
        part.balls[i] = spoilt;
        if (dice.uniform() < 0.5) {
            for (std::size_t k = around.size(); k > 1; --k)
                std::swap(around[k - 1], around[dice.below(k)]);
        }
        refitNear(part, around, spoilt, fit);
        refit(part, i, fit);
        return closed(part);
    }

    // ---- Balls that go elsewhere

    /// A neighbour takes over what ball @a id owes, the one for which that costs least.
    Part removal(int32_t id) const
    {
        thread_local DebtFit fit;
        constexpr std::size_t kHeirs = 3;
        const FineBall ball = mBalls[id];
        Part best;
        best.change = std::numeric_limits<double>::infinity();
        if (ball.empty()) return best;
        const std::vector<int32_t> around = mGrid.nearest(id, ball, kNeighbours);
        std::vector<int32_t> all(around);
        all.push_back(id);
        const Part before = partAround(all);
        for (std::size_t k = 0; k < std::min(kHeirs, around.size()); ++k) {
            Part part = before;
            if (takeOver(part, part.indexOf(id), part.indexOf(around[k]), fit)
                && part.change < best.change) {
                best = std::move(part);
            }
        }
        if (!best.ids.empty()) refitNear(best, around, ball, fit);
        return closed(best);
    }

    /// @return whether ball @a heir could be placed for what it and ball @a i owe; that one is gone.
    bool takeOver(Part& part, std::size_t i, std::size_t heir, DebtFit& fit) const
    {
        const std::vector<FineBall> olds{part.balls[i], part.balls[heir]};
        part.balls[i] = part.balls[heir] = FineBall();
        std::vector<FineBall> others;
        for (const FineBall& ball : part.balls) {
            if (!ball.empty()) others.push_back(ball);
        }
        std::vector<Coord> points;
        mDebt.collect(olds, others, points);
        if (points.empty()) return false;
        fit.open(mObject, points, olds, mEffort.fit.samples);
        coverOthers(part, i, fit);
        const double before = fit.costOf(olds);
        const PaidDebt paid = fit.pay(mEffort.fit, mEffort.flat);
        part.balls[heir] = paid.ball;
        part.change += paid.cost - before;
        return inside(paid.ball, part.box);
    }

    /// A leaf, or about half of a ball that is there: which half, and how much of it, is random.
    FineBall newcomer(Dice& dice) const
    {
        const FineBall& ball = mBalls[dice.below(size())];
        if (dice.uniform() < 0.5 || ball.empty()) return mLeaves[dice.below(mLeaves.size())];
        FineBall half = shifted(ball, ball.radius() * (0.3 + 0.3 * dice.uniform()), dice);
        const double radius = ball.radius() * (0.55 + 0.3 * dice.uniform());
        half.radiusSq = int64_t(radius * radius);
        return half;
    }

    /// A small ball is put in, and its neighbours shrink.
    Part insertion(uint64_t number) const
    {
        thread_local DebtFit fit;
        Dice dice(~number);
        const FineBall small = newcomer(dice);
        const std::vector<int32_t> around = mGrid.nearest(kNew, small, kNeighbours);
        Part part = partAround(around);
        part.ids.push_back(kNew);
        part.balls.push_back(small);
        part.change += costOf(part, part.ids.size() - 1, fit);
        refitNear(part, around, small, fit);
        refit(part, part.ids.size() - 1, fit);
        return closed(part);
    }

    std::vector<Part> insertions(std::size_t count)
    {
        std::vector<Part> parts(count);
        const uint64_t first = mInsertions;
        mInsertions += count;
        detail::parallelFor(
            count, mInterrupter, [&](std::size_t t) { parts[t] = insertion(first + t); });
        sortByChange(parts);
        return parts;
    }

    static void sortByChange(std::vector<Part>& parts)
    {
        std::stable_sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.change < b.change; });
    }

    static bool meetsAny(const FineBox& box, const std::vector<FineBox>& boxes)
    {
        return std::any_of(
            boxes.begin(), boxes.end(), [&](const FineBox& other) { return meet(box, other); });
    }

    /// Pairs the cheapest removals with the best insertions, as long as that pays.
    void relocate()
    {
        if (size() < 4) return;
        fill();
        std::vector<Part> removals(size());
        detail::parallelFor(
            size(), mInterrupter, [&](std::size_t i) { removals[i] = removal(int32_t(i)); });
        std::vector<std::size_t> order(size());
        std::iota(order.begin(), order.end(), 0);
        std::stable_sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return removals[a].change < removals[b].change; });
        const std::vector<Part> put = insertions(2 * size());
        std::vector<FineBox> taken;
        std::size_t next = 0;
        for (const std::size_t i : order) {
            while (next < put.size() && meetsAny(put[next].changed, taken)) ++next;
            if (next == put.size() || !(removals[i].change + put[next].change < 0)) break;
            if (meetsAny(removals[i].changed, taken)
                || meet(removals[i].changed, put[next].changed)) {
                continue;
            }
            apply(removals[i]);
            apply(put[next], int32_t(i));
            taken.push_back(removals[i].changed);
            taken.push_back(put[next].changed);
        }
        fill();
    }

    /// Puts leaves in where balls were dropped.
    void fill()
    {
        constexpr std::size_t kTries = 64;
        for (std::size_t i = 0; i < size(); ++i) {
            if (!mBalls[i].empty()) continue;
            const Part best = insertions(kTries).front();
            apply(best, int32_t(i));
            if (mBalls[i].empty()) put(int32_t(i), spareLeaf()); // it was of no use there
        }
    }

    /// A leaf that is no ball of the cover yet; there is one, or there would be no room for more.
    FineBall spareLeaf() const
    {
        for (const FineBall& leaf : mLeaves) {
            if (std::find(mBalls.begin(), mBalls.end(), leaf) == mBalls.end()) return leaf;
        }
        return mLeaves.front();
    }

    void put(int32_t id, const FineBall& ball)
    {
        if (!mBalls[id].empty()) mGrid.remove(id, mBalls[id]);
        mBalls[id] = ball;
        if (!ball.empty()) mGrid.add(id, ball);
    }

    /// @param changes  of a closed part
    /// @param slot     of an empty ball, for the new one if there is one
    void apply(const Part& changes, int32_t slot = -1)
    {
        for (std::size_t k = 0; k < changes.ids.size(); ++k) {
            put(changes.ids[k] == kNew ? slot : changes.ids[k], changes.balls[k]);
        }
    }

    /// Applies the parts that pay, as far as they do not meet.
    void applyBest(const std::vector<Part>& parts)
    {
        std::vector<FineBox> taken;
        for (const Part& part : parts) {
            if (!(part.change < 0) || part.ids.empty()) continue;
            if (meetsAny(part.changed, taken)) continue;
            apply(part);
            taken.push_back(part.changed);
        }
    }

    void runBatch(std::size_t first, std::size_t count)
    {
        std::vector<Part> parts(count);
        detail::parallelFor(
            count, mInterrupter, [&](std::size_t t) { parts[t] = runTrial(first + t); });
        applyBest(parts);
    }

    /// Places every ball anew, until nothing changes.
    void sweeps()
    {
        constexpr int kMost = 10;
        std::vector<int32_t> order(size());
        std::iota(order.begin(), order.end(), 0);
        for (int sweep = 0; sweep < kMost; ++sweep) {
            std::stable_sort(order.begin(), order.end(),
                [&](int32_t a, int32_t b) { return mBalls[a].radiusSq > mBalls[b].radiusSq; });
            bool any = false;
            for (std::vector<int32_t> left = order; !left.empty();) any |= sweepSome(left);
            if (!any) return;
        }
    }

    /// Places the first of the balls that do not touch each other anew, and takes them off the list.
    bool sweepSome(std::vector<int32_t>& left)
    {
        constexpr std::size_t kMost = 64;
        std::vector<FineBox> boxes;
        std::vector<int32_t> now, later;
        for (const int32_t id : left) {
            if (mBalls[id].empty()) continue;
            FineBox box;
            box.expand(mBalls[id], 0.5 * mBalls[id].radius() + 4 * kFine);
            const bool free = now.size() < kMost && !meetsAny(box, boxes);
            (free ? now : later).push_back(id);
            if (now.size() < kMost) boxes.push_back(box); // who waits keeps its place
        }
        std::vector<Part> parts(now.size());
        detail::parallelFor(now.size(), mInterrupter, [&](std::size_t k) {
            thread_local DebtFit fit;
            Part part = partAround({now[k]});
            refit(part, part.indexOf(now[k]), fit);
            parts[k] = closed(part);
        });
        bool any = false;
        for (const Part& part : parts) {
            any = any || !part.ids.empty();
            apply(part);
        }
        left.swap(later);
        return any;
    }

    std::vector<FineBall> mBalls; ///< empty where one was dropped
    const std::vector<FineBall>& mLeaves;
    uint64_t mInsertions = 0; ///< tried so far
    const SampledObject& mObject;
    const CoverDebt& mDebt;
    SearchEffort mEffort;
    openvdb::util::NullInterrupter* mInterrupter;
    BallGrid mGrid;
};

} // namespace

std::vector<FineBall> improveCover(std::vector<FineBall> balls, const std::vector<FineBall>& leaves,
    const SampledObject& object, const CoverDebt& debt, const SearchEffort& effort,
    openvdb::util::NullInterrupter* interrupter)
{
    return Search(std::move(balls), leaves, object, debt, effort, interrupter).run();
}

} // namespace tight
} // namespace openvdb_spheretree
