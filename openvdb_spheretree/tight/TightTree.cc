// SPDX-License-Identifier: Apache-2.0
#include "TightTree.h"

#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/base/StepProgress.h>
#include <openvdb_spheretree/measure/LevelMeter.h>
#include <openvdb_spheretree/tight/TightEstimate.h>
#include <openvdb_spheretree/tight/level/BottomUpLevels.h>
#include <openvdb_spheretree/tight/level/BoundedErrors.h>
#include <openvdb_spheretree/tight/level/CarriedLevels.h>
#include <openvdb_spheretree/tight/level/CutLevels.h>
#include <openvdb_spheretree/tight/level/FewLevels.h>
#include <openvdb_spheretree/tight/level/FollowedLevels.h>
#include <openvdb_spheretree/tight/level/FreeCovers.h>
#include <openvdb_spheretree/tight/level/LevelCounts.h>
#include <openvdb_spheretree/tight/level/LevelWork.h>
#include <openvdb_spheretree/tight/level/MonotoneLevels.h>
#include <openvdb_spheretree/tight/level/TightLevels.h>
#include <openvdb_spheretree/tight/region/CoarseObject.h>
#include <openvdb_spheretree/tight/region/LeafBalls.h>
#include <openvdb_spheretree/tight/region/WorkingMemory.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <optional>
#include <string>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

/// @throw detail::MemoryError with what all of the tree needs, if leastAllowed() is more than is
/// allowed, or what labels of a level of the pyramid need
CoarseObject coarseObjectWithin(const openvdb::MaskTree::ConstPtr& voxels,
    const SphereTreeSettings& settings, openvdb::util::NullInterrupter* interrupter,
    StageSeconds* seconds)
{
    const WorkingMemory least = leastAllowed(settings, std::size_t(detail::leafNodesOf(*voxels)));
    double needed = least.bytes;
    if (least.fits(settings.memory)) {
        try {
            return coarseObject(voxels, settings, sizeFor(settings.tight()), interrupter, seconds);
        } catch (const detail::MemoryError& tooLittle) { // of a level that is not the last one
            needed = tooLittle.needed();
        }
    }
    refuseTightTree(estimateTightTree(voxels, settings, interrupter), settings, needed);
}

/// @throw detail::MemoryError if making levels from the leaf balls needs more memory than there may
/// be
void requireRoom(const CoarseObject& coarse, bool withRegions, int64_t memory,
    openvdb::util::NullInterrupter* interrupter)
{
    const detail::Stage stage("memory", interrupter, nullptr);
    const std::vector<ExactSphere>& leafBalls = coarse.leaves.balls;
    const std::size_t leafNodes = coarse.samples.level(0).leafCount();
    WorkingMemory needed;
    needed.addSamples(leafNodes, coarse.samples.dim()).addMerging(leafBalls.size());
    if (withRegions) needed.addRegions(leafBalls, coarse.samples.level(0), interrupter);
    needed.require(memory,
        "the regions and neighbours of " + std::to_string(leafBalls.size()) + " leaf balls");
}

/// The object, and the leaf balls that its levels are made from.
struct TightSource {
    const openvdb::BoolGrid& object;
    const LeafBalls& leaves;
    const LevelMaker& maker;
};

/// @return the finest level of a tree: all leaf balls, or the fewest balls within the bounds.
/// @param counts  receives those of all levels
TightLevel finestLevel(const SphereTree& tree, const TightSource& source, FreeCovers& free,
    std::vector<int64_t>& counts)
{
    const openvdb::BoolGrid& object = source.object;
    const LeafBalls& leaves = source.leaves;
    const LevelMaker& maker = source.maker;
    const LevelWork work(maker);
    const auto leafCount = int64_t(leaves.balls.size());
    // With how few balls a search for a bound ends, nobody knows.
    const bool hasBound = tree.settings.tight().budget.hasBound();
    if (hasBound) maker.interrupter->expect(2 * work.ofFreeCover(leafCount, 1));
    const auto levelOf = [&](int64_t count) -> TightLevel {
        if (count == leafCount) return {leaves.balls, {}, leaves.digital};
        return {free.cover(count), {}, {}};
    };
    std::optional<detail::LevelMeter> meter;
    if (hasBound) meter.emplace(object, tree.settings.dist());
    counts = levelCounts(tree.settings, leafCount, tree.voxelSize(), [&](int64_t count) {
        return errorOf(levelOf(count), tree, *meter, source.maker.interrupter);
    });
    const TightLevel level = levelOf(counts.front());
    maker.interrupter->expect(work.ofSearches(counts.front()) + work.fromBottom(counts));
    if (counts.front() == leafCount || !maker.searchesLevelOf(level.balls.size())) return level;
    // The search minimizes the sampled excess alone, and no distances: bounds may be lost.
    const TightLevel searched{free.searched(counts.front()), {}, {}};
    return keepsBounds(searched, tree, object, maker.interrupter) ? searched : level;
}

