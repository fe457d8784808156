// SPDX-License-Identifier: Apache-2.0
#include "TightTree.h"

#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/measure/LevelMeter.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/tight/level/FewLevels.h>
#include <openvdb_spheretree/tight/level/LevelCounts.h>
#include <openvdb_spheretree/tight/level/MonotoneLevels.h>
#include <openvdb_spheretree/tight/level/SearchedLevels.h>
#include <openvdb_spheretree/tight/level/TightLevels.h>
#include <openvdb_spheretree/tight/merge/MergeForest.h>
#include <openvdb_spheretree/tight/merge/SlackMerging.h>
#include <openvdb_spheretree/tight/merge/StrictMerging.h>
#include <openvdb_spheretree/tight/region/LeafBalls.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>
#include <openvdb_spheretree/sphere/SphereUnion.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>
#include <openvdb_spheretree/tree/StoredRadii.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

FitEffort effortOf(Quality quality, std::size_t leafBalls)
{
    if (quality == Quality::Fast) return {false, 4, 1, false, 16};
    // The balls of larger objects are larger: with the samples that suit 4,000 leaf balls, the time
    // for each ball of a larger object would grow.
    constexpr double kMost = 40, kLeast = 16, kFew = 4000;
    const double samples =
        std::max(kLeast, std::min(kMost, kMost * std::sqrt(kFew / double(leafBalls))));
    return {true, 12, 1, true, int(samples)};
}

std::unique_ptr<MergeModel> modelFor(
    const TightOptions& options, const std::vector<ExactSphere>& leafBalls, const LevelMaker& maker)
{
    const auto& [object, fit, flat, interrupter] = maker;
    const SampleLevel& voxels = object.level(0);
    if (options.cover == Cover::Balls) {
        return std::make_unique<StrictMerging>(
            object, leafBalls, heldBalls(leafBalls), fit, flat, interrupter);
    }
    if (options.quality == Quality::Fast) {
        auto held = heldVoxels(powerCellPoints(leafBalls, voxels, interrupter));
        return std::make_unique<StrictMerging>(
            object, leafBalls, std::move(held), fit, flat, interrupter);
    }
    return std::make_unique<SlackMerging>(object, ungrouped(leafBalls),
        regionsOf(leafBalls, voxels, interrupter), fit, flat, interrupter);
}

/// Regions, pairs of neighbours and merged balls: 1200 to 1800 bytes a leaf ball were measured, of
/// solids, sheets and noise. What is refused needs more than there is even with half of that.
void requireRoomForMerging(std::size_t leafBalls)
{
    constexpr double kBytes = 600;
    detail::requireMemory(kBytes * double(leafBalls),
        "the regions and neighbours of " + std::to_string(leafBalls) + " leaf balls",
        "use a larger voxel, split the object, or use tree=extended");
}

/// @param tree  with settings, object and transform, and without nodes
/// @return those figures of a tree of this level alone that its settings bound.
BoundedError errorOf(const std::vector<TightLevel>& level, SphereTree tree,
    const detail::LevelMeter& meter, openvdb::util::NullInterrupter* interrupter)
{
    appendLevels(level, tree);
    SphereTreeLevel& only = tree.levels.front();
    const SphereBudget& budget = tree.settings.tight().budget;
    if (budget.bounds == BoundOf::Unpadded) {
        meter.measureExact(tree, only, interrupter);
        if (!only.error) return {0, 0, only.errorUnknown};
        return {only.error->hammingPercent, only.error->hausdorff * tree.voxelSize(), ""};
    }
    detail::storeRadii(tree, interrupter);
    meter.measureStored(
        tree, only, {budget.error.has_value(), budget.distance.has_value()}, interrupter);
    if (!only.stored) return {0, 0, only.storedUnknown};
    return {only.stored->hammingPercent, only.stored->reachWorld, ""};
}

/// @return how many voxels a tree of this level alone covers; nothing if they are too many to be counted.
/// @param tree  as of errorOf()
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

/// @return whether a tree of the level alone is within the bounds of the settings.
bool keepsBounds(const TightLevel& level, const SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter)
{
    const SphereBudget& budget = tree.settings.tight().budget;
    if (!budget.hasBound()) return true;
    const detail::LevelMeter meter(object, tree.settings.dist());
    const TightLevel alone{level.balls, {}, level.digital};
    return isWithin(budget, tree.voxelSize(), errorOf({alone}, tree, meter, interrupter));
}

/// @return the levels, where none has a larger error than a coarser one; but all leaf balls stay, even
/// given ones that reach far out of the object.
std::vector<TightLevel> monotone(const std::vector<TightLevel>& levels, std::size_t leafBalls,
    const SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<std::optional<int64_t>> covered;
    for (const TightLevel& level : levels) {
        const bool areLeaves = level.balls.size() == leafBalls;
        covered.push_back(areLeaves ? std::nullopt : coveredBy(level, tree, interrupter));
    }
    auto changed = monotoneLevels(levels, covered);
    // A bound on distances may be lost.
    const bool finestStays = changed.front().balls == levels.front().balls;
    return finestStays || keepsBounds(changed.front(), tree, object, interrupter) ? changed
                                                                                  : levels;
}

