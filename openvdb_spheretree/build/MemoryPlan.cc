// SPDX-License-Identifier: Apache-2.0
#include "MemoryPlan.h"

#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/paper/TreeLevels.h>
#include <openvdb_spheretree/slab/LabelStream.h>
#include <openvdb_spheretree/tight/TightEstimate.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {

namespace {

/// @return the number with two digits that count.
std::string roughly(double number)
{
    const double unit = number > 0 ? std::pow(10.0, std::floor(std::log10(number)) - 1) : 1;
    detail::TextStream text;
    text << std::round(number / unit) * unit;
    return text.str();
}

/// How labels of that level keep to the memory.
/// @param kept  receives nothing; null if labels are not kept
void addLabels(const LeafLayout& layout, const SphereTreeSettings& settings,
    detail::LabelOffsets* kept, openvdb::util::NullInterrupter* interrupter, MemoryPlan& plan)
{
    slab::LabelStream stream(layout, settings.dim);
    if (kept) stream.keepOffsets(*kept);
    stream.setMemory(settings.memory);
    const slab::StreamPlan found = stream.plan(interrupter);
    plan.slabs = layout.slabCount();
    plan.needed = found.bytes;
    plan.slabsAtATime = std::min<int64_t>(found.slabs, plan.slabs);
    plan.packed = found.packed;
    plan.packedBytes = found.packedBytes;
    plan.storedBytes = found.storedBytes;
}

/// @return whether levels are made from leaf balls that nobody knows yet.
bool levelsAreGuessed(const SphereTreeSettings& settings)
{
    const auto* options = settings.find<TightOptions>();
    return options && options->leaves != Leaves::Given;
}

MemoryPlan tightPlan(const tight::TightEstimate& levels, const SphereTreeSettings& settings,
    openvdb::util::NullInterrupter* interrupter)
{
    MemoryPlan plan;
    plan.allowed = detail::allowedMemory(settings.memory);
    plan.leafBalls = int64_t(levels.leafBalls);
    plan.levelsBytes = levels.bytes;
    plan.levelsSeconds = levels.seconds;
    const bool fits = levels.leastBytes <= double(plan.allowed);
    if (!fits) tight::refuseTightTree(levels, settings, levels.leastBytes);
    try {
        addLabels(LeafLayout(*levels.labelled), settings, nullptr, interrupter, plan);
    } catch (const detail::MemoryError& tooLittle) {
        tight::refuseTightTree(levels, settings, tooLittle.needed());
    }
    return plan;
}

} // namespace

MemoryPlan memoryPlan(const openvdb::BoolGrid& object, const SphereTreeSettings& settings,
    openvdb::util::NullInterrupter* interrupter)
{
    const openvdb::MaskTree::ConstPtr voxels = voxelsOf(object, flatAxisOf(object, settings.dim));
    if (levelsAreGuessed(settings)) {
        LeafLayout::requireRoom(*voxels); // levels that are made on a coarse object end there, too
        return tightPlan(
            tight::estimateTightTree(voxels, settings, interrupter), settings, interrupter);
    }
    const LeafLayout layout(*voxels);
    MemoryPlan plan;
    plan.allowed = detail::allowedMemory(settings.memory);
    if (!settings.dist().isEuclidean()) { // norms have everything in memory, always
        plan.slabs = layout.slabCount();
        plan.needed = normBytes(layout);
        plan.slabsAtATime = plan.slabs;
        detail::requireAllowed(layout.leafCount(), plan.needed, plan.allowed);
        return plan;
    }
    detail::LabelOffsets offsets;
    const auto* options = settings.find<PyramidOptions>();
    const bool keepsOffsets = options && detail::needsDag(*options);
    addLabels(layout, settings, keepsOffsets ? &offsets : nullptr, interrupter, plan);
    return plan;
}

std::string toString(const MemoryPlan& plan)
{
    const auto gib = [](int64_t bytes) { return detail::asText(double(bytes)); };
    detail::TextStream text;
    text << "memory: " << gib(plan.allowed) << " allowed for power labels, at most "
         << gib(plan.needed) << " needed: " << plan.slabsAtATime << " of " << plan.slabs
         << " slabs at a time";
    if (plan.packed) {
        text << ", labels compressed: " << gib(plan.packedBytes) << " before compression; "
             << gib(plan.storedBytes) << " of compressed labels may stay in memory, what exceeds "
             << "that goes to a temporary file";
    }
    if (plan.leafBalls > 0) {
        text << "; levels from about " << roughly(double(plan.leafBalls)) << " leaf balls: about "
             << gib(int64_t(plan.levelsBytes)) << " and " << roughly(plan.levelsSeconds)
             << " s of one processor";
    }
    return text.str();
}

} // namespace openvdb_spheretree
