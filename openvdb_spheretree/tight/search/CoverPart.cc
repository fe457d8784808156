// SPDX-License-Identifier: Apache-2.0
#include "CoverPart.h"

#include <openvdb_spheretree/base/Hash.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>

#include <algorithm>

namespace openvdb_spheretree::tight {

namespace {

using openvdb::Coord;

/// @return the other balls that may share a voxel with one of @a removed. The largest is first: it
/// is the likeliest to hold all that would be uncovered.
std::vector<CoverBall> othersOf(const CoverPart& part, const std::vector<std::size_t>& removed)
{
    std::vector<CoverBall> others;
    for (std::size_t k = 0; k < part.balls.size(); ++k) {
        const CoverBall& other = part.balls[k];
        if (other.empty() || std::count(removed.begin(), removed.end(), k)) continue;
        const bool touches = std::any_of(removed.begin(), removed.end(), [&](std::size_t i) {
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

std::vector<int32_t> CoverPart::meeting(const FineBox& some, int32_t id) const
{
    std::vector<int32_t> found;
    for (std::size_t k = 0; k < ids.size(); ++k) {
        if (ids[k] != id && FineBox(balls[k].ball).meets(some)) found.push_back(ids[k]);
    }
    return found;
}

CoverPart PartFit::around(const std::vector<int32_t>& ids) const
{
    CoverPart part;
    for (const int32_t id : ids) {
        const ExactSphere& ball = mCover[id].ball;
        part.box.expand(ball, 0.5 * ball.radius() + 4 * kFine);
    }
    part.ids = mCover.grid().meeting(part.box);
    for (const int32_t id : part.ids) {
        part.balls.push_back(mCover[id]);
        part.placedFor.push_back(mCover.placedFor(id));
    }
    return part;
}

std::vector<Coord> PartFit::uncoveredWithout(const CoverPart& part, std::size_t i) const
{
    std::vector<Coord> points;
    mGoal.collectUncovered({part.balls[i]}, othersOf(part, {i}), points);
    return points;
}

template <typename Targets>
CoveringFit& PartFit::fitFor(const CoverPart& part, std::size_t i, const Targets& targets,
    const std::vector<ExactSphere>& replaced) const
{
    thread_local CoveringFit fit;
    fit.open(mObject, targets, replaced, mEffort.fit.samples);
    for (std::size_t k = 0; k < part.balls.size(); ++k) {
        const CoverBall& other = part.balls[k];
        if (k == i || other.empty()) continue;
        if (FineBox(other.ball).meets(fit.box())) fit.cover(other.ball);
    }
    return fit;
}

double PartFit::costOf(const CoverPart& part, std::size_t i) const
{
    const std::vector<ExactSphere> ball{part.balls[i].ball};
    return fitFor(part, i, ball, {}).costOf(ball);
}

std::size_t PartFit::insert(CoverPart& part, const CoverBall& ball) const
{
    part.ids.push_back(kNewBall);
    part.balls.push_back(ball);
    part.placedFor.push_back(0);
    part.change += costOf(part, part.ids.size() - 1);
    return part.ids.size() - 1;
}

double PartFit::replace(CoverPart& part, std::size_t i, const ExactSphere& instead) const
{
    ExactSphere& ball = part.balls[i].ball;
    CoveringFit& fit = fitFor(part, i, std::vector<ExactSphere>{instead}, {ball});
    const double before = fit.costOf({ball});
    part.change += fit.costOf({instead}) - before;
    ball = instead;
    part.placedFor[i] = 0;
    return before;
}

void PartFit::refit(CoverPart& part, std::size_t i) const
{
    ExactSphere& ball = part.balls[i].ball;
    if (ball.empty()) return;
    const std::vector<Coord> points = uncoveredWithout(part, i);
    if (points.empty()) {
        part.change -= costOf(part, i);
        ball = ExactSphere();
        return;
    }
    const uint64_t hash = hashOf(points);
    if (part.placedFor[i] == hash) return;
    part.placedFor[i] = hash;
    CoveringFit& fit = fitFor(part, i, points, {ball});
    const double before = fit.costOf({ball});
    const FittedBall fitted = fit.best(mEffort.fit, mEffort.flat);
    const bool better =
        fitted.cost < before || (fitted.cost == before && fitted.ball.radiusSq < ball.radiusSq);
    if (!better || !part.box.contains(FineBox(fitted.ball))) return;
    part.change += fitted.cost - before;
    ball = fitted.ball;
}

void PartFit::refitNear(
    CoverPart& part, const std::vector<int32_t>& ids, const ExactSphere& ball) const
{
    for (const int32_t id : ids) {
        if (gapBetween(mCover[id].ball, ball) <= double(kFine)) refit(part, part.indexOf(id));
    }
}

bool PartFit::takeOver(CoverPart& part, std::size_t i, std::size_t successor) const
{
    std::vector<Coord> points;
    mGoal.collectUncovered(
        {part.balls[i], part.balls[successor]}, othersOf(part, {i, successor}), points);
    const std::vector<ExactSphere> replaced{part.balls[i].ball, part.balls[successor].ball};
    part.balls[i].ball = part.balls[successor].ball = ExactSphere();
    if (points.empty()) return false;
    CoveringFit& fit = fitFor(part, i, points, replaced);
    const double before = fit.costOf(replaced);
    const FittedBall fitted = fit.best(mEffort.fit, mEffort.flat);
    part.balls[successor].ball = fitted.ball;
    part.placedFor[successor] = hashOf(points);
    part.change += fitted.cost - before;
    return part.box.contains(FineBox(fitted.ball));
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
        const ExactSphere before = isNew ? ExactSphere() : mCover[part.ids[k]].ball;
        if (part.balls[k].ball == before) continue;
        change.ids.push_back(part.ids[k]);
        change.balls.push_back(part.balls[k]);
        for (const ExactSphere& ball : {before, part.balls[k].ball}) {
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
    for (const auto& [id, hash] : change.placedFor) cover.setPlacedFor(number(id), hash);
}

} // namespace openvdb_spheretree::tight
