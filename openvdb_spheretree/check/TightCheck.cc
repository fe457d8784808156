// SPDX-License-Identifier: Apache-2.0
/// @file TightCheck.cc
/// @brief The checks of tight trees: chains of spheres, through levels and through cuts; and of
/// spheres inside the object, that they are.

#include "ChainCheck.h"
#include "CheckReport.h"
#include <openvdb_spheretree/inner/CubeDistance.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <algorithm>
#include <string>

namespace openvdb_spheretree::detail {
namespace {

/// Calls report(section, loss) for sections that break chains, first in exact spheres and then in
/// stored ones, unless those hold as much.
/// @return whether any does
template <typename Report>
bool findBroken(CheckReport& check, ChainForest& forest, const std::vector<ExactSphere>& stored,
    const Report& report)
{
    bool anyBroken = false;
    const auto find = [&](const char* radii) {
        const auto losses =
            brokenChains(forest, metricOf(check.tree), check.mask, check.interrupter);
        for (int section = 0; section < forest.sectionCount; ++section) {
            if (losses[section].voxels == 0) continue;
            report(section, losses[section], radii);
            anyBroken = true;
        }
    };
    find("the exact radii");
    if (!anyBroken && noneSmaller(stored, forest.spheres)) return false;
    forest.spheres = stored;
    find("the stored radii less their padding");
    return anyBroken;
}

/// The levels of a tree as sections: level 0, and those from @a first on that there is room for.
ChainForest forestOfLevels(const SphereTree& tree, const std::vector<ExactSphere>& spheres,
    std::size_t first, std::size_t end)
{
    ChainForest forest;
    const int32_t last = tree.size() - 1; // ids go down from the top: turned around, children first
    forest.spheres.assign(spheres.rbegin(), spheres.rend());
    forest.parent.resize(spheres.size());
    for (int32_t id = 0; id <= last; ++id) {
        forest.parent[last - id] =
            tree.spheres.parent[id] < 0 ? -1 : last - tree.spheres.parent[id];
    }
    forest.sections.assign(spheres.size(), 0);
    const auto enter = [&](const SphereTreeLevel& level, int section) {
        for (int32_t id = level.begin; id < level.end; ++id) {
            forest.sections[last - id] = uint64_t(1) << section;
        }
    };
    enter(tree.levels.front(), 0);
    for (std::size_t k = first; k < end; ++k) enter(tree.levels[k], int(k - first) + 1);
    forest.sectionCount = int(end - first) + 1;
    return forest;
}

/// All nodes of the cuts as one level, which is how spheres are taken from a tree.
SphereTree asOneLevel(const SphereTree& tree)
{
    SphereTree nodes = describedLike(tree);
    nodes.spheres = tree.cuts.spheres;
    nodes.levels.resize(1);
    nodes.levels[0].end = nodes.size();
    return nodes;
}

/// Spheres reaching beyond the object's box would be drawn at any size.
/// @param firstId  of the spheres
void checkWithin(CheckReport& check, const std::vector<ExactSphere>& spheres, int32_t firstId,
    const std::string& name)
{
    Offenders outside;
    const SphereMetric metric = metricOf(check.tree);
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        const openvdb::CoordBBox box = levelBox(check.tree, {spheres[i]});
        if (!box.empty() && !check.box.isInside(box)) outside.add(firstId + int32_t(i));
    }
    if (outside) {
        check.fail(name, ": the sphere reaches out of the object's box for ", outside);
        return;
    }
    const auto drawn = sphereUnion(spheres, check.box, metric, check.interrupter);
    const MaskDifference extra = maskDifference(*drawn, check.mask, check.interrupter);
    if (extra.voxels == 0) return;
    check.fail(name, " holds ", voxelsText(extra.voxels, extra.cubes.front().first()),
        " that the object has not, but its spheres lie inside");
}

/// With strict=1: no sphere reaches into a cube that is not the object's.
void checkWithinCubes(CheckReport& check, const Spheres& spheres, int32_t begin, int32_t end,
    const CubeDistance& distance, const std::string& name)
{
    Offenders outside;
    for (int32_t id = begin; id < end; ++id) {
        const auto center = openvdb::Coord::round(spheres.center[id]);
        if (!check.mask.isValueOn(center)) continue; // found by its voxels
        const double halves =
            2 * double(spheres.radiusWorld[id]) / smallestStretch(*check.tree.transform);
        constexpr double kRounding = 1 + 1e-12; // of the division: finer than floats
        if (halves * halves > double(distance.halvesSq(center)) * kRounding) outside.add(id);
    }
    if (outside) {
        check.fail(
            name, ": the sphere reaches out of the object's voxel cubes (strict=1) for ", outside);
    }
}

} // namespace

