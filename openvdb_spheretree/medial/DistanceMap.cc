// SPDX-License-Identifier: Apache-2.0
#include "DistanceMap.h"

#include "NormSweep.h"
#include <openvdb_spheretree/base/AtomicExtremes.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/kernel/LargestValue.h>
#include <openvdb_spheretree/kernel/LeafTranspose.h>
#include <openvdb_spheretree/kernel/MinPlus.h>
#include <openvdb_spheretree/slab/LargestRadius.h>
#include <openvdb_spheretree/slab/SlabDistance.h>
#include <openvdb_spheretree/voxel/Dimension.h>

#include <hwy/cache_control.h>

#include <atomic>

namespace openvdb_spheretree {

namespace {

using openvdb::util::NullInterrupter;

/// @tparam T  computes
/// @return the largest value; the values are exact if it is below kNarrowMax (kWideMax).
template <typename T, typename Value>
uint32_t transform(const LeafLayout& layout, int dim, Value* values, NullInterrupter* interrupter)
{
    const slab::XGaps<slab::GapOf<T>> gaps(layout, interrupter);
    using Slab = slab::SlabDistance<T>;
    std::atomic<uint32_t> largest{0};
    detail::parallelForWithScratch<Slab>(
        layout.slabCount(), interrupter, [&](std::size_t index, Slab& distances) {
            const auto store = [&](const LeafLayout::Run& run, const T* rows) {
                const std::size_t size = std::size_t(run.count) * kLeafVoxels;
                detail::raiseTo(largest, detail::largestValue(rows, size));
                for (uint32_t i = 0; i < run.count; ++i, rows += kLeafVoxels) {
                    Value* leaf = values + std::size_t(run.leaves[i]) * kLeafVoxels;
                    if (dim == 3) detail::streamRowsZToLeaf(rows, leaf);
                    else detail::rowsToLeafAs(Axis::Y, rows, leaf);
                }
            };
            distances.forEachRun(layout, uint32_t(index), gaps, dim, store);
            hwy::FlushStream(); // what went past the cache is there for other threads
        });
    return largest;
}

/// In 32 bits, where 16 are not enough.
uint32_t wideTransform(
    const LeafLayout& layout, int dim, uint32_t* values, NullInterrupter* interrupter)
{
    const uint32_t largest = transform<uint32_t>(layout, dim, values, interrupter);
    slab::requireWide(largest);
    return largest;
}

uint32_t largestOf(const LeafLayout& layout, const uint32_t* values, NullInterrupter* interrupter)
{
    std::atomic<uint32_t> largest{0};
    detail::parallelFor(layout.slabCount(), interrupter, [&](std::size_t index) {
        const LeafLayout::Slab slab = layout.slab(uint32_t(index));
        const uint32_t* first = values + std::size_t(slab.begin) * kLeafVoxels;
        const std::size_t size = std::size_t(slab.size()) * kLeafVoxels;
        detail::raiseTo(largest, detail::largestValue(first, size));
    });
    return largest;
}

} // namespace

DistanceMap distanceTransform(
    const LeafLayout& layout, int dim, const Distance& distance, NullInterrupter* interrupter)
{
    const std::size_t size = std::size_t(layout.leafCount()) * kLeafVoxels;
    requireDim(dim);
    DistanceMap map;
    map.mDistance = distance;
    if (!distance.isEuclidean()) {
        detail::requireMemory(layout.leafCount(), kLeafVoxels * 2 * sizeof(uint32_t) + 128);
        map.mWide = detail::makeLargeArray<uint32_t>(size);
        detail::NormSweep(layout, distance, dim, interrupter).distances(map.mWide.get());
        map.mLargest = largestOf(layout, map.mWide.get(), interrupter);
        constexpr uint32_t kLargestRoot = 46340; // balls of a norm have squared radii too
        if (map.mLargest < kLargestRoot) return map;
        OPENVDB_THROW(openvdb::ValueError,
            "the object holds a ball of " << kLargestRoot / uint32_t(distance.unit())
                                          << " voxels radius or more, whose square does not fit 32 "
                                             "bits with dist="
                                          << toString(distance)
                                          << ": use a larger voxel, or smaller "
                                             "weights");
    }
    map.mNarrow = detail::makeLargeArray<uint16_t>(size);
    map.mLargest = transform<uint16_t>(layout, dim, map.mNarrow.get(), interrupter);
    if (map.mLargest < detail::kNarrowMax) return map;
    map.mNarrow.reset();
    map.mWide = detail::makeLargeArray<uint32_t>(size);
    map.mLargest = wideTransform(layout, dim, map.mWide.get(), interrupter);
    return map;
}

uint32_t distanceTransform(
    const LeafLayout& layout, int32_t* values, int dim, NullInterrupter* interrupter)
{
    requireDim(dim);
    if (reinterpret_cast<std::uintptr_t>(values) % 16 != 0) {
        OPENVDB_THROW(openvdb::ValueError, "distances go to memory that is aligned to 16 bytes");
    }
    const uint32_t largest = transform<uint16_t>(layout, dim, values, interrupter);
    if (largest < detail::kNarrowMax) return largest;
    return wideTransform(layout, dim, reinterpret_cast<uint32_t*>(values), interrupter);
}

} // namespace openvdb_spheretree
