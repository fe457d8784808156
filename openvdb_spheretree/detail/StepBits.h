// SPDX-License-Identifier: Apache-2.0
/// @file detail/StepBits.h
/// @brief Steps of power labels as mask words: which need no walking, and where they lead.

#pragma once

#include "../LeafLayout.h"
#include "LeafRows.h"

#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

struct StepBits {
    LeafMask stays;    ///< the step is 0: the voxel is its own end
    LeafMask asBefore; ///< ends where the step of the voxel before it along the axis ends
    LeafMask forward;  ///< the step is 1
    LeafMask back;     ///< the step is -1
};

/// @param steps  512 steps of a leaf along @a axis, in leaf order
/// @param mask   words without a voxel that is on are left undefined
StepBits stepBits(const int8_t* steps, Axis axis, const LeafMask& mask);
StepBits stepBits(const int16_t* steps, Axis axis, const LeafMask& mask);

/// @return the voxels of @a mask whose step is 0: stepBits().stays of those that are on.
LeafMask zeroSteps(const int8_t* steps, const LeafMask& mask);
LeafMask zeroSteps(const int16_t* steps, const LeafMask& mask);

/// @brief Marks where steps from row to row (LeafRows.h) lead.
/// @param on     the lanes of each row that have a step
/// @param marks  a word a row; lanes may lead to rows before the first and behind the last
void markRowEnds(const int8_t* steps, const uint64_t* on, int rows, uint64_t* marks);
void markRowEnds(const int16_t* steps, const uint64_t* on, int rows, uint64_t* marks);

} // namespace detail
} // namespace openvdb_spheretree