/// @return which of two trees' levels, as many in both, have the smaller product of errors.
const std::vector<TightLevel>& betterOf(const std::vector<TightLevel>& some,
    const std::vector<TightLevel>& others, const SphereTree& tree,
    openvdb::util::NullInterrupter* interrupter)
{
    double gain = 0; // of `some`, log of a ratio
    for (std::size_t k = 0; k < some.size(); ++k) {
        const auto mine = coveredBy(some[k], tree, interrupter);
        const auto theirs = coveredBy(others[k], tree, interrupter);
        if (!mine || !theirs) continue;
        const auto excess = [&](int64_t voxels) { return double(1 + voxels - tree.object.voxels); };
        gain += std::log(excess(*theirs) / excess(*mine));
    }
    return gain >= 0 ? some : others;
}

/// What the levels of a tree are made from.
struct TightObject {
    const openvdb::BoolGrid& grid;
    const LeafBalls& leaves;
    LevelMaker maker;
};

/// Levels by merging the leaf balls; and the cuts if the settings say so.
std::vector<TightLevel> mergedLevels(SphereTree& tree, const TightObject& object,
    openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds)
{
    const SphereTreeSettings& settings = tree.settings;
    const TightOptions& options = settings.tight();
    const SphereBudget& budget = options.budget;
    const LeafBalls& leaves = object.leaves;
    const LevelMaker& maker = object.maker;
    const std::size_t leafCount = leaves.balls.size();
    requireRoomForMerging(leafCount);
    const auto forest = detail::timed("merging", interrupter, &seconds->tree, [&] {
        // A detail of this stage: how far it is, the merging says.
        const auto model = detail::timed(
            "", interrupter, nullptr, [&] { return modelFor(options, leaves.balls, maker); });
        return mergeToRoots(*model, options.quality == Quality::Normal ? 8 : 6, interrupter);
    });
    std::optional<detail::LevelMeter> meter;
    if (budget.hasBound()) meter.emplace(object.grid, settings.dist());
    const auto cutError = [&](int64_t count) {
        return errorOf(levelsOf(forest, {count}, leaves.digital), tree, *meter, interrupter);
    };
    const auto counts = detail::timed("spheres within the bound", interrupter, &seconds->tree,
        [&] { return levelCounts(settings, int64_t(leafCount), tree.voxelSize(), cutError); });
    const bool search = options.quality == Quality::Best && options.cover == Cover::Voxels;
    // A bound is on the finest level, which then is searched first and by itself.
    const std::size_t middle = budget.hasBound() ? 0 : counts.size() / 2;
    const auto levels = detail::timed("levels", interrupter, &seconds->tree, [&] {
        const auto cuts = levelsOf(forest, counts, leaves.digital);
        if (!search) return cuts;
        // The search minimizes the sampled excess alone, and no distances: bounds may be lost.
        const auto searched = searchedLevels(forest, counts, leaves, middle, maker);
        return keepsBounds(searched.front(), tree, object.grid, interrupter) ? searched : cuts;
    });
    if (options.cuts) tree.cuts = cutsOf(forest, tree.flatAxis);
    return levels;
}

} // namespace

void appendTightTree(SphereTree& tree, const openvdb::BoolGrid& object, const SphereTree* given,
    openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds)
{
    const SphereTreeSettings& settings = tree.settings;
    const TightOptions& options = settings.tight();
    const SphereBudget& budget = options.budget;
    requireReachable(settings, tree.voxelSize());
    const FlatAxis flat(tree.flatAxis);
    const auto voxels = voxelsOf(object, flat);
    std::optional<MedialLevel> medial;
    if (!given) {
        LevelQueries queries;
        queries.memory = settings.memory;
        medial.emplace(*voxels, settings.dim, settings.dist(), interrupter, seconds, queries);
    }
    const auto layout = medial ? nullptr : std::make_unique<const LeafLayout>(*voxels);
    const SampledObject samples(medial ? medial->layout : *layout);
    const LeafBalls leaves = detail::timed("leaves", interrupter, &seconds->tree, [&] {
        const SampleLevel& sampled = samples.level(0);
        return medial ? medialLeaves(*medial, sampled, options.leaves, interrupter)
                      : givenLeaves(*given, flat, *voxels, sampled, interrupter);
    });
    const std::size_t leafCount = leaves.balls.size();
    const TightObject source{object, leaves,
        {samples, effortOf(options.quality, leafCount), settings.dim == 2, interrupter}};
    const auto counts = budget.counts(int64_t(leafCount));
    // Of given spheres levels are made by merging these.
    const bool areFew = !given && !budget.hasBound() && !options.cuts
        && options.cover == Cover::Voxels && counts.front() <= kFewSpheres
        && counts.front() < int64_t(leafCount);
    std::vector<TightLevel> levels;
    if (areFew) {
        levels = detail::timed("levels", interrupter, &seconds->tree,
            [&] { return fewLevels(counts, options.quality, source.maker); });
    }
    // Of objects with arms and legs a long search of merged leaf balls may end better.
    if (!areFew || options.quality == Quality::Best) {
        const auto merged = mergedLevels(tree, source, interrupter, seconds);
        levels = areFew ? betterOf(levels, merged, tree, interrupter) : merged;
    }
    appendLevels(
        options.cuts ? levels : monotone(levels, leafCount, tree, object, interrupter), tree);
}

} // namespace openvdb_spheretree::tight
