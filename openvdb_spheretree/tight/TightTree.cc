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
#include <openvdb_spheretree/tight/region/BallPruning.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>
#include <openvdb_spheretree/voxel/ObjectVoxels.h>

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

struct Effort {
    FitEffort fit;
    int neighbours; ///< of a ball that it may merge with
};

/// The balls of larger objects are larger: with the samples that suit 4,000 leaf balls, the time for
/// each ball of a larger object would grow.
int samplesFor(std::size_t leafBalls)
{
    constexpr double kMost = 40, kLeast = 16, kFew = 4000;
    return int(std::max(kLeast, std::min(kMost, kMost * std::sqrt(kFew / double(leafBalls)))));
}

Effort effortOf(Quality quality, std::size_t leafBalls)
{
    if (quality == Quality::Fast) return {{false, 4, 1, false, 16}, 6};
    if (quality == Quality::Best) return {{true, 12, 1, true, samplesFor(leafBalls)}, 6};
    return {{true, 12, 1, true, samplesFor(leafBalls)}, 8};
}

/// The leaf balls of the tree, in both forms.
struct LeafBalls {
    std::vector<MedialBall> medial;
    std::vector<ExactSphere> fine;
};

LeafBalls leafBallsOf(const MedialLevel& level, const SampledObject& object, Leaves which,
    openvdb::util::NullInterrupter* interrupter)
{
    LeafBalls leafBalls;
    if (which == Leaves::Pruned) {
        for (const int32_t i : prunedBalls(level.balls, object.level(0), interrupter)) {
            leafBalls.medial.push_back(level.balls[i]);
        }
    } else {
        leafBalls.medial = level.balls;
    }
    for (const MedialBall& ball : leafBalls.medial) leafBalls.fine.push_back(fineBall(ball));
    return leafBalls;
}

std::unique_ptr<MergeModel> modelFor(const TightOptions& options, bool flat,
    const SampledObject& object, const std::vector<ExactSphere>& leafBalls, const FitEffort& fit,
    openvdb::util::NullInterrupter* interrupter)
{
    if (options.cover == Cover::Balls) {
        return std::make_unique<StrictMerging>(
            object, leafBalls, heldBalls(leafBalls), fit, flat, interrupter);
    }
    if (options.quality == Quality::Fast) {
        return std::make_unique<StrictMerging>(object, leafBalls,
            heldVoxels(powerCellPoints(leafBalls, object.level(0), interrupter)), fit, flat,
            interrupter);
    }
    return std::make_unique<SlackMerging>(object, ungrouped(leafBalls),
        regionsOf(leafBalls, object.level(0), interrupter), fit, flat, interrupter);
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

/// The search minimizes the sampled excess alone, and not distances.
/// @return whether the finest level is still within the bounds that the tree has.
bool keepsBounds(const TightLevel& finest, const SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter)
{
    const SphereBudget& budget = tree.settings.tight().budget;
    if (!budget.hasBound()) return true;
    const TightLevel alone{finest.balls, {}, finest.digital};
    return isWithin(budget, tree.voxelSize(), errorOf({alone}, tree, object, interrupter));
}

/// Squared lengths in 1/16 voxel have to fit in 64 bits, here and in whoever reads the tree. Twice the
/// object's diagonal is longer than any that occurs.
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
    const TightOptions& options = settings.tight();
    const FlatAxis flat(tree.flatAxis);
    const auto voxels = voxelsOf(object, flat);
    LevelQueries queries;
    queries.memory = settings.memory;
    const MedialLevel level(*voxels, settings.dim, settings.dist(), interrupter, seconds, queries);
    const SampledObject samples(level.layout);
    const LeafBalls leafBalls = timed("leaves", interrupter, &seconds->tree,
        [&] { return leafBallsOf(level, samples, options.leaves, interrupter); });
    const Effort effort = effortOf(options.quality, leafBalls.fine.size());
    const auto forest = timed("merging", interrupter, &seconds->tree, [&] {
        const auto model =
            modelFor(options, settings.dim == 2, samples, leafBalls.fine, effort.fit, interrupter);
        return mergeToRoots(*model, effort.neighbours, interrupter);
    });
    const auto cutError = [&](int64_t count) {
        return errorOf(levelsOf(forest, {count}, leafBalls.medial), tree, object, interrupter);
    };
    const auto counts =
        levelCounts(options.budget, int64_t(leafBalls.fine.size()), tree.voxelSize(), cutError);
    const bool search = options.quality == Quality::Best && options.cover == Cover::Voxels;
    // A bound is on the finest level, which then is searched first and by itself.
    const std::size_t middle = options.budget.hasBound() ? 0 : counts.size() / 2;
    const auto levels = timed("levels", interrupter, &seconds->tree, [&] {
        const auto cuts = levelsOf(forest, counts, leafBalls.medial);
        if (!search) return cuts;
        const auto searched = searchedLevels(forest, counts, leafBalls.medial, middle, samples,
            effort.fit, settings.dim == 2, interrupter);
        return keepsBounds(searched.front(), tree, object, interrupter) ? searched : cuts;
    });
    appendLevels(levels, tree);
    if (options.cuts) tree.cuts = cutsOf(forest, tree.flatAxis);
}

} // namespace tight
} // namespace openvdb_spheretree
