// SPDX-License-Identifier: Apache-2.0
#include "TightSamples.h"

#include "TreeSettings.h"

#include <openvdb_spheretree/voxel/MaskGrids.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace spheretree_test {

float floatAbove(double x)
{
    const float rounded = float(x);
    return double(rounded) < x ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
                               : rounded;
}

namespace {

/// A sphere around voxels, its centre about the middle of them; with none, a point at @a elsewhere.
/// @param nodes  of a tree, or its cuts
void addSphere(openvdb_spheretree::Spheres& nodes, const SphereTree& tree, const Voxels& owned,
    const Coord& elsewhere, Random& random)
{
    const CoordBBox box = owned.empty() ? CoordBBox(elsewhere, elsewhere) : boxOf(owned);
    const Coord corner = box.min();
    int64_t center[3], square = 0; // from the corner, in units
    openvdb::Vec3d position;
    for (int a = 0; a < 3; ++a) {
        center[a] = tree.subdivision * (box.max()[a] - corner[a]) / 2 + random.between(-9, 9);
        position[a] = corner[a] + double(center[a]) / tree.subdivision;
    }
    for (const Coord& voxel : owned) {
        int64_t sum = 0;
        for (int a = 0; a < 3; ++a) {
            const int64_t d = tree.subdivision * (voxel[a] - corner[a]) - center[a];
            sum += d * d;
        }
        square = std::max(square, sum);
    }
    nodes.center.push_back(position);
    nodes.coverRadiusSq.push_back(square);
    nodes.radius.push_back(std::sqrt(double(square)) / tree.subdivision);
    nodes.radiusWorld.push_back(
        floatAbove((nodes.radius.back() + tree.settings.paddingVoxels()) * tree.voxelSize()));
}

/// Each group joins the one of some chosen groups that is nearest.
std::vector<int> joined(const Groups& groups, int count, Random& random)
{
    std::vector<int> chosen;
    for (int i = 0; i < count; ++i) chosen.push_back(random.between(0, int(groups.size()) - 1));
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    std::vector<int> group;
    for (const Voxels& voxels : groups) {
        int best = 0;
        const auto apart = [&](int i) {
            return squaredDistance(voxels.front(), groups[chosen[i]].front());
        };
        for (int i = 1; i < int(chosen.size()); ++i) best = apart(i) < apart(best) ? i : best;
        group.push_back(best);
    }
    return group;
}

Groups merged(const Groups& groups, const std::vector<int>& group)
{
    Groups result(std::size_t(*std::max_element(group.begin(), group.end())) + 1);
    for (std::size_t i = 0; i < groups.size(); ++i) {
        Voxels& all = result[group[i]];
        all.insert(all.end(), groups[i].begin(), groups[i].end());
    }
    return result;
}

} // namespace

SphereTree describedTree(const openvdb::BoolGrid& object)
{
    SphereTree tree;
    tree.subdivision = 16;
    setType(tree.settings, openvdb_spheretree::TreeType::Tight);
    tree.transform = object.transform().copy();
    tree.object.voxels = int64_t(object.activeVoxelCount());
    tree.object.leaves = int64_t(object.tree().leafCount());
    tree.object.tiles = int64_t(object.tree().activeTileCount());
    tree.object.bbox = object.evalActiveVoxelBoundingBox();
    return tree;
}

Hierarchy::Hierarchy(const Voxels& voxels, int leaves, Random& random)
{
    Groups single;
    for (const Coord& voxel : voxels) single.push_back({voxel});
    levels.push_back(merged(single, joined(single, leaves, random)));
    while (levels.back().size() > 1) {
        const Groups& below = levels.back();
        const int fewer = std::max(1, int(below.size()) / random.between(2, 4));
        parents.push_back(joined(below, fewer, random));
        levels.push_back(merged(below, parents.back()));
    }
    parents.emplace_back(1, -1);
}

SphereTree randomTightTree(
    const openvdb::BoolGrid& object, const Hierarchy& hierarchy, Random& random)
{
    SphereTree tree = describedTree(object);
    const int count = int(hierarchy.levels.size());
    tree.levels.resize(count);
    for (int k = count - 1; k >= 0; --k) {
        SphereTreeLevel& level = tree.levels[k];
        level.level = k;
        level.begin = tree.size();
        const int32_t above = k + 1 < count ? tree.levels[k + 1].begin : 0;
        for (std::size_t i = 0; i < hierarchy.levels[k].size(); ++i) {
            addSphere(tree.spheres, tree, hierarchy.levels[k][i], Coord(), random);
            tree.ijk.push_back(Coord::round(tree.spheres.center.back()));
            tree.radiusSq.push_back(-1);
            tree.spheres.parent.push_back(k + 1 < count ? above + hierarchy.parents[k][i] : -1);
        }
        level.end = tree.size();
    }
    return tree;
}

void addRandomCuts(SphereTree& tree, const Groups& groups, int idle, Random& random)
{
    SphereCuts& cuts = tree.cuts;
    Groups owned = groups;
    owned.resize(groups.size() + std::size_t(idle));
    const auto begin = [&](const Voxels& voxels, int last) {
        addSphere(cuts.spheres, tree, voxels, groups[0][0], random);
        cuts.spheres.parent.push_back(-1);
        cuts.first.push_back(1);
        cuts.last.push_back(last);
    };
    std::vector<int> alive;
    const int leaves = int(owned.size());
    for (int i = 0; i < leaves; ++i) {
        begin(owned[i], leaves);
        alive.push_back(i);
    }
    const auto end = [&](std::size_t place, int spheres, int parent) {
        cuts.first[alive[place]] = spheres;
        cuts.spheres.parent[alive[place]] = parent;
        alive.erase(alive.begin() + long(place));
    };
    for (int spheres = leaves; spheres > 1; --spheres) {
        const auto idleOne =
            std::find_if(alive.begin(), alive.end(), [&](int i) { return owned[i].empty(); });
        if (idleOne != alive.end() && random.chance(0.3)) {
            end(std::size_t(idleOne - alive.begin()), spheres, -1);
            continue;
        }
        const int parent = int(owned.size());
        Voxels all;
        for (int child = 0; child < 2; ++child) {
            const auto place = std::size_t(random.between(0, int(alive.size()) - 1));
            const Voxels& some = owned[alive[place]];
            all.insert(all.end(), some.begin(), some.end());
            end(place, spheres, parent);
        }
        begin(all, spheres - 1);
        owned.push_back(all);
        alive.push_back(parent);
    }
    tree.hasCuts = true;
}

} // namespace spheretree_test
