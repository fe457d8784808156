// SPDX-License-Identifier: Apache-2.0
#include "CoverPart.h"

#include <openvdb_spheretree/base/Hash.h>
#include <openvdb_spheretree/tight/fit/DebtFit.h>

#include <algorithm>

namespace openvdb_spheretree {
namespace tight {

namespace {

using openvdb::Coord;

/// The windows and lists of one thread.
DebtFit& scratchFit()
{
    thread_local DebtFit fit;
    return fit;
}

/// What the other balls of the part hold is nobody's cost.
void coverOthers(const CoverPart& part, std::size_t i, DebtFit& fit)
{
    for (std::size_t k = 0; k < part.balls.size(); ++k) {
        const CoverBall& other = part.balls[k];
        if (k == i || other.empty()) continue;
        FineBox box;
        box.expand(other.ball);
        if (meet(box, fit.box())) fit.cover(other.ball);
    }
}

/// @return the balls that share a voxel with one of @a lifted, less these, the largest first: it may
/// hold all that is owed.
std::vector<CoverBall> othersOf(const CoverPart& part, const std::vector<std::size_t>& lifted)
{
    std::vector<CoverBall> others;
    for (std::size_t k = 0; k < part.balls.size(); ++k) {
        const CoverBall& other = part.balls[k];
        if (other.empty() || std::count(lifted.begin(), lifted.end(), k)) continue;
        const bool touches = std::any_of(lifted.begin(), lifted.end(), [&](std::size_t i) {
            return gapBetween(other.ball, part.balls[i].ball) <= 1; // gaps are rounded
        });
        if (touches) others.push_back(other);
    }
    std::sort(others.begin(), others.end(),
        [](const CoverBall& a, const CoverBall& b) { return a.ball.radiusSq > b.ball.radiusSq; });
    return others;
}

uint64_t hashOf(const std::vector<Coord>& points)
{
    uint64_t hash = points.size();
    for (const Coord& p : points) {
        for (int a = 0; a < 3; ++a) hash = detail::hash(hash ^ uint64_t(uint32_t(p[a])));
    }
    return hash;
}

} // namespace

std::size_t CoverPart::indexOf(int32_t id) const
{
    return std::size_t(std::lower_bound(ids.begin(), ids.end(), id) - ids.begin());
}

bool meet(const FineBox& a, const FineBox& b)
{
    for (int axis = 0; axis < 3; ++axis) {
        if (a.hi[axis] < b.lo[axis] || b.hi[axis] < a.lo[axis]) return false;
    }
    return true;
}

bool meetsAny(const FineBox& box, const std::vector<FineBox>& boxes)
{
    return std::any_of(
        boxes.begin(), boxes.end(), [&](const FineBox& other) { return meet(box, other); });
}

CoverPart PartFit::around(const std::vector<int32_t>& ids) const
{
    CoverPart part;
    for (const int32_t id : ids) {
        const FineBall& ball = mCover[id].ball;
        part.box.expand(ball, 0.5 * ball.radius() + 4 * kFine);
    }
    part.ids = mCover.meeting(part.box);
    for (const int32_t id : part.ids) {
        part.balls.push_back(mCover[id]);
        part.placedFor.push_back(mCover.placedFor(id));
    }
    return part;
}

bool PartFit::inside(const FineBall& ball, const FineBox& box)
{
    FineBox own;
    own.expand(ball);
    for (int a = 0; a < 3; ++a) {
        if (own.lo[a] < box.lo[a] || own.hi[a] > box.hi[a]) return false;
    }
    return true;
}

std::vector<Coord> PartFit::debtOf(const CoverPart& part, std::size_t i) const
{
    std::vector<Coord> points;
    mDebt.collect({part.balls[i]}, othersOf(part, {i}), points);
    return points;
}

double PartFit::costOf(const CoverPart& part, std::size_t i) const
{
    DebtFit& fit = scratchFit();
    const FineBall& ball = part.balls[i].ball;
    fit.open(mObject, std::vector<FineBall>{ball}, {}, mEffort.fit.samples);
    coverOthers(part, i, fit);
    return fit.costOf({ball});
}

std::size_t PartFit::insert(CoverPart& part, const CoverBall& ball) const
{
    part.ids.push_back(kNewBall);
    part.balls.push_back(ball);
    part.placedFor.push_back(0);
    part.change += costOf(part, part.ids.size() - 1);
    return part.ids.size() - 1;
}

void PartFit::replace(CoverPart& part, std::size_t i, const FineBall& instead) const
{
    DebtFit& fit = scratchFit();
    FineBall& ball = part.balls[i].ball;
    fit.open(mObject, std::vector<FineBall>{instead}, {ball}, mEffort.fit.samples);
    coverOthers(part, i, fit);
    part.change += fit.costOf({instead}) - fit.costOf({ball});
    ball = instead;
    part.placedFor[i] = 0;
}

void PartFit::refit(CoverPart& part, std::size_t i) const
{
    FineBall& ball = part.balls[i].ball;
    if (ball.empty()) return;
    const std::vector<Coord> points = debtOf(part, i);
    if (points.empty()) {
        part.change -= costOf(part, i);
        ball = FineBall();
        return;
    }
    const uint64_t debt = hashOf(points);
    if (part.placedFor[i] == debt) return;
    part.placedFor[i] = debt;
    DebtFit& fit = scratchFit();
    fit.open(mObject, points, {ball}, mEffort.fit.samples);
    coverOthers(part, i, fit);
    const double before = fit.costOf({ball});
    const PaidDebt paid = fit.pay(mEffort.fit, mEffort.flat);
    const bool better =
        paid.cost < before || (paid.cost == before && paid.ball.radiusSq < ball.radiusSq);
    if (!better || !inside(paid.ball, part.box)) return;
    part.change += paid.cost - before;
    ball = paid.ball;
}

void PartFit::refitNear(
    CoverPart& part, const std::vector<int32_t>& ids, const FineBall& ball) const
{
    for (const int32_t id : ids) {
        if (gapBetween(mCover[id].ball, ball) <= double(kFine)) refit(part, part.indexOf(id));
    }
}

bool PartFit::takeOver(CoverPart& part, std::size_t i, std::size_t heir) const
{
    std::vector<Coord> points;
    mDebt.collect({part.balls[i], part.balls[heir]}, othersOf(part, {i, heir}), points);
    const std::vector<FineBall> olds{part.balls[i].ball, part.balls[heir].ball};
    part.balls[i].ball = part.balls[heir].ball = FineBall();
    if (points.empty()) return false;
    DebtFit& fit = scratchFit();
    fit.open(mObject, points, olds, mEffort.fit.samples);
    coverOthers(part, i, fit);
    const double before = fit.costOf(olds);
    const PaidDebt paid = fit.pay(mEffort.fit, mEffort.flat);
    part.balls[heir].ball = paid.ball;
    part.placedFor[heir] = hashOf(points);
    part.change += paid.cost - before;
    return inside(paid.ball, part.box);
}

CoverChange PartFit::changeOf(const CoverPart& part) const
{
    CoverChange change;
    change.change = part.change;
    for (std::size_t k = 0; k < part.ids.size(); ++k) {
        const bool isNew = part.ids[k] == kNewBall;
        if (isNew || part.placedFor[k] != mCover.placedFor(part.ids[k])) {
            change.placedFor.emplace_back(part.ids[k], part.placedFor[k]);
        }
        const FineBall before = isNew ? FineBall() : mCover[part.ids[k]].ball;
        if (part.balls[k].ball == before) continue;
        change.ids.push_back(part.ids[k]);
        change.balls.push_back(part.balls[k]);
        for (const FineBall& ball : {before, part.balls[k].ball}) {
            if (!ball.empty()) change.box.expand(ball);
        }
    }
    return change;
}

void apply(const CoverChange& change, BallCover& cover, int32_t slot)
{
    const auto number = [&](int32_t id) { return id == kNewBall ? slot : id; };
    for (std::size_t k = 0; k < change.ids.size(); ++k) {
        cover.put(number(change.ids[k]), change.balls[k]);
    }
    for (const auto& [id, debt] : change.placedFor) cover.setPlacedFor(number(id), debt);
}

} // namespace tight
} // namespace openvdb_spheretree
