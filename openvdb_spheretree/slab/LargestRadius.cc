// SPDX-License-Identifier: Apache-2.0
#include "LargestRadius.h"

#include "SlabDistance.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/kernel/LargestValue.h>
#include <openvdb_spheretree/kernel/MaxPlus.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/Exceptions.h>
#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <vector>

namespace openvdb_spheretree::slab {

namespace {

using openvdb::util::NullInterrupter;

/// A voxel is no farther from the background than half of the shortest run through its leaf.
uint64_t boundByRuns(const LeafLayout& layout, int dim)
{
    std::vector<uint32_t> shortest(layout.leafCount(), UINT32_MAX);
    for (int axis = 0; axis < dim; ++axis) {
        for (uint32_t i = 0; i < layout.runCount(Axis(axis)); ++i) {
            const LeafLayout::Run run = layout.run(Axis(axis), i);
            for (uint32_t k = 0; k < run.count; ++k) {
                uint32_t& leaves = shortest[run.leaves[k]];
                leaves = std::min(leaves, run.count);
            }
        }
    }
    const auto most = std::max_element(shortest.begin(), shortest.end());
    const uint64_t leaves = most == shortest.end() ? 0 : *most;
    const uint64_t farthest = (leaves * kLeafDim + 1) / 2;
    return farthest * farthest;
}

template <typename T>
uint32_t largest(const LeafLayout& layout, int dim, uint32_t threads, NullInterrupter* interrupter)
{
    const XGaps<GapOf<T>> gaps(layout, interrupter);
    std::vector<uint32_t> ofSlab(layout.slabCount(), 0);
    std::vector<SlabDistance<T>> distances(threads);
    detail::parallelForWithSlots(
        layout.slabCount(), threads, interrupter, [&](std::size_t slab, std::size_t slot) {
            distances[slot].forEachRun(
                layout, uint32_t(slab), gaps, dim, [&](const LeafLayout::Run& run, const T* rows) {
                    const std::size_t count = std::size_t(run.count) * kLeafVoxels;
                    ofSlab[slab] = std::max(ofSlab[slab], detail::largestValue(rows, count));
                });
        });
    return ofSlab.empty() ? 0 : *std::max_element(ofSlab.begin(), ofSlab.end());
}

/// A place without a leaf has nothing but background. If the nearest one is d leaves away,
/// background is no more than 8 d voxels away.
uint64_t boundByLeaves(
    const LeafLayout& layout, int dim, uint32_t threads, NullInterrupter* interrupter)
{
    openvdb::MaskTree leaves(false);
    openvdb::tree::ValueAccessor<openvdb::MaskTree> places(leaves);
    for (uint32_t leaf = 0; leaf < layout.leafCount(); ++leaf) {
        places.setValueOn(layout.origin(leaf) >> 3);
    }
    const uint32_t distSq = largest<uint16_t>(LeafLayout(leaves), dim, threads, interrupter);
    return distSq < detail::kNarrowMax ? uint64_t(distSq) * kLeafDim * kLeafDim : UINT64_MAX;
}

} // namespace

uint32_t largestDistSq(
    const LeafLayout& layout, int dim, uint32_t threads, NullInterrupter* interrupter)
{
    const uint64_t bound = boundByRuns(layout, dim);
    if (bound <= detail::NarrowPower::kMaxRadiusSq) return uint32_t(bound);
    const uint64_t closer = boundByLeaves(layout, dim, threads, interrupter);
    if (closer <= detail::NarrowPower::kMaxRadiusSq) return uint32_t(closer);
    const uint32_t narrow = largest<uint16_t>(layout, dim, threads, interrupter);
    if (narrow < detail::kNarrowMax) return narrow;
    const uint32_t wide = largest<uint32_t>(layout, dim, threads, interrupter);
    requireWide(wide);
    return wide;
}

void requireWide(uint32_t distSq)
{
    if (distSq < detail::kWideMax) return;
    OPENVDB_THROW(openvdb::ValueError,
        "the object holds a ball of 46340 voxels radius or more, whose "
        "square does not fit 32 bits: use a larger voxel");
}

void requireRadius(uint32_t distSq)
{
    if (distSq <= detail::WidePower::kMaxRadiusSq) return;
    OPENVDB_THROW(openvdb::ValueError,
        "the object holds a ball of more than 32767 voxels radius, "
        "beyond what power labels hold: use a larger voxel");
}

} // namespace openvdb_spheretree::slab
