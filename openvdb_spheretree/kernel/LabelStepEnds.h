// SPDX-License-Identifier: Apache-2.0
/// @file LabelStepEnds.h
/// @brief Where the steps of power labels lead along one axis, as mask words.

#pragma once

#include "LabelStepBits.h"
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <openvdb/util/NodeMasks.h>

#include <cstdint>

namespace openvdb_spheretree {
namespace detail {

/// Calls visit(offset, leaf, end) for the steps along @a axis of some voxels of leaf i of a run: the
/// voxel's place in its leaf, the number of the leaf in the run where the step ends, the place there.
template <typename Step, typename Visit>
void forEachEnd(Axis axis, uint32_t i, const Step* steps, const LeafMask& mask, const Visit& visit)
{
    const int shift = 6 - 3 * int(axis);
    for (uint32_t x = 0; x < 8; ++x) {
        for (uint64_t left = mask[x]; left; left &= left - 1) {
            const int offset = int(64 * x + openvdb::util::FindLowestOn(left));
            const int here = offset >> shift & 7, end = here + steps[offset];
            const int there = offset + ((end & 7) - here) * (1 << shift);
            visit(uint32_t(offset), uint32_t(int(i) + (end >> 3)), uint32_t(there));
        }
    }
}

/// Marks where the steps lead along @a axis from the voxels that @a mask has on in leaf i of a run.
/// @param steps    512 of the leaf, in leaf order
/// @param marksOf  gives the mask to mark in of a leaf of the run
template <typename Step, typename MarksOf>
void markEnds(
    Axis axis, uint32_t i, const Step* steps, const LeafMask& mask, const MarksOf& marksOf)
{
    const FreshSteps fresh = freshSteps(steps, axis, mask);
    LeafMask& own = marksOf(i);
    for (uint32_t x = 0; x < 8; ++x) own[x] |= fresh.stay[x];
    forEachEnd(axis, i, steps, fresh.go, [&](uint32_t, uint32_t leaf, uint32_t end) {
        marksOf(leaf)[end >> 6] |= uint64_t(1) << (end & 63);
    });
}

} // namespace detail
} // namespace openvdb_spheretree
