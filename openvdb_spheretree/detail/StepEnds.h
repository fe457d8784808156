// SPDX-License-Identifier: Apache-2.0
/// @file detail/StepEnds.h
/// @brief Where the steps of power labels lead along one axis, as mask words.

#pragma once

#include "../LeafLayout.h"
#include "StepBits.h"

#include <openvdb/util/NodeMasks.h>

#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

/// Marks where the steps lead along @a axis from the voxels that @a mask has on in leaf i of a run.
/// @param steps    512 of the leaf, in leaf order
/// @param marksOf  gives the mask to mark in of a leaf of the run
template <typename Step, typename MarksOf>
void markEnds(
    Axis axis, uint32_t i, const Step* steps, const LeafMask& mask, const MarksOf& marksOf)
{
    const FreshSteps fresh = freshSteps(steps, axis, mask);
    const int shift = 6 - 3 * int(axis), position = int(i) * kLeafDim;
    LeafMask& own = marksOf(i);
    for (uint32_t x = 0; x < 8; ++x) {
        own[x] |= fresh.stay[x];
        for (uint64_t left = fresh.go[x]; left; left &= left - 1) {
            const int offset = int(64 * x + openvdb::util::FindLowestOn(left));
            const int here = offset >> shift & 7, end = position + here + steps[offset];
            const int there = offset + ((end & 7) - here) * (1 << shift);
            marksOf(uint32_t(end >> 3))[there >> 6] |= uint64_t(1) << (there & 63);
        }
    }
}

} // namespace detail
} // namespace openvdb_spheretree
