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

} // namespace

MemoryPlan memoryPlan(const openvdb::BoolGrid& object, const SphereTreeSettings& settings,
    openvdb::util::NullInterrupter* interrupter)
{
    const openvdb::MaskTree::ConstPtr voxels = voxelsOf(object, flatAxisOf(object, settings.dim));
    const LeafLayout layout(*voxels);
    MemoryPlan plan;
    plan.allowed = detail::allowedMemory(settings.memory);
    plan.slabs = layout.slabCount();
    if (!settings.dist().isEuclidean()) { // norms have everything in memory, always
        plan.needed = normBytes(layout);
        plan.slabsAtATime = plan.slabs;
        detail::requireAllowed(layout.leafCount(), plan.needed, plan.allowed);
        return plan;
    }
    slab::LabelStream stream(layout, settings.dim);
    detail::LabelOffsets offsets;
    const auto* options = settings.find<PyramidOptions>();
    if (options && detail::needsDag(*options)) stream.keepOffsets(offsets);
    stream.setMemory(settings.memory);
    const slab::StreamPlan found = stream.plan(interrupter);
    plan.needed = found.bytes;
    plan.slabsAtATime = std::min<int64_t>(found.slabs, plan.slabs);
    plan.packed = found.packed;
    plan.packedBytes = found.packedBytes;
    plan.storedBytes = found.storedBytes;
    const auto* tightOptions = settings.find<TightOptions>();
    if (tightOptions && tightOptions->leaves != Leaves::Given) {
        const auto levels = tight::estimateTightTree(voxels, settings, interrupter);
        plan.leafBalls = int64_t(levels.leafBalls);
        plan.levelsBytes = levels.bytes;
        plan.levelsSeconds = levels.seconds;
    }
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
