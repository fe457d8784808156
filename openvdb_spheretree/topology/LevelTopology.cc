// SPDX-License-Identifier: Apache-2.0
/// @file LevelTopology.cc
/// @brief Components b0, tunnels b1 and cavities b2 of closed cubes, from what can be counted
/// without looking at empty space:
/// - b0 is the number of 26-connected components of the object (PartSets.h);
/// - b2 is the number of 6-connected components of the background, less the one outside (Alexander
///   duality);
/// - b0 - b1 + b2 is the Euler characteristic, a sum over leaves (EulerNumber.cc).
///
/// Cost: linear in leaves. Exact. Tests: TestLevelTopology.cc.

#include "LevelTopology.h"

#include "EulerNumber.h"
#include "PartSets.h"
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/LeafWalk.h>

#include <numeric>
#include <vector>

namespace openvdb_spheretree {

namespace {

using detail::LeafWalk;

/// Where all leaves that eulerOfLeaf() looks at are full, the sum is 0.
bool isDeepInside(const detail::LevelParts& parts, const LeafWalk& around)
{
    for (int i = 0; i < 18; ++i) {
        const uint32_t leaf = around.at(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
        if (leaf == LeafWalk::kNone || !parts.isFull(leaf)) return false;
    }
    return true;
}

} // namespace

LevelTopology levelTopology(const LeafLayout& level, openvdb::util::NullInterrupter* interrupter)
{
    const detail::LevelParts parts(level, interrupter);
    detail::PartSets sets(level, parts);
    std::vector<int64_t> eulers(parts.chunks(), 0);
    sets.joinAll(interrupter, [&](std::size_t chunk, const LeafWalk& around) {
        if (!isDeepInside(parts, around)) eulers[chunk] += detail::eulerOfLeaf(level, around);
    });
    const int64_t components = sets.object().sets(), cavities = sets.background().sets() - 1;
    const int64_t euler = std::accumulate(eulers.begin(), eulers.end(), int64_t(0));
    return {components, components + cavities - euler, cavities};
}

LevelTopology levelTopology(
    const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter)
{
    return levelTopology(LeafLayout(*voxelsOf(object, FlatAxis(2))), interrupter);
}

} // namespace openvdb_spheretree
