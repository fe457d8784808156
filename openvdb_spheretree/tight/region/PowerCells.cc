// SPDX-License-Identifier: Apache-2.0
#include "PowerCells.h"

#include "BallsInBox.h"
#include "LeafDescent.h"
#include "LeafPower.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/ExtremePoints.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// The part of a ball's power cell in a leaf.
struct CellPart {
    int32_t ball;
    LeafMask mask;
};

/// @return a filter that drops the balls with less power, in all of a box, than the one with the
/// most power in its middle.
BallFilter ballsWithPower(const BallsInBox& inBox)
{
    return [&](const openvdb::CoordBBox& box, const std::vector<int32_t>& from,
               std::vector<int32_t>& to) {
        StrongestBall strongest;
        std::vector<int32_t> some;
        inBox.list(box, from, false, strongest, some);
        inBox.list(box, some, false, strongest, to);
    };
}

/// A ball that may have voxels of a leaf in its power cell, and those of them that may be in it.
struct Claim {
    int32_t ball;
    const LeafMask* within;
};

/// @return the parts of power cells in the leaf at @a origin.
std::vector<CellPart> partsOf(
    const openvdb::Coord& origin, std::vector<Claim> claims, const std::vector<ExactSphere>& balls)
{
    // Of equal powers the larger ball wins, then the first.
    std::sort(claims.begin(), claims.end(), [&](const Claim& a, const Claim& b) {
        const int64_t sizeA = balls[a.ball].radiusSq, sizeB = balls[b.ball].radiusSq;
        return sizeA != sizeB ? sizeA > sizeB : a.ball < b.ball;
    });
    std::vector<LeafClaim> contenders;
    for (const Claim& claim : claims) contenders.push_back({&balls[claim.ball], claim.within});
    const std::array<int64_t, kLeafVoxels> winners = strongestClaims(origin, contenders);
    std::vector<LeafMask> masks(claims.size(), LeafMask{});
    for (uint32_t i = 0; i < kLeafVoxels; ++i) {
        if (winners[i] >= 0) masks[std::size_t(winners[i])].setOn(i);
    }
    std::vector<CellPart> parts;
    for (std::size_t k = 0; k < claims.size(); ++k) {
        if (!masks[k].none()) parts.push_back({claims[k].ball, masks[k]});
    }
    return parts;
}

/// @param parts  of each leaf; they are freed on the way
std::vector<VoxelRegion> cellsOf(
    std::vector<std::vector<CellPart>>& parts, std::size_t balls, const SampleLevel& object)
{
    std::vector<VoxelRegion> cells(balls, VoxelRegion(object));
    for (std::size_t leaf = 0; leaf < parts.size(); ++leaf) {
        for (const CellPart& part : parts[leaf]) {
            cells[part.ball].append(uint32_t(leaf), part.mask);
        }
        std::vector<CellPart>().swap(parts[leaf]);
    }
    return cells;
}

} // namespace

std::vector<VoxelRegion> powerCells(const std::vector<ExactSphere>& balls,
    const std::vector<VoxelRegion>& regions, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<std::vector<Claim>> claims(object.leafCount());
    for (std::size_t ball = 0; ball < regions.size(); ++ball) {
        for (const RegionLeaf part : regions[ball]) {
            claims[part.leaf].push_back({int32_t(ball), &part.mask});
        }
    }
    std::vector<std::vector<CellPart>> parts(object.leafCount());
    detail::parallelFor(parts.size(), interrupter, [&](std::size_t leaf) {
        parts[leaf] = partsOf(object.origin(leaf), std::move(claims[leaf]), balls);
    });
    return cellsOf(parts, balls.size(), object);
}

std::vector<VoxelRegion> powerCells(const std::vector<ExactSphere>& balls,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter)
{
    const BallsInBox inBox(balls);
    std::vector<int32_t> all(balls.size());
    std::iota(all.begin(), all.end(), 0);
    std::vector<std::vector<CellPart>> parts(object.leafCount());
    const auto body = [&](std::size_t leaf, const std::vector<int32_t>& among) {
        std::vector<Claim> claims;
        for (const int32_t ball : among) claims.push_back({ball, &object.mask(leaf)});
        parts[leaf] = partsOf(object.origin(leaf), std::move(claims), balls);
    };
    forEachLeafWithBalls(object, std::move(all), ballsWithPower(inBox), body, interrupter);
    return cellsOf(parts, balls.size(), object);
}

std::vector<std::vector<openvdb::Coord>> extremePoints(const std::vector<VoxelRegion>& regions,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<std::vector<openvdb::Coord>> points(regions.size());
    detail::parallelForWithScratch<ExtremePoints>(
        regions.size(), interrupter, [&](std::size_t i, ExtremePoints& extreme) {
            extreme.clear();
            for (const RegionLeaf part : regions[i]) {
                extreme.add(object.origin(part.leaf), part.mask);
            }
            points[i] = extreme.finish();
        });
    return points;
}

std::vector<std::vector<openvdb::Coord>> powerCellPoints(const std::vector<ExactSphere>& balls,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter)
{
    return extremePoints(powerCells(balls, object, interrupter), object, interrupter);
}

} // namespace openvdb_spheretree::tight
