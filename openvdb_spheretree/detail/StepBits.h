// SPDX-License-Identifier: Apache-2.0
/// @file detail/StepBits.h
/// @brief Which voxels of a leaf have a step that needs no walking, as mask words.

#pragma once

#include "../LeafLayout.h"

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

} // namespace detail
} // namespace openvdb_spheretree
