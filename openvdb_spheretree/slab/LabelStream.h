// SPDX-License-Identifier: Apache-2.0
/// @file LabelStream.h
/// @brief From voxels to power labels and medial balls, slab by slab, within a bound on memory.
///
/// Distances, and the passes of the labels along z and y, stay within a slab. The pass along x
/// needs all slabs that a ball may reach. If these are few, as in most objects, a window of slabs
/// is in memory (WindowStream.h). If they are too many, labels wait compressed, in memory or in a
/// temporary file (PackedStream.h). The result does not depend on the memory, nor on threads.

#pragma once

#include "SlabLabels.h"
#include "LabelQueries.h"
#include "StreamPlan.h"
#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/MedialBall.h>
#include <openvdb_spheretree/voxel/VoxelRef.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace openvdb_spheretree::slab {

/// The medial balls of a level.
struct LevelBalls {
    std::vector<MedialBall> balls; ///< ordered by center
    std::vector<LeafMask> centers; ///< of the balls, a mask for each leaf
    StageSeconds seconds;          ///< of distances, power labels and balls
};

class LabelStream {
public:
    /// @param layout  kept by reference
    /// @param dim     3, or 2 to leave the z axis out
    LabelStream(const LeafLayout& layout, int dim) : mLayout(layout), mDim(dim) {}

    /// @param voxels  of the object: run() makes each of them its label; those in kNoLeaf stay
    void query(std::vector<VoxelRef>& voxels) { mQueried = &voxels; }
    /// @param offsets  receives the labels of all voxels
    void keepOffsets(detail::LabelOffsets& offsets) { mKept = &offsets; }
    /// @param bytes  as SphereTreeSettings::memory, layout and what is kept included
    void setMemory(int64_t bytes) { mMemory = bytes; }
    /// @param plan  in place of the one that suits the memory
    void setPlan(const StreamPlan& plan) { mPlan = plan; }

    /// @return how run() will work.
    /// @throw as run()
    StreamPlan plan(openvdb::util::NullInterrupter* interrupter) const;

    /// @return bytes with which run() works whatever the radii are: those of packed labels, on one thread.
    int64_t enoughBytes() const;

    /// @throw openvdb::ValueError if a radius exceeds 32767 voxels
    /// @throw detail::MemoryError if there is too little memory
    /// @throw openvdb::IoError if a temporary file is needed and cannot be made, or has no room
    /// @throw Interrupted if the interrupter (may be null) said so
    LevelBalls run(openvdb::util::NullInterrupter* interrupter);

private:
    template <typename Power, typename T>
    LevelBalls runWith(const StreamPlan& plan, openvdb::util::NullInterrupter* interrupter);
    template <typename Power, typename T>
    StreamMemory memory() const;
    StreamMemory memoryFor(uint32_t largestDistSq) const;
    StreamPlan planFor(uint32_t largestDistSq) const;
    uint32_t largest(openvdb::util::NullInterrupter* interrupter) const;

    const LeafLayout& mLayout;
    int mDim;
    std::vector<VoxelRef>* mQueried = nullptr;
    detail::LabelOffsets* mKept = nullptr;
    std::optional<StreamPlan> mPlan; ///< none: as memory allows
    int64_t mMemory = 0;
};

} // namespace openvdb_spheretree::slab
