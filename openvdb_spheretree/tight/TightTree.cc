// SPDX-License-Identifier: Apache-2.0
#include "TightTree.h"

#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/tight/level/LevelCounts.h>
#include <openvdb_spheretree/tight/level/SearchedLevels.h>
#include <openvdb_spheretree/tight/level/TightLevels.h>
#include <openvdb_spheretree/tight/merge/MergeForest.h>
#include <openvdb_spheretree/tight/merge/SlackMerging.h>
#include <openvdb_spheretree/tight/merge/StrictMerging.h>
#include <openvdb_spheretree/tight/region/LeafPruning.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

namespace openvdb_spheretree {
namespace tight {

namespace {

using detail::timed;

/// How much a quality looks at.
struct Effort {
    FitEffort fit;
    int neighbours;
};

/// Large objects have large balls where small ones have small ones: what is fine for 4,000 leaves is
/// too fine for more of them, or the time for a leaf would grow.
int samplesFor(std::size_t leaves)
{
    constexpr double kMost = 40, kLeast = 16, kFew = 4000;
    return int(std::max(kLeast, std::min(kMost, kMost * std::sqrt(kFew / double(leaves)))));
}

Effort effortOf(Quality quality, std::size_t leaves)
{
    if (quality == Quality::Fast) return {{false, 4, 1, false, 16}, 6};
    if (quality == Quality::Best) return {{true, 12, 1, true, samplesFor(leaves)}, 6};
    return {{true, 12, 1, true, samplesFor(leaves)}, 8};
}

/// The leaves of the tree, as medial balls and as the balls they are.
struct TreeLeaves {
    std::vector<MedialBall> medial;
    std::vector<FineBall> balls;
};

TreeLeaves leavesOf(const MedialLevel& level, const SampledObject& object, Leaves which,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<int32_t> kept(level.balls.size());
    std::iota(kept.begin(), kept.end(), 0);
    if (which == Leaves::Pruned) kept = prunedLeaves(level.balls, object.level(0), interrupter);
    TreeLeaves leaves;
    for (const int32_t i : kept) {
        leaves.medial.push_back(level.balls[i]);
        leaves.balls.push_back(fineBall(level.balls[i]));
    }
    return leaves;
}

std::unique_ptr<MergeModel> modelFor(const SphereTreeSettings& settings,
    const SampledObject& object, const std::vector<FineBall>& leaves, const FitEffort& fit,
    openvdb::util::NullInterrupter* interrupter)
{
    const bool flat = settings.dim == 2;
    if (settings.cover == Cover::Balls) {
        return std::make_unique<StrictMerging>(
            object, leaves, heldBalls(leaves), fit, flat, interrupter);
    }
    if (settings.quality == Quality::Fast) {
        return std::make_unique<StrictMerging>(object, leaves,
            heldVoxels(cellPoints(leaves, object.level(0), interrupter)), fit, flat, interrupter);
    }
    return std::make_unique<SlackMerging>(object, ungrouped(leaves),
        regionsOf(leaves, object.level(0), interrupter), fit, flat, interrupter);
}

/// @param tree  with settings, object and transform
LevelError errorOf(const std::vector<TightLevel>& level, SphereTree tree,
    const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter)
{
    appendLevels(level, tree);
    computeLevelErrors(tree, object, interrupter);
    const SphereTreeLevel& only = tree.levels.front();
    if (only.error) return *only.error;
    OPENVDB_THROW(openvdb::ValueError,
        "the error of " << only.size() << " spheres is not known, so no bound on it can be kept: "
                        << only.errorUnknown << "; ask for spheres= instead");
}

/// The search looks at sampled excess alone, and not at distances.
/// @return whether the finest level is still within the bounds that the tree has.
bool keepsBounds(const TightLevel& finest, const SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter)
{
    const SphereBudget& budget = tree.settings.budget;
    if (!budget.hasBound()) return true;
    const TightLevel alone{finest.balls, {}, finest.digital};
    return isWithin(budget, tree.voxelSize(), errorOf({alone}, tree, object, interrupter));
}

/// Squares of 1/16 voxel have 64 bits, here and in whoever reads the tree.
void requireRoom(const SphereTree& tree)
{
    const openvdb::Coord size = tree.object.bbox.extents();
    constexpr int64_t kMost = int64_t(1) << 61;
    const auto far = [&](int axis) { return 2 * kFine * (int64_t(size[axis]) + 1); };
    if (Distance().lengthSq(far(0), far(1), far(2)) < kMost) return;
    OPENVDB_THROW(openvdb::ValueError,
        "the object '" << tree.object.name << "', of " << size[0] << " x " << size[1] << " x "
                       << size[2]
                       << " voxels, is too wide for tree=tight: use tree=extended, or larger "
                          "voxels");
}

} // namespace

void appendTightTree(SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds)
{
    requireRoom(tree);
    const SphereTreeSettings& settings = tree.settings;
    const FlatAxis flat(settings.flatAxis);
    const auto voxels = flat.toZ(
        std::make_shared<openvdb::MaskTree>(object.tree(), false, openvdb::TopologyCopy()));
    LevelWants wants;
    wants.memory = settings.memory;
    const MedialLevel level(*voxels, settings.dim, settings.dist, interrupter, seconds, wants);
    const SampledObject samples(level.layout);
    const TreeLeaves leaves = timed("leaves", interrupter, &seconds->tree,
        [&] { return leavesOf(level, samples, settings.leaves, interrupter); });
    const Effort effort = effortOf(settings.quality, leaves.balls.size());
    const auto forest = timed("merging", interrupter, &seconds->tree, [&] {
        const auto model = modelFor(settings, samples, leaves.balls, effort.fit, interrupter);
        return mergeToRoots(*model, effort.neighbours, interrupter);
    });
    const auto cutError = [&](int64_t count) {
        return errorOf(levelsOf(forest, {count}, leaves.medial), tree, object, interrupter);
    };
    const auto counts =
        levelCounts(settings.budget, int64_t(leaves.balls.size()), tree.voxelSize(), cutError);
    const bool search = settings.quality == Quality::Best && settings.cover == Cover::Voxels;
    // A bound is one of the finest level, which then must not be bound to others.
    const std::size_t middle = settings.budget.hasBound() ? 0 : counts.size() / 2;
    const auto levels = timed("levels", interrupter, &seconds->tree, [&] {
        const auto cuts = levelsOf(forest, counts, leaves.medial);
        if (!search) return cuts;
        const auto searched = searchedLevels(forest, counts, leaves.medial, middle, samples,
            effort.fit, settings.dim == 2, interrupter);
        return keepsBounds(searched.front(), tree, object, interrupter) ? searched : cuts;
    });
    appendLevels(levels, tree);
    if (settings.cuts) tree.cuts = cutsOf(forest, settings);
}

} // namespace tight
} // namespace openvdb_spheretree
