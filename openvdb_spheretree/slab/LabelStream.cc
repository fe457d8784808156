// SPDX-License-Identifier: Apache-2.0
#include "LabelStream.h"

#include "LargestRadius.h"
#include "PackedStream.h"
#include "WindowStream.h"
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/voxel/Dimension.h>

#include <tbb/task_arena.h>

namespace openvdb_spheretree::slab {

using detail::NarrowPower;
using detail::WidePower;
using openvdb::util::NullInterrupter;

namespace {

bool isNarrow(uint32_t largestDistSq) { return largestDistSq <= NarrowPower::kMaxRadiusSq; }

} // namespace

template <typename Power, typename T>
StreamMemory LabelStream::memory() const
{
    constexpr int64_t kKey = sizeof(typename Power::Key), kOffset = sizeof(typename Power::Offset);
    const int64_t leaves = mLayout.leafCount();
    const int64_t kept = mKept ? kLeafVoxels * mDim * kOffset : 0;
    const int64_t queries = mQueried && !mQueried->empty() ? 2 * sizeof(uint32_t) : 0;
    StreamMemory memory;
    memory.fixed = mLayout.bytes() + leaves * (int64_t(sizeof(LeafMask)) + kept + queries);
    memory.gaps = leaves * 2 * 64 * int64_t(sizeof(GapOf<T>));
    // Rows of SlabDistance and SlabPower; radii, of half a key, and offsets of SlabBalls.
    memory.scratch = kLeafVoxels * (int64_t(sizeof(T)) + kKey + 2 * (kKey / 2) + kOffset);
    memory.labels = kLeafVoxels * (kKey + (mKept ? 0 : (mDim - 1) * kOffset));
    memory.keys = kLeafVoxels * kKey;
    memory.packed = kLeafVoxels * int64_t(sizeof(PackedLabel<Power>));
    return memory;
}

StreamMemory LabelStream::memoryFor(uint32_t largestDistSq) const
{
    return isNarrow(largestDistSq) ? memory<NarrowPower, uint16_t>()
                                   : memory<WidePower, uint32_t>();
}

StreamPlan LabelStream::planFor(uint32_t largestDistSq) const
{
    if (mPlan) return *mPlan;
    return planWithin(mLayout, memoryFor(largestDistSq), largestDistSq,
        detail::allowedMemory(mMemory), uint32_t(tbb::this_task_arena::max_concurrency()));
}

int64_t LabelStream::enoughBytes() const
{
    return leastBytes(mLayout, memory<WidePower, uint32_t>());
}

uint32_t LabelStream::largest(NullInterrupter* interrupter) const
{
    requireDim(mDim);
    const StreamPlan least = planFor(0); // throws where even small balls have too little memory
    const uint32_t distSq = largestDistSq(mLayout, mDim, least.threads, interrupter);
    requireRadius(distSq);
    return distSq;
}

StreamPlan LabelStream::plan(NullInterrupter* interrupter) const
{
    return planFor(largest(interrupter));
}

template <typename Power, typename T>
LevelBalls LabelStream::runWith(const StreamPlan& plan, NullInterrupter* interrupter)
{
    KeptOffsets<Power> kept{};
    for (int axis = 0; mKept && axis < mDim; ++axis) {
        kept[axis] = (*mKept)[axis].template make<typename Power::Offset>(
            std::size_t(mLayout.leafCount()) * kLeafVoxels);
    }
    StreamWork<Power, T> work(mLayout, mDim, mQueried, kept, interrupter);
    if (plan.packed) PackedStream<Power, T>(work, plan).run();
    else WindowStream<Power, T>(work, plan.slabs, plan.threads).run();
    return work.collected();
}

LevelBalls LabelStream::run(NullInterrupter* interrupter)
{
    const uint32_t distSq = largest(interrupter);
    const StreamPlan plan = planFor(distSq);
    return isNarrow(distSq) ? runWith<NarrowPower, uint16_t>(plan, interrupter)
                            : runWith<WidePower, uint32_t>(plan, interrupter);
}

} // namespace openvdb_spheretree::slab
