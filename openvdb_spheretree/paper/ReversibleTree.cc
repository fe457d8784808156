// SPDX-License-Identifier: Apache-2.0
/// @file ReversibleTree.cc
/// @brief The reversible tree (Broutta et al. 2009, 3.2): all medial balls of every level of the OR
/// pyramid (or that of another model), so that each level rebuilds its own pyramid level, and level
/// 0 the object.
///
/// For each level from the finest up: its medial balls become nodes, with the spheres of
/// LevelFrame.h (`BuildContext::allBalls`); then each node of the level below gets its parent
/// (`linkLevels`, TreeLevels.h: the label of the parent voxel of its center, or the best
/// parent in the Sphere-DAG). It ends: the OR pyramid ends with one voxel, also after closings,
/// which stay in the object's box; a custom model that adds voxels for ever is an error.
/// Exact. Cost: linear in active voxels of all levels. Tests: TestReversibleTree.cc.

#include "TreeLevels.h"
#include <openvdb_spheretree/base/Stage.h>

namespace openvdb_spheretree::detail {

std::vector<LevelNodes> reversibleLevels(openvdb::MaskTree::Ptr voxels, const BuildContext& context)
{
    auto fine = context.medialLevel(*voxels, 0);
    std::vector<LevelNodes> levels;
    levels.push_back(context.allBalls(fine));
    for (int level = 0; levels.back().balls.size() > 1; ++level) {
        voxels = timed("pyramid", context.interrupter, &context.seconds->pyramid,
            [&] { return context.coarsened(*voxels, level); });
        auto coarse = context.medialLevel(*voxels, level + 1, &levels.back());
        timed("parents and radii", context.interrupter, &context.seconds->tree, [&] {
            LevelNodes& nodes = levels.back();
            Links links = linkLevels(nodes, level, fine.get(), *coarse, context);
            nodes.parent = std::move(links.parent);
            nodes.dag = std::move(links.dag);
        });
        levels.push_back(context.allBalls(coarse));
        fine = std::move(coarse);
    }
    return levels;
}

} // namespace openvdb_spheretree::detail
