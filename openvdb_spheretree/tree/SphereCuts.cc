// SPDX-License-Identifier: Apache-2.0
#include "SphereCuts.h"

#include "CutsLayout.h"
#include "SphereTree.h"

#include <openvdb/math/Transform.h>

#include <algorithm>

namespace openvdb_spheretree {

namespace {

/// All that a tree of one level knows beside its nodes.
SphereTree describedLike(const SphereTree& tree)
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

} // namespace

std::vector<int32_t> cutNodes(const SphereCuts& cuts, int64_t spheres)
{
    std::vector<int32_t> nodes;
    for (int32_t i = 0; i < cuts.size(); ++i) {
        if (cuts.first[i] <= spheres && spheres <= cuts.last[i]) nodes.push_back(i);
    }
    return nodes;
}

SphereTree cutTree(const SphereTree& tree, int64_t spheres)
{
    if (tree.cuts.empty()) {
        OPENVDB_THROW(openvdb::ValueError,
            "the tree has no cuts to choose " << spheres << " spheres from: build it with cuts=1");
    }
    if (spheres < 1) {
        OPENVDB_THROW(openvdb::ValueError,
            "spheres=" << spheres << " is out of range: a level has one sphere or more");
    }
    SphereTree result = describedLike(tree);
    const int64_t count = std::min<int64_t>(spheres, detail::leavesOf(tree.cuts));
    result.spheres = tree.cuts.spheres.take(cutNodes(tree.cuts, count));
    std::fill(result.spheres.parent.begin(), result.spheres.parent.end(), -1);
    for (const openvdb::Vec3d& center : result.spheres.center) {
        result.ijk.push_back(openvdb::Coord::round(center));
    }
    result.radiusSq.assign(result.ijk.size(), -1);
    result.levels.resize(1);
    result.levels[0].end = result.size();
    return result;
}

} // namespace openvdb_spheretree