bool checkChains(CheckReport& check)
{
    check.kind = FaultKind::Chains;
    const SphereTree& tree = check.tree;
    SphereTreeLevel all; // nodes, by id
    all.end = tree.size();
    const std::vector<ExactSphere> exact = levelSpheres(tree, all);
    std::vector<ExactSphere> stored = unpaddedSpheres(tree, all);
    std::reverse(stored.begin(), stored.end());
    constexpr std::size_t kRoom = ChainForest::kMaxSections - 1;
    bool broken = false;
    for (std::size_t first = 1; first < tree.levels.size(); first += kRoom) {
        const std::size_t end = std::min(first + kRoom, tree.levels.size());
        ChainForest forest = forestOfLevels(tree, exact, first, end);
        const auto report = [&](int section, const ChainLoss& loss, const char* radii) {
            if (section == 0 && first > 1) return; // told before
            const std::size_t level = section == 0 ? 0 : first + std::size_t(section) - 1;
            check.fail("level ", level, " breaks the chain of spheres of ",
                voxelsText(loss.voxels, loss.first), " of the object, in ", radii);
        };
        broken |= findBroken(check, forest, stored, report);
    }
    return !broken;
}

void checkCutChains(CheckReport& check)
{
    check.kind = FaultKind::Chains;
    const SphereCuts& cuts = check.tree.cuts;
    const SphereTree nodes = asOneLevel(check.tree);
    std::vector<int32_t> counts{leavesOf(cuts)}; // of all leaves, then powers of two: finest first
    for (int64_t count = 1; count < counts[0]; count *= 2) {
        counts.insert(counts.begin() + 1, int32_t(count));
    }
    ChainForest forest;
    forest.spheres = levelSpheres(nodes, nodes.levels[0]);
    forest.parent = cuts.spheres.parent;
    forest.sectionCount = int(counts.size());
    forest.sections.assign(forest.spheres.size(), 0);
    for (std::size_t i = 0; i < forest.spheres.size(); ++i) {
        for (std::size_t s = 0; s < counts.size(); ++s) {
            const bool in = cuts.first[i] <= counts[s] && counts[s] <= cuts.last[i];
            if (in) forest.sections[i] |= uint64_t(1) << s;
        }
    }
    const auto report = [&](int section, const ChainLoss& loss, const char* radii) {
        check.fail("the cut of ", counts[section], " spheres breaks the chain of spheres of ",
            voxelsText(loss.voxels, loss.first), " of the object, in ", radii);
    };
    findBroken(check, forest, unpaddedSpheres(nodes, nodes.levels[0]), report);
}

void checkInside(CheckReport& check)
{
    check.kind = FaultKind::Inside;
    for (const SphereTreeLevel& level : check.tree.levels) {
        const std::string name = "level " + std::to_string(level.level);
        checkWithin(check, levelSpheres(check.tree, level), level.begin, name);
    }
    const SphereTree nodes = asOneLevel(check.tree);
    if (!check.tree.cuts.empty()) {
        checkWithin(check, levelSpheres(nodes, nodes.levels[0]), 0, "the list of cuts");
    }
    if (!check.tree.settings.find<InnerOptions>()->strict) return;
    const int flatAxis = check.tree.settings.dim == 2 ? check.tree.flatAxis : -1;
    const CubeDistance distance(check.mask, flatAxis, check.interrupter);
    for (const SphereTreeLevel& level : check.tree.levels) {
        checkWithinCubes(check, check.tree.spheres, level.begin, level.end, distance,
            "level " + std::to_string(level.level));
    }
    checkWithinCubes(check, check.tree.cuts.spheres, 0, check.tree.cuts.spheres.size(), distance,
        "the list of cuts");
}

} // namespace openvdb_spheretree::detail
