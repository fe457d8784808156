// SPDX-License-Identifier: Apache-2.0
#include "CoverTrial.h"

#include "RandomMoves.h"
#include <openvdb_spheretree/tight/fit/CoveringFit.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace openvdb_spheretree::tight {

namespace {

/// @return a ball near the given one, as large as it must be to hold the points.
ExactSphere moved(
    const ExactSphere& ball, const std::vector<openvdb::Coord>& points, bool flat, Dice& dice)
{
    const double step = std::max(1.0, ball.radius() * 0.4 * dice.uniform());
    ExactSphere result = shifted(ball, step, flat, dice);
    result.radiusSq = 0;
    for (const openvdb::Coord& p : points) {
        result.radiusSq = std::max(result.radiusSq, radiusSqToHold(result, voxelBall(p)));
    }
    return result;
}

} // namespace

CoverChange tryChange(const BallCover& cover, const PartFit& fit, uint64_t number)
{
    Dice dice(number);
    const auto id = int32_t(dice.below(cover.size()));
    const ExactSphere& ball = cover[id].ball;
    if (ball.empty()) return {};
    std::vector<int32_t> around = cover.grid().nearest(id, ball, kChangedNeighbours);
    std::vector<int32_t> all(around);
    all.push_back(id);
    CoverPart part = fit.around(all);
    const std::size_t i = part.indexOf(id);
    const bool grow = dice.uniform() < 0.5;
    const ExactSphere disturbed = grow
        ? grown(ball, dice)
        : moved(ball, fit.uncoveredWithout(part, i), fit.effort().flat, dice);
    if (!part.box.contains(FineBox(disturbed))) return {};
    fit.replace(part, i, disturbed);
    if (dice.uniform() < 0.5) {
        for (std::size_t k = around.size(); k > 1; --k) {
            std::swap(around[k - 1], around[dice.below(k)]);
        }
    }
    fit.refitNear(part, around, disturbed);
    fit.refit(part, i);
    return fit.changeOf(part);
}

} // namespace openvdb_spheretree::tight
