// SPDX-License-Identifier: Apache-2.0
#include "CoverTrial.h"

#include "RandomMoves.h"
#include <openvdb_spheretree/tight/fit/CoveringFit.h>

#include <openvdb/math/Math.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace openvdb_spheretree::tight {

namespace {

/// @return by how much the cost of a ball may rise where it is disturbed: by half of what it was,
/// and half a layer of voxels around it. Its neighbours seldom make up for more: a third of all
/// trials end here, and what a search gains is 3 to 10 % less.
double mostRegained(double cost, const ExactSphere& ball, bool flat)
{
    const double radius = ball.radius() / double(kFine), pi = openvdb::math::pi<double>();
    const double around = flat ? 2 * pi * radius : 4 * pi * radius * radius; // voxels of one layer
    return 0.5 * (cost + around);
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
    ExactSphere disturbed;
    if (dice.uniform() < 0.5) {
        disturbed = grown(ball, dice);
    } else { // somewhere else, and as large as it must be there
        const double step = std::max(1.0, ball.radius() * 0.4 * dice.uniform());
        disturbed = shifted(ball, step, fit.effort().flat, dice);
        disturbed.radiusSq = radiusSqToHold(disturbed, fit.uncoveredWithout(part, i));
    }
    if (!part.box.contains(FineBox(disturbed))) return {};
    const double before = fit.replace(part, i, disturbed);
    if (part.change > mostRegained(before, ball, fit.effort().flat)) return {};
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
