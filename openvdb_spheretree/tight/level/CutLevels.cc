// SPDX-License-Identifier: Apache-2.0
#include "CutLevels.h"

#include "BoundedErrors.h"
#include "LevelCounts.h"
#include <openvdb_spheretree/base/StepProgress.h>
#include <openvdb_spheretree/measure/LevelMeter.h>
#include <openvdb_spheretree/tight/merge/MergeForest.h>
#include <openvdb_spheretree/tight/merge/SlackMerging.h>
#include <openvdb_spheretree/tight/merge/StrictMerging.h>
#include <openvdb_spheretree/tight/region/PowerCells.h>
#include <openvdb_spheretree/tight/region/VoxelRegion.h>

#include <memory>
#include <optional>
#include <utility>

namespace openvdb_spheretree::tight {

namespace {

std::unique_ptr<MergeModel> modelFor(
    const TightOptions& options, const LeafBalls& leaves, const LevelMaker& maker)
{
    const std::vector<ExactSphere>& leafBalls = leaves.balls;
    const bool areInside = !leaves.digital.empty(); // given ones may reach out of the object
    const SampledObject& object = maker.object;
    const auto interrupter = maker.interrupter;
    const SampleLevel& voxels = object.level(0);
    if (options.cover == Cover::Balls) {
        return std::make_unique<StrictMerging>(object, ungrouped(leafBalls),
            heldBalls(leafBalls, areInside), maker.fit, maker.flat, interrupter);
    }
    if (options.quality == Quality::Fast) {
        auto held = heldVoxels(powerCellPoints(leafBalls, voxels, interrupter), areInside);
        return std::make_unique<StrictMerging>(
            object, ungrouped(leafBalls), std::move(held), maker.fit, maker.flat, interrupter);
    }
    return std::make_unique<SlackMerging>(object, ungrouped(leafBalls),
        regionsOf(leafBalls, voxels, interrupter), maker.fit, maker.flat, interrupter, areInside);
}

} // namespace

std::vector<TightLevel> cutLevels(SphereTree& tree, const openvdb::BoolGrid& object,
    const LeafBalls& leaves, const LevelMaker& maker)
{
    const TightOptions& options = tree.settings.tight();
    maker.interrupter->expect(1);
    const auto model = modelFor(options, leaves, maker);
    const auto forest = [&] {
        const detail::Step step(maker.interrupter, 1);
        const int neighbours = options.quality == Quality::Fast ? 6 : 8;
        return mergeToRoots(*model, neighbours, maker.interrupter);
    }();
    std::optional<detail::LevelMeter> meter;
    if (options.budget.hasBound()) meter.emplace(object, tree.settings.dist());
    const auto counts = levelCounts(
        tree.settings, int64_t(leaves.balls.size()), tree.voxelSize(), [&](int64_t count) {
            const auto level = levelsOf(forest, {count}, leaves.digital).front();
            return errorOf(level, tree, *meter, maker.interrupter);
        });
    if (options.cuts) tree.cuts = cutsOf(forest, tree.flatAxis);
    return levelsOf(forest, counts, leaves.digital);
}

} // namespace openvdb_spheretree::tight
