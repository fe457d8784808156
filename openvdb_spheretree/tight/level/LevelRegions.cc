// SPDX-License-Identifier: Apache-2.0
#include "LevelRegions.h"

#include <openvdb_spheretree/base/Parallel.h>

namespace openvdb_spheretree::tight {

std::vector<VoxelRegion> chainRegions(
    const TightLevel& level, const std::vector<VoxelRegion>& above, const LevelMaker& maker)
{
    const SampleLevel& object = maker.object.level(0);
    std::vector<VoxelRegion> regions(level.balls.size());
    detail::parallelFor(regions.size(), maker.interrupter, [&](std::size_t i) {
        regions[i] = above.empty() ? regionOf(level.balls[i], object)
                                   : clipped(above[level.parent[i]], level.balls[i], object);
    });
    return regions;
}

std::vector<VoxelRegion> regionsBelow(const std::vector<VoxelRegion>& regions,
    const std::vector<int32_t>& parents, std::size_t count, const LevelMaker& maker)
{
    std::vector<std::vector<const VoxelRegion*>> children(count);
    for (std::size_t i = 0; i < regions.size(); ++i) children[parents[i]].push_back(&regions[i]);
    std::vector<VoxelRegion> below(count);
    detail::parallelFor(
        count, maker.interrupter, [&](std::size_t p) { below[p] = unionOf(children[p]); });
    return below;
}

std::vector<VoxelRegion> heldBelow(const std::vector<ExactSphere>& balls,
    const std::vector<VoxelRegion>& regions, const std::vector<int32_t>& parents,
    const LevelMaker& maker)
{
    std::vector<VoxelRegion> held = regionsBelow(regions, parents, balls.size(), maker);
    detail::parallelFor(held.size(), maker.interrupter, [&](std::size_t i) {
        held[i] =
            balls[i].empty() ? VoxelRegion() : clipped(held[i], balls[i], maker.object.level(0));
    });
    return held;
}

} // namespace openvdb_spheretree::tight
