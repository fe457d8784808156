// SPDX-License-Identifier: Apache-2.0
#include "SphereTree.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <type_traits>

namespace openvdb_spheretree {

int SphereTree::levelOf(int32_t id) const
{
    for (const SphereTreeLevel& range : levels) {
        if (id >= range.begin && id < range.end) return range.level;
    }
    OPENVDB_THROW(openvdb::LookupError, "the tree has no node " << id);
}

SphereTree keepLevel(const SphereTree& tree, int level)
{
    const auto range = std::find_if(tree.levels.begin(), tree.levels.end(),
        [&](const SphereTreeLevel& r) { return r.level == level; });
    if (range == tree.levels.end()) {
        OPENVDB_THROW(openvdb::ValueError,
            "the tree has no level " << level << ": it has levels " << tree.levels.front().level
                                     << " to " << tree.levels.back().level);
    }
    const auto slice = [&](const auto& all) {
        using Array = std::decay_t<decltype(all)>;
        return Array(all.begin() + range->begin, all.begin() + range->end);
    };
    SphereTree result;
    result.center = slice(tree.center);
    result.radius = slice(tree.radius);
    result.coverSq = slice(tree.coverSq);
    result.radiusWorld = slice(tree.radiusWorld);
    result.ijk = slice(tree.ijk);
    result.radiusSq = slice(tree.radiusSq);
    result.parent.assign(result.center.size(), -1);
    result.levels = {*range};
    result.levels[0].begin = 0;
    result.levels[0].end = result.size();
    result.subdivision = tree.subdivision;
    result.settings = tree.settings;
    result.settings.dag = result.settings.cuts = false; // edges lead from level to level
    result.object = tree.object;
    result.origin = tree.origin;
    result.transform = tree.transform->copy();
    return result;
}

} // namespace openvdb_spheretree
