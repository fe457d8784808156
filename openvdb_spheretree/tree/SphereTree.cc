// SPDX-License-Identifier: Apache-2.0
#include "SphereTree.h"

#include "TreeShape.h"
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/Exceptions.h>
#include <openvdb/math/Transform.h>

#include <algorithm>

namespace openvdb_spheretree {

openvdb::Vec3d SphereTree::centerWorld(int32_t id) const
{
    return transform->indexToWorld(spheres.center[id]);
}

double SphereTree::voxelSize() const { return voxelSizeOf(*transform); }

int SphereTree::levelOf(int32_t id) const
{
    for (const SphereTreeLevel& range : levels) {
        if (id >= range.begin && id < range.end) return range.level;
    }
    OPENVDB_THROW(openvdb::LookupError, "the tree has no node " << id);
}

bool SphereTree::hasLevel(int number) const
{
    return std::any_of(levels.begin(), levels.end(),
        [&](const SphereTreeLevel& range) { return range.level == number; });
}

const SphereTreeLevel& SphereTree::level(int number) const
{
    for (const SphereTreeLevel& range : levels) {
        if (range.level == number) return range;
    }
    if (levels.empty()) OPENVDB_THROW(openvdb::ValueError, "the tree has no levels");
    OPENVDB_THROW(openvdb::ValueError,
        "the tree has no level " << number << ": it has levels " << levels.front().level << " to "
                                 << levels.back().level);
}

SphereTree detail::describedLike(const SphereTree& tree)
{
    SphereTree result;
    result.subdivision = tree.subdivision;
    result.settings = tree.settings;
    result.flatAxis = tree.flatAxis;
    result.object = tree.object;
    result.origin = tree.origin;
    result.transform = tree.transform->copy();
    return result;
}

SphereTree keepLevel(const SphereTree& tree, int level)
{
    const SphereTreeLevel& range = tree.level(level);
    SphereTree result = detail::describedLike(tree);
    result.spheres = tree.spheres.slice(range.begin, range.end);
    std::fill(result.spheres.parent.begin(), result.spheres.parent.end(), -1);
    result.ijk.assign(tree.ijk.begin() + range.begin, tree.ijk.begin() + range.end);
    result.radiusSq.assign(tree.radiusSq.begin() + range.begin, tree.radiusSq.begin() + range.end);
    if (!tree.track.empty()) {
        result.track.assign(tree.track.begin() + range.begin, tree.track.begin() + range.end);
        result.nextTrack = tree.nextTrack;
    }
    result.levels = {range};
    result.levels[0].begin = 0;
    result.levels[0].end = result.size();
    return result;
}

SphereTree keepSpheres(const SphereTree& tree, int64_t spheres)
{
    if (!tree.cuts.empty()) return cutTree(tree, spheres);
    for (const SphereTreeLevel& range : tree.levels) {
        if (range.size() <= spheres) return keepLevel(tree, range.level);
    }
    OPENVDB_THROW(openvdb::ValueError,
        "no level has at most " << spheres << " spheres: the coarsest has " << tree.root().size());
}

} // namespace openvdb_spheretree
