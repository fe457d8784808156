// SPDX-License-Identifier: Apache-2.0
#include "MonotoneLevels.h"

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

} // namespace openvdb_spheretree::tight
