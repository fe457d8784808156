// SPDX-License-Identifier: Apache-2.0
#include "GroupedCover.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/BallGrid.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>

#include <cassert>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// The part of a cell that a group has to hold.
struct CellPart {
    int32_t group = -1;
    VoxelRegion cell;
};

int64_t voxelsIn(const VoxelRegion& region)
{
    int64_t voxels = 0;
    for (const RegionLeaf part : region) voxels += part.mask.count();
    return voxels;
}

/// @return the cell in parts, one for each group that gets one; the one with the largest part
/// first.
std::vector<CellPart> partsOf(
    VoxelRegion cell, const std::vector<int32_t>& groups, const std::vector<VoxelRegion>& regions)
{
    std::vector<CellPart> parts;
    while (!cell.empty()) {
        CellPart largest;
        int64_t most = 0;
        for (const int32_t group : groups) {
            VoxelRegion held = intersectionOf(cell, regions[group]);
            const int64_t voxels = voxelsIn(held);
            if (voxels <= most) continue;
            most = voxels;
            largest = {group, std::move(held)};
        }
        assert(largest.group >= 0); // regions together are the object
        if (largest.group < 0) break;
        cell = differenceOf(cell, largest.cell);
        parts.push_back(std::move(largest));
    }
    return parts;
}

} // namespace

GroupedCover dealtOut(const std::vector<ExactSphere>& balls, const TightLevel& coarser,
    const std::vector<VoxelRegion>& regions, const LevelMaker& maker)
{
    std::vector<VoxelRegion> cells = powerCells(balls, maker.object.level(0), maker.interrupter);
    const BallGrid grid(coarser.balls);
    std::vector<std::vector<CellPart>> parts(balls.size());
    detail::parallelFor(balls.size(), maker.interrupter, [&](std::size_t i) {
        parts[i] = partsOf(std::move(cells[i]), grid.near(balls[i], 1), regions);
    });
    GroupedCover dealt;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        for (CellPart& part : parts[i]) {
            dealt.balls.push_back({balls[i], part.group});
            dealt.cells.push_back(std::move(part.cell));
        }
    }
    return dealt;
}

} // namespace openvdb_spheretree::tight
