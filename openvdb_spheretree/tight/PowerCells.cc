// SPDX-License-Identifier: Apache-2.0
#include "PowerCells.h"

#include "../detail/Parallel.h"
#include "ExtremePoints.h"
#include "LeafBalls.h"

#include <algorithm>
#include <array>

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

/// A ball that may have a part of a leaf, and the voxels that count.
struct Claim {
    int32_t ball;
    const LeafMask* within;
};

bool isOn(const LeafMask& mask, int voxel) { return mask[voxel >> 6] >> (voxel & 63) & 1; }

/// @return the parts of cells in the leaf at @a origin, by ball.
std::vector<CellLeaf> partsOf(const openvdb::Coord& origin, const std::vector<Claim>& claims,
    const std::vector<FineBall>& balls)
{
    std::array<int64_t, kLeafVoxels> best;
    std::array<int32_t, kLeafVoxels> label;
    best.fill(-1); // a ball without a power of 0 or more does not hold the voxel
    label.fill(-1);
    for (const auto& [ball, within] : claims) {
        const PowerTerms terms(balls[ball], origin);
        for (int i = 0; i < kLeafVoxels; ++i) {
            const int64_t power =
                terms.axis[0][i >> 6] + terms.axis[1][i >> 3 & 7] + terms.axis[2][i & 7];
            const bool more = power > best[i]
                || (power == best[i] && power >= 0
                    && balls[ball].radiusSq > balls[label[i]].radiusSq);
            const bool wins = more && isOn(*within, i);
            best[i] = wins ? power : best[i];
            label[i] = wins ? ball : label[i];
        }
    }
    std::vector<CellLeaf> parts;
    for (const auto& claim : claims) {
        CellLeaf part{claim.ball, {}};
        for (int i = 0; i < kLeafVoxels; ++i) {
            part.mask[i >> 6] |= uint64_t(label[i] == claim.ball) << (i & 63);
        }
        if (!isEmpty(part.mask)) parts.push_back(part);
    }
    return parts;
}

/// @return the cells, when @a claims are those in each leaf, by ball.
template <typename ClaimsOf>
std::vector<VoxelRegion> cellsBy(const ClaimsOf& claimsOf, const std::vector<FineBall>& balls,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<std::vector<CellLeaf>> parts(object.leafCount());
    detail::parallelFor(parts.size(), interrupter, [&](std::size_t leaf) {
        parts[leaf] = partsOf(object.origin(leaf), claimsOf(leaf), balls);
    });
    std::vector<VoxelRegion> cells(balls.size());
    for (std::size_t leaf = 0; leaf < parts.size(); ++leaf) {
        for (const CellLeaf& part : parts[leaf]) {
            cells[part.ball].push_back({uint32_t(leaf), part.mask});
        }
        std::vector<CellLeaf>().swap(parts[leaf]);
    }
    return cells;
}

} // namespace

std::vector<VoxelRegion> cellRegions(const std::vector<FineBall>& balls,
    const std::vector<VoxelRegion>& regions, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<std::vector<Claim>> claims(object.leafCount());
    for (std::size_t ball = 0; ball < regions.size(); ++ball) {
        for (const RegionLeaf& part : regions[ball]) {
            claims[part.leaf].push_back({int32_t(ball), &part.mask});
        }
    }
    const auto claimsOf = [&](std::size_t leaf) -> const auto& { return claims[leaf]; };
    return cellsBy(claimsOf, balls, object, interrupter);
}

std::vector<std::vector<openvdb::Coord>> extremePoints(const std::vector<VoxelRegion>& regions,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<std::vector<openvdb::Coord>> points(regions.size());
    detail::parallelForWithScratch<ExtremePoints>(
        regions.size(), interrupter, [&](std::size_t i, ExtremePoints& extreme) {
            extreme.clear();
            for (const RegionLeaf& part : regions[i]) {
                extreme.add(object.origin(part.leaf), part.mask);
            }
            points[i] = extreme.finish();
        });
    return points;
}

std::vector<std::vector<openvdb::Coord>> cellPoints(const std::vector<FineBall>& balls,
    const SampleLevel& object, openvdb::util::NullInterrupter* interrupter)
{
    const LeafBalls lists(balls, object, interrupter);
    const auto claimsOf = [&](std::size_t leaf) {
        std::vector<Claim> claims;
        for (const int32_t ball : lists.of(leaf)) claims.push_back({ball, &object.mask(leaf)});
        return claims;
    };
    return extremePoints(cellsBy(claimsOf, balls, object, interrupter), object, interrupter);
}

} // namespace tight
} // namespace openvdb_spheretree
