// SPDX-License-Identifier: Apache-2.0
#include "TightObjects.h"

#include "CheckedTrees.h"
#include "NaiveChains.h"

#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/tree/SphereCuts.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace spheretree_test {

Voxels joined(const Voxels& a, const Voxels& b)
{
    Voxels both = a;
    both.insert(both.end(), b.begin(), b.end());
    sortVoxels(both);
    return both;
}

namespace {

Voxels slantedLine(const Coord& step, int count)
{
    Voxels voxels;
    for (int i = 0; i < count; ++i) voxels.emplace_back(i * step[0], i * step[1], i * step[2]);
    return voxels;
}

/// A tenth of a box, but never nothing.
Voxels dust(int side, Random& random)
{
    return joined({Coord(0, 0, 0)}, shapes::noise(Coord(side), 0.1, random));
}

} // namespace

std::vector<RandomObject> smallObjects()
{
    Random random(7);
    std::vector<RandomObject> objects{
        {"one voxel", {Coord(-3, 8, 7)}},
        {"ball", translated(shapes::ball(20), Coord(-2, 7, 130))},
        {"blob", translated(shapes::noise(Coord(7, 6, 8), 0.8, random), Coord(-4, 125, -3))},
        {"components", translated(shapes::noise(Coord(7, 7, 6), 0.35, random), Coord(5, -9, -4))},
        {"dust", translated(dust(8, random), Coord(-1000, 4, 4))},
        {"sheet", translated(shapes::box(Coord(11, 1, 12)), Coord(-5, -1, 3))},
        {"line", translated(shapes::box(Coord(1, 1, 25)), Coord(0, 0, -13))},
        {"slanted line", slantedLine(Coord(1, -1, 1), 15)},
        {"box", translated(shapes::box(Coord(9, 5, 6)), Coord(-1, -1, -1))},
        {"shell", translated(shapes::ball(20, 10), Coord(8, 8, 8))},
        {"far apart", joined(shapes::ball(8), translated(shapes::ball(6), Coord(700, -90, 31)))},
    };
    for (RandomObject& object : objects) sortVoxels(object.voxels);
    return objects;
}

SphereTreeSettings tightSettings(Quality quality)
{
    SphereTreeSettings settings;
    settings.tight().quality = quality;
    settings.topology = false;
    settings.budgeted().budget.branching = 3;
    if (quality == Quality::Best) {
        settings.budgeted().budget = SphereBudget();
        settings.budgeted().budget.spheres = {1, 4};
    }
    return settings;
}

std::vector<SphereTreeSettings> tightVariants(Quality quality)
{
    std::vector<SphereTreeSettings> all;
    for (int i = 0; i < 16; ++i) {
        SphereTreeSettings settings = tightSettings(quality);
        settings.tight().cover = i % 2 ? Cover::Balls : Cover::Voxels;
        settings.tight().leaves = i / 2 % 2 ? Leaves::Medial : Leaves::Pruned;
        settings.budgeted().cuts = i / 4 % 2 && quality != Quality::Best; // which refuses them
        settings.padding = i / 8 % 2 ? 0 : SphereTreeSettings::kPadCubes;
        all.push_back(settings);
    }
    return all;
}

std::string describeTight(const SphereTreeSettings& s)
{
    return std::string("quality=") + toString(s.tight().quality)
        + " cover=" + toString(s.tight().cover) + " leaves=" + toString(s.tight().leaves)
        + " cuts=" + (s.budgeted().cuts ? "1" : "0") + " dim=" + std::to_string(s.dim)
        + " padding=" + openvdb_spheretree::paddingToString(s.padding);
}

namespace {

int64_t sumOf(const std::vector<int64_t>& counts)
{
    return std::accumulate(counts.begin(), counts.end(), int64_t(0));
}

} // namespace

Voxels rebuilt(const SphereTree& tree)
{
    Voxels voxels;
    for (int32_t id = tree.levels[0].begin; id < tree.levels[0].end; ++id) {
        for (const Coord& v : shapes::ball(tree.radiusSq[id])) {
            const bool inPlane = tree.settings.dim == 3 || v[tree.flatAxis] == 0;
            if (inPlane) voxels.push_back(v + tree.ijk[id]);
        }
    }
    sortVoxels(voxels);
    return voxels;
}

void expectChains(const SphereTree& tree, const Voxels& voxels)
{
    ASSERT_EQ(
        sumOf(naiveBrokenLevels(tree, voxels, holdsExactly(tree.spheres, tree.subdivision))), 0);
    ASSERT_EQ(sumOf(naiveBrokenLevels(tree, voxels, holdsStored(tree.spheres, tree))), 0);
}

void expectSound(const SphereTree& tree, const openvdb::BoolGrid& grid, const Voxels& voxels)
{
    ASSERT_NO_FATAL_FAILURE(expectChains(tree, voxels));
    ASSERT_EQ(sentencesOf(checkSphereTree(tree, grid)), "");
    ASSERT_TRUE(endsAtOneRoot(tree));
    if (tree.levels[0].pyramidVoxels > 0) {
        ASSERT_EQ(rebuilt(tree), voxels);
    }
}

void expectCutsHold(const SphereTree& tree, const Voxels& voxels)
{
    const SphereCuts& cuts = tree.cuts;
    int32_t leaves = 0;
    for (const int32_t last : cuts.last) leaves = std::max(leaves, last);
    for (int32_t n = 1; n <= leaves; ++n) {
        ASSERT_EQ(cutNodes(cuts, n).size(), std::size_t(n));
        if (n > 12 && n % 7 != 0 && n < leaves - 3) continue;
        ASSERT_EQ(
            naiveBrokenCut(cuts, leaves, n, voxels, holdsExactly(cuts.spheres, tree.subdivision)),
            0)
            << n;
        ASSERT_EQ(naiveBrokenCut(cuts, leaves, n, voxels, holdsStored(cuts.spheres, tree)), 0) << n;
    }
}

} // namespace spheretree_test
