// SPDX-License-Identifier: Apache-2.0
#include "MonotoneLevels.h"

#include "BoundedErrors.h"
#include <openvdb_spheretree/sphere/SphereUnion.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <numeric>

namespace openvdb_spheretree::tight {

namespace {

/// @param finer  the level below @a level; null if there is none
void becomeCopy(TightLevel& level, const TightLevel& coarser, TightLevel* finer)
{
    if (finer) {
        for (int32_t& parent : finer->parent) parent = level.parent[parent];
    }
    level.balls = coarser.balls;
    level.digital = coarser.digital;
    level.parent.resize(level.balls.size());
    std::iota(level.parent.begin(), level.parent.end(), 0);
}

/// @param tree  as of errorOf()
/// @return how many voxels a tree of this level alone covers; nothing if they are too many to be
/// counted.
std::optional<int64_t> coveredBy(
    const TightLevel& level, SphereTree tree, openvdb::util::NullInterrupter* interrupter)
{
    if (!level.digital.empty()) return tree.object.voxels;
    appendLevels({{level.balls, {}, {}}}, tree);
    const std::vector<ExactSphere> spheres = levelSpheres(tree, tree.levels.front());
    if (crossedRows(spheres, levelBox(tree, spheres), metricOf(tree)) > double(kMaxUnionRows)) {
        return std::nullopt;
    }
    return detail::countVoxels(*levelUnion(tree, tree.levels.front(), interrupter));
}

} // namespace

std::vector<TightLevel> monotoneLevels(
    std::vector<TightLevel> levels, std::vector<std::optional<int64_t>> covered)
{
    bool changed = false;
    for (std::size_t k = levels.size(); k-- > 0;) {
        if (k + 1 == levels.size() || !covered[k]) continue;
        std::size_t known = k + 1; // the next coarser level whose voxels are known
        while (known < levels.size() && !covered[known]) ++known;
        if (known == levels.size() || *covered[k] <= *covered[known]) continue;
        for (std::size_t j = known; j-- > k;) { // those between have the unknown
            becomeCopy(levels[j], levels[j + 1], j > 0 ? &levels[j - 1] : nullptr);
            covered[j] = covered[known];
        }
        changed = true;
    }
    if (!changed) return levels;
    for (std::size_t k = 1; k < levels.size(); ++k) dropChildless(levels[k], levels[k - 1]);
    return levels;
}

std::vector<TightLevel> monotoneLevels(const std::vector<TightLevel>& levels, std::size_t leafBalls,
    const SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<std::optional<int64_t>> covered;
    for (const TightLevel& level : levels) {
        const bool areLeaves = level.balls.size() == leafBalls;
        covered.push_back(areLeaves ? std::nullopt : coveredBy(level, tree, interrupter));
    }
    auto changed = monotoneLevels(levels, covered);
    const bool finestStays = changed.front().balls == levels.front().balls;
    return finestStays || keepsBounds(changed.front(), tree, object, interrupter) ? changed
                                                                                  : levels;
}

} // namespace openvdb_spheretree::tight
