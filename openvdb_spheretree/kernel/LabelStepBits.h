// SPDX-License-Identifier: Apache-2.0
/// @file LabelStepBits.h
/// @brief Steps of power labels as mask words: which are worth following, and where they lead.

#pragma once

#include "LeafRows.h"
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

/// @return voxels whose step ends where that of the voxel before them along the axis ends, in the
///         same leaf; none in words of @a mask without a voxel that is on.
/// @param steps  512 steps of a leaf along @a axis, in leaf order
LeafMask endsAsBefore(const int8_t* steps, Axis axis, const LeafMask& mask);
LeafMask endsAsBefore(const int16_t* steps, Axis axis, const LeafMask& mask);

/// Voxels with an end of their own: no voxel before them along the axis has it.
struct FreshSteps {
    LeafMask stay; ///< the step is 0: the voxel is its end
    LeafMask go;
};

/// @return those of @a mask, held against others of it in the same leaf.
FreshSteps freshSteps(const int8_t* steps, Axis axis, const LeafMask& mask);
FreshSteps freshSteps(const int16_t* steps, Axis axis, const LeafMask& mask);

/// @brief Marks where steps from row to row (LeafRows.h) lead.
/// @param on     the lanes of each row that have a step
/// @param marks  a word a row; lanes may lead to rows before the first and behind the last
void markRowEnds(const int8_t* steps, const uint64_t* on, int rows, uint64_t* marks);
void markRowEnds(const int16_t* steps, const uint64_t* on, int rows, uint64_t* marks);

} // namespace detail
} // namespace openvdb_spheretree
