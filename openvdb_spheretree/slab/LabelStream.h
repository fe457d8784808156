// SPDX-License-Identifier: Apache-2.0
/// @file slab/LabelStream.h
/// @brief From voxels to power labels and medial balls, slab by slab: only a window of slabs is in
/// memory at a time.
///
/// Slabs go through three states:
///
/// 1. *entered*: distances and the passes along z and y (SlabDistance.h, SlabPower.h), many slabs
///    in parallel; what stays are keys and steps;
/// 2. *final*: no ball of a slab that has not entered reaches it. Then its labels are found by the
///    pass along x, run by run, over the slabs of the window (ColumnPower.h), and it answers what it
///    is asked;
/// 3. *released*: none of its balls reaches a slab that is not final. Then its medial balls are
///    known, and its memory goes to the next one that enters.
///
/// Distances change by at most 1 from a voxel to the next. So if M is the largest distance in the
/// last slab that has entered, whose voxels end at x = e, no later ball reaches x <= e - M; where
/// slabs do not touch, none at all. A slab with largest distance m whose voxels end at x reaches
/// nothing from x + m on.
///
/// The result does not depend on how many slabs enter at a time, nor on threads.

#pragma once

#include "../LeafLayout.h"
#include "../MedialAxis.h"
#include "../PowerMap.h"
#include "../detail/LabelSteps.h"

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace slab {

/// The leaf of a voxel that is off.
constexpr uint32_t kNoLeaf = UINT32_MAX;

/// Seconds that stages took; those of one phase that run together share its time.
struct StreamSeconds {
    double distance = 0, power = 0, medial = 0;
};

/// What comes out of a level.
struct LevelBalls {
    std::vector<MedialBall> balls; ///< ordered by centre
    std::vector<LeafMask> centers; ///< of balls, one mask a leaf
    StreamSeconds seconds;
};

class LabelStream {
public:
    /// @param layout  kept by reference
    /// @param dim     3, or 2 to leave the z axis out
    LabelStream(const LeafLayout& layout, int dim) : mLayout(layout), mDim(dim) {}

    /// @param voxels  of the object: run() makes each of them its label; those in kNoLeaf stay
    void ask(std::vector<PowerMap::Voxel>& voxels) { mAsked = &voxels; }
    /// @param steps  receives the labels of all voxels
    void keepSteps(detail::LabelSteps& steps) { mKeep = &steps; }
    /// @param slabs  that enter at a time, 1 or more; as many as memory allows unless said
    void setWindow(uint32_t slabs) { mWindow = slabs; }
    /// @param bytes  to make do with, beside the layout, what is kept and the result; three quarters
    ///               of the machine's memory unless said
    void setMemory(int64_t bytes) { mMemory = bytes; }

    /// @throw openvdb::ValueError if a radius exceeds 32767 voxels, or there is too little memory
    /// @throw Interrupted if the interrupter (may be null) said so
    LevelBalls run(openvdb::util::NullInterrupter* interrupter);

private:
    template <typename Power, typename T>
    LevelBalls runWith(uint32_t largestDistSq, openvdb::util::NullInterrupter* interrupter);

    const LeafLayout& mLayout;
    int mDim;
    std::vector<PowerMap::Voxel>* mAsked = nullptr;
    detail::LabelSteps* mKeep = nullptr;
    uint32_t mWindow = 0; ///< 0: as memory allows
    int64_t mMemory = 0;  ///< 0: as the machine has
};

} // namespace slab
} // namespace openvdb_spheretree