/// Levels on top of a finest one that is not chosen freely.
std::vector<TightLevel> levelsOnFinest(const SphereTree& tree, const TightSource& source)
{
    const LevelMaker& maker = source.maker;
    FreeCovers free(source.leaves.balls, !source.leaves.digital.empty(), maker);
    std::vector<int64_t> counts;
    const TightLevel finest = finestLevel(tree, source, free, counts);
    return bottomUpLevels(finest, counts, maker);
}

/// Levels of named counts: made where the pyramid suits them, and carried down to the object.
std::vector<TightLevel> levelsOfCounts(const SphereTree& tree, const CoarseObject& coarse,
    const TightStart& start, const LevelMaker& maker)
{
    const SphereTreeSettings& settings = tree.settings;
    const TightOptions& options = settings.tight();
    const std::vector<ExactSphere>& leafBalls = coarse.leaves.balls;
    FreeCovers free(leafBalls, !coarse.leaves.digital.empty(), maker);
    // A coarse level may have fewer leaf balls than the object.
    const bool onObject = coarse.steps.empty();
    auto counts = options.budget.counts(onObject ? int64_t(leafBalls.size()) : INT64_MAX);
    const int64_t most = counts.front();
    maker.interrupter->expect(LevelWork(maker).ofCounts(int64_t(leafBalls.size()), counts,
        options.quality, coarse.leafNodesBelow(coarse.steps.size())));
    if (!onObject) counts.front() += moreOnCoarse(most);
    if (start.last) {
        const LevelWork onFinest(maker, std::size_t(detail::leafNodesOf(*coarse.levels.front())));
        for (const int64_t count : counts) maker.interrupter->expect(onFinest.ofPlacing(count));
    }
    // Of many balls the finest level is the better the less it is bound to, so it comes first.
    auto levels = most <= kFewBalls
        ? fewLevels(counts, free, start.given == nullptr, options.quality, maker)
        : bottomUpLevels({free.searched(counts.front()), {}, {}}, counts, maker);
    std::optional<SampledObject> finer;
    for (std::size_t step = coarse.steps.size(); step-- > 0;) {
        detail::timed("", maker.interrupter, nullptr, [&] {
            finer.emplace(LeafLayout(*coarse.levels[step]), settings.dim == 2, maker.interrupter);
        });
        levels =
            carriedDown(std::move(levels), coarse.steps[step], step == 0 ? most : counts.front(),
                levelMakerFor(settings, *finer, leafBalls.size(), maker.interrupter));
    }
    if (!start.last) return levels;
    return followedLevels(*start.last, tree, levels,
        levelMakerFor(
            settings, finer ? *finer : coarse.samples, leafBalls.size(), maker.interrupter));
}

/// @return the object with the given leaf balls.
CoarseObject objectOf(const SphereTree& given, const FlatAxis& flat,
    const openvdb::MaskTree::ConstPtr& voxels, openvdb::util::NullInterrupter* interrupter)
{
    CoarseObject object;
    object.levels.push_back(voxels);
    object.samples = detail::timed("leaves", interrupter, nullptr,
        [&] { return SampledObject(LeafLayout(*voxels), given.settings.dim == 2, interrupter); });
    object.leaves = givenLeaves(given, flat, *voxels, object.samples.level(0), interrupter);
    return object;
}

} // namespace

void appendTightTree(SphereTree& tree, const openvdb::BoolGrid& object, const TightStart& start,
    openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds)
{
    const SphereTreeSettings& settings = tree.settings;
    const TightOptions& options = settings.tight();
    requireReachable(settings, tree.voxelSize());
    const FlatAxis flat(tree.flatAxis);
    const openvdb::MaskTree::ConstPtr voxels = voxelsOf(object, flat);
    LeafLayout::requireRoom(*voxels); // levels that are made on a coarse object end here, too
    const CoarseObject coarse = start.given
        ? objectOf(*start.given, flat, voxels, interrupter)
        : coarseObjectWithin(voxels, settings, interrupter, seconds);
    const LeafBalls& leaves = coarse.leaves;
    const bool onObject = coarse.steps.empty();
    const auto leafCount = int64_t(leaves.balls.size());
    const bool allLeaves = onObject && !options.budget.hasBound()
        && options.budget.counts(leafCount).front() == leafCount;
    requireRoom(coarse, makesLeafRegions(options, allLeaves), settings.memory, interrupter);
    const auto levels = detail::timed("levels", interrupter, &seconds->tree, [&] {
        detail::StepProgress progress(interrupter);
        const LevelMaker maker =
            levelMakerFor(settings, coarse.samples, leaves.balls.size(), &progress);
        const TightSource source{object, leaves, maker};
        if (options.cuts || options.cover == Cover::Balls)
            return cutLevels(tree, object, leaves, maker);
        return allLeaves || options.budget.hasBound() ? levelsOnFinest(tree, source)
                                                      : levelsOfCounts(tree, coarse, start, maker);
    });
    const std::size_t kept = onObject ? leaves.balls.size() : 0;
    appendLevels(
        options.cuts ? levels : monotoneLevels(levels, kept, tree, object, interrupter), tree);
}

} // namespace openvdb_spheretree::tight
