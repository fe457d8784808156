// SPDX-License-Identifier: Apache-2.0
#include "NaiveChains.h"

#include <openvdb/math/Transform.h>

namespace spheretree_test {

HoldsVoxel holdsExactly(const openvdb_spheretree::Spheres& nodes, int subdivision)
{
    return [&nodes, subdivision](int32_t id, const Coord& voxel) {
        __int128 sum = 0;
        for (int a = 0; a < 3; ++a) {
            const auto center = int64_t(nodes.center[id][a] * subdivision);
            const __int128 d = int64_t(subdivision) * voxel[a] - center;
            sum += d * d;
        }
        return sum <= nodes.coverRadiusSq[id];
    };
}

HoldsVoxel holdsStored(
    const openvdb_spheretree::Spheres& nodes, const openvdb_spheretree::SphereTree& tree)
{
    const double padding = tree.settings.paddingVoxels() * tree.voxelSize();
    return [&nodes, &tree, padding](int32_t id, const Coord& voxel) {
        const openvdb::Vec3d center = tree.transform->indexToWorld(nodes.center[id]);
        const double apart = (tree.transform->indexToWorld(voxel) - center).length();
        return apart <= (double(nodes.radiusWorld[id]) - padding) * (1 + 1e-9) + 1e-12;
    };
}

std::vector<int64_t> naiveBrokenLevels(
    const openvdb_spheretree::SphereTree& tree, const Voxels& voxels, const HoldsVoxel& holds)
{
    std::vector<int64_t> lost(tree.levels.size(), 0);
    for (const Coord& voxel : voxels) {
        std::vector<char> chained(tree.spheres.center.size(), 0);
        for (std::size_t k = 0; k < tree.levels.size(); ++k) {
            bool any = false;
            for (int32_t id = tree.levels[k].begin; id < tree.levels[k].end; ++id) {
                if (!holds(id, voxel)) continue;
                bool below = k == 0;
                for (int32_t child = 0; child < tree.size() && !below; ++child) {
                    below = tree.spheres.parent[child] == id && chained[child];
                }
                chained[id] = char(below);
                any = any || below;
            }
            if (any) continue;
            ++lost[k];
            break;
        }
    }
    return lost;
}

int64_t naiveBrokenCut(const openvdb_spheretree::SphereCuts& cuts, int32_t leaves, int32_t spheres,
    const Voxels& voxels, const HoldsVoxel& holds)
{
    int64_t lost = 0;
    for (const Coord& voxel : voxels) {
        bool any = false;
        for (int32_t leaf = 0; leaf < cuts.size() && !any; ++leaf) {
            if (cuts.last[leaf] != leaves) continue;
            int32_t node = leaf; // up to the cut, while all hold the voxel
            while (node >= 0 && holds(node, voxel) && cuts.first[node] > spheres) {
                node = cuts.spheres.parent[node];
            }
            any = node >= 0 && holds(node, voxel);
        }
        lost += !any;
    }
    return lost;
}

} // namespace spheretree_test
