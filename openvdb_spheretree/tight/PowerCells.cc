// SPDX-License-Identifier: Apache-2.0
#include "PowerCells.h"

#include "../detail/Parallel.h"
#include "BallMask.h"
#include "ExtremePoints.h"
#include "LeafDescent.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace openvdb_spheretree {
namespace tight {

namespace {

/// A part of a cell.
struct CellLeaf {
    int32_t ball;
    LeafMask mask;
};

/// The power of a ball at every voxel of a leaf is a sum of three terms, one for each axis.
struct PowerTerms {
    std::array<int64_t, 8> axis[3];

    PowerTerms(const FineBall& ball, const openvdb::Coord& origin)
    {
        for (int a = 0; a < 3; ++a) {
            for (int i = 0; i < 8; ++i) {
                const int64_t d = kFine * (int64_t(origin[a]) + i) - ball.center[a];
                axis[a][i] = (a == 0 ? ball.radiusSq : 0) - d * d;
            }
        }
    }
};

/// Twice the middle of a box: an integer.
struct Middle {
    int64_t twice[3];

    explicit Middle(const openvdb::CoordBBox& box)
    {
        for (int a = 0; a < 3; ++a) twice[a] = kFine * (int64_t(box.min()[a]) + box.max()[a]);
    }
    double powerOf(const FineBall& ball) const
    {
        double power = double(ball.radiusSq);
        for (int a = 0; a < 3; ++a) {
            const double d = 0.5 * double(twice[a]) - double(ball.center[a]);
            power -= d * d;
        }
        return power;
    }
};

/// @return whether the power of @a ball is larger than that of @a other in all of the box: the
/// difference is linear, so it is smallest at an end of each axis.
bool dominates(const FineBall& ball, const FineBall& other, const openvdb::CoordBBox& box)
{
    int64_t least = ball.radiusSq - other.radiusSq;
    for (int a = 0; a < 3; ++a) {
        const auto gain = [&](int64_t at) {
            const int64_t mine = kFine * at - ball.center[a], theirs = kFine * at - other.center[a];
            return theirs * theirs - mine * mine;
        };
        least += std::min(gain(box.min()[a]), gain(box.max()[a]));
    }
    return least > 0;
}

/// Leaves out the balls that are weaker everywhere than the one that is strongest in the middle.
BallFilter ballsWithPower(const std::vector<FineBall>& balls)
{
    return [&](const openvdb::CoordBBox& box, const std::vector<int32_t>& from,
               std::vector<int32_t>& to) {
        const Middle middle(box);
        int32_t strongest = -1;
        for (const int32_t ball : from) {
            if (strongest < 0 || middle.powerOf(balls[ball]) > middle.powerOf(balls[strongest])) {
                strongest = ball;
            }
        }
        for (const int32_t ball : from) {
            if (!BoxReach(balls[ball], box).meets(balls[ball])) continue;
            if (!dominates(balls[strongest], balls[ball], box)) to.push_back(ball);
        }
    };
}

/// @param among  the balls that may have a part, ascending
/// @return the parts of cells in a leaf, by ball.
std::vector<CellLeaf> partsOf(std::size_t leaf, const std::vector<FineBall>& balls,
    const SampleLevel& object, const std::vector<int32_t>& among)
{
    std::array<int64_t, kLeafVoxels> best;
    std::array<int32_t, kLeafVoxels> label; // place in `among`
    best.fill(-1); // a ball without a power of 0 or more does not hold the voxel
    label.fill(0);
    for (std::size_t k = 0; k < among.size(); ++k) {
        const FineBall& ball = balls[among[k]];
        const PowerTerms terms(ball, object.origin(leaf));
        for (int i = 0; i < kLeafVoxels; ++i) {
            const int64_t power =
                terms.axis[0][i >> 6] + terms.axis[1][i >> 3 & 7] + terms.axis[2][i & 7];
            const bool wins = power > best[i]
                || (power == best[i] && power >= 0
                    && ball.radiusSq > balls[among[label[i]]].radiusSq);
            best[i] = wins ? power : best[i];
            label[i] = wins ? int32_t(k) : label[i];
        }
    }
    std::vector<CellLeaf> parts;
    for (const int32_t ball : among) parts.push_back({ball, {}});
    for (int i = 0; i < kLeafVoxels; ++i) {
        if (!isOn(object.mask(leaf), uint32_t(i)) || best[i] < 0) continue;
        parts[label[i]].mask[i >> 6] |= uint64_t(1) << (i & 63);
    }
    parts.erase(std::remove_if(parts.begin(), parts.end(),
                    [](const CellLeaf& part) { return part.mask == LeafMask{}; }),
        parts.end());
    return parts;
}

} // namespace

std::vector<std::vector<openvdb::Coord>> cellPoints(const std::vector<FineBall>& balls,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<int32_t> all(balls.size());
    std::iota(all.begin(), all.end(), 0);
    std::vector<std::vector<CellLeaf>> parts(object.leafCount());
    const auto body = [&](std::size_t leaf, const std::vector<int32_t>& among) {
        parts[leaf] = partsOf(leaf, balls, object, among);
    };
    forEachLeafWithBalls(object, std::move(all), ballsWithPower(balls), body, interrupter);

    std::vector<std::vector<std::pair<uint32_t, const LeafMask*>>> cells(balls.size());
    for (std::size_t leaf = 0; leaf < parts.size(); ++leaf) {
        for (const CellLeaf& part : parts[leaf]) {
            cells[part.ball].emplace_back(uint32_t(leaf), &part.mask);
        }
    }
    std::vector<std::vector<openvdb::Coord>> points(balls.size());
    detail::parallelForWithScratch<ExtremePoints>(
        balls.size(), interrupter, [&](std::size_t ball, ExtremePoints& extreme) {
            extreme.clear();
            for (const auto& [leaf, mask] : cells[ball]) extreme.add(object.origin(leaf), *mask);
            points[ball] = extreme.finish();
        });
    return points;
}

} // namespace tight
} // namespace openvdb_spheretree
