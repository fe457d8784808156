// SPDX-License-Identifier: Apache-2.0
#include "BuiltTrees.h"

#include <openvdb_spheretree/voxel/Distance.h>

#include <cmath>

namespace spheretree_test {

std::string describe(const SphereTreeSettings& s)
{
    using namespace openvdb_spheretree;
    const auto pyramid = optionsOr<PyramidOptions>(s);
    const auto extended = optionsOr<ExtendedOptions>(s);
    return std::string(toString(s.type())) + " factor=" + std::to_string(pyramid.factor)
        + " dim=" + std::to_string(s.dim) + " parent=" + toString(pyramid.parent)
        + " final_fit=" + (extended.finalFit ? "1" : "0")
        + " reconstruct=" + toString(extended.reconstruct) + " scale=" + toString(pyramid.scale)
        + " dist=" + toString(s.dist()) + " padding=" + std::to_string(s.padding);
}

std::vector<SphereTreeSettings> allSettings(TreeType type, int dim)
{
    const bool extended = type == TreeType::Extended;
    std::vector<SphereTreeSettings> all;
    for (int i = 0; i < 48; ++i) {
        SphereTreeSettings settings;
        setType(settings, type);
        settings.dim = dim;
        settings.pyramid().dag = true;
        settings.pyramid().factor = 2 + i % 2;
        settings.pyramid().parent = i / 2 % 2 ? ParentRule::Dag : ParentRule::Centre;
        settings.pyramid().scale = i / 4 % 2 ? RadiusScale::Paper : RadiusScale::Tight;
        if (extended) {
            settings.extended().finalFit = i / 8 % 2 == 0;
            settings.extended().reconstruct = Reconstruction(i / 16);
        }
        if (extended || i < 8) all.push_back(settings);
    }
    return all;
}

std::vector<SphereTreeSettings> normSettings(TreeType type, int dim)
{
    using openvdb_spheretree::Distance;
    std::vector<SphereTreeSettings> all;
    for (const Distance& distance : {Distance::l1(), Distance::linf(), Distance::chamfer(3, 4, 5),
             Distance::chamfer(16, 21, 26), Distance::chamfer(2, 3, 3)}) {
        for (SphereTreeSettings settings : allSettings(type, dim)) {
            const auto extended = optionsOr<openvdb_spheretree::ExtendedOptions>(settings);
            const bool plain = extended.reconstruct == Reconstruction::Clip
                && (extended.finalFit || settings.pyramid().scale == RadiusScale::Tight);
            settings.pyramid().dist = distance;
            if (plain) all.push_back(settings);
        }
    }
    return all;
}

std::vector<SphereTreeSettings> allSettings()
{
    std::vector<SphereTreeSettings> all = allSettings(TreeType::Reversible, 3);
    for (const SphereTreeSettings& s : allSettings(TreeType::Extended, 3)) all.push_back(s);
    return all;
}

SphereTreeSettings settingsFor(TreeType type)
{
    SphereTreeSettings settings;
    setType(settings, type);
    return settings;
}

std::vector<SphereTreeSettings> bothTypes()
{
    return {settingsFor(TreeType::Reversible), extendedTree()};
}

Voxels flattened(Voxels voxels)
{
    const int z = boxOf(voxels).min()[2];
    for (Coord& voxel : voxels) voxel[2] = z;
    sortVoxels(voxels);
    return voxels;
}

std::vector<RandomObject> someObjects(uint32_t firstSeed, uint32_t count)
{
    std::vector<RandomObject> objects;
    for (uint32_t i = 0; i < count; ++i) objects.push_back(randomObject(firstSeed + i));
    return objects;
}

namespace {

/// |subdivision (q - center)|^2, exactly, by the tree's distance.
int64_t distanceSqInUnits(const SphereTree& tree, int32_t id, const Coord& q)
{
    Coord d;
    for (int axis = 0; axis < 3; ++axis) {
        d[axis] = int32_t(tree.subdivision * int64_t(q[axis])
            - std::llround(tree.subdivision * tree.spheres.center[id][axis]));
    }
    const auto& dist = tree.settings.dist();
    if (dist.isEuclidean()) return squaredDistance(d, Coord(0, 0, 0));
    const int64_t length = Length({dist.face(), dist.edge(), dist.corner()})(d, Coord(0, 0, 0));
    return length * length;
}

} // namespace

bool holds(const SphereTree& tree, int32_t id, const Coord& q)
{
    return distanceSqInUnits(tree, id, q) <= tree.spheres.coverRadiusSq[id];
}

testing::AssertionResult sameNodes(const SphereTree& a, const SphereTree& b)
{
    const auto differ = [](const char* what) {
        return testing::AssertionFailure() << "the trees differ in " << what;
    };
    if (a.levels.size() != b.levels.size()) return differ("their number of levels");
    for (std::size_t k = 0; k < a.levels.size(); ++k) {
        const SphereTreeLevel &x = a.levels[k], &y = b.levels[k];
        if (x.level != y.level || x.begin != y.begin || x.end != y.end) return differ("levels");
        if (x.pyramidVoxels != y.pyramidVoxels) return differ("pyramidVoxels");
        if (!(x.topology == y.topology)) return differ("topology");
    }
    if (a.spheres.parent != b.spheres.parent) return differ("parent");
    if (a.ijk != b.ijk) return differ("ijk");
    if (a.radiusSq != b.radiusSq) return differ("radiusSq");
    if (a.spheres.center != b.spheres.center) return differ("center");
    if (a.spheres.radius != b.spheres.radius) return differ("radius");
    if (a.spheres.coverRadiusSq != b.spheres.coverRadiusSq) return differ("coverRadiusSq");
    if (a.spheres.radiusWorld != b.spheres.radiusWorld) return differ("radiusWorld");
    if (!(a.dag == b.dag)) return differ("dag");
    return testing::AssertionSuccess();
}

testing::AssertionResult endsAtOneRoot(const SphereTree& tree)
{
    if (tree.levels.empty() || tree.root().size() != 1 || tree.root().begin != 0) {
        return testing::AssertionFailure() << "no single root";
    }
    for (int32_t id = 1; id < tree.size(); ++id) {
        int32_t above = id;
        while (tree.spheres.parent[above] >= 0 && tree.spheres.parent[above] < above)
            above = tree.spheres.parent[above];
        if (above != 0) return testing::AssertionFailure() << "node " << id << " hangs loose";
    }
    return testing::AssertionSuccess();
}

testing::AssertionResult covers(const SphereTree& tree, const Voxels& voxels)
{
    for (const SphereTreeLevel& level : tree.levels) {
        int32_t last = level.begin;
        for (const Coord& voxel : voxels) {
            if (holds(tree, last, voxel)) continue;
            for (last = level.begin; last < level.end && !holds(tree, last, voxel);) ++last;
            if (last == level.end) {
                return testing::AssertionFailure()
                    << "level " << level.level << " misses " << voxel;
            }
        }
    }
    return testing::AssertionSuccess();
}

} // namespace spheretree_test
