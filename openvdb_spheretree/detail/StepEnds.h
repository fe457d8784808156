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

/// The last voxels of a leaf along each axis, in word x: none of word 0 to 6 along x.
constexpr uint64_t kLastRow = uint64_t(0xff) << 56, kLastColumn = 0x8080808080808080;

/// The voxels of word x of @a mask moved on by one along @a axis.
inline uint64_t movedOn(Axis axis, const LeafMask& mask, uint32_t x)
{
    switch (axis) {
    case Axis::X: return x > 0 ? mask[x - 1] : 0;
    case Axis::Y: return mask[x] << 8;
    default: return mask[x] << 1;
    }
}

/// Marks the ends of steps of 1 and -1 that stay in the leaf.
/// @return the voxels of word x that they start from.
inline uint64_t markNeighbours(
    Axis axis, uint32_t x, uint64_t forward, uint64_t back, LeafMask& marks)
{
    if (axis == Axis::X) {
        if (x == 7) forward = 0;
        else marks[x + 1] |= forward;
        if (x == 0) back = 0;
        else marks[x - 1] |= back;
        return forward | back;
    }
    const int shift = axis == Axis::Y ? 8 : 1;
    const uint64_t last = axis == Axis::Y ? kLastRow : kLastColumn, first = last >> 7 * shift;
    forward &= ~last;
    back &= ~first;
    marks[x] |= forward << shift | back >> shift;
    return forward | back;
}

/// Marks where the steps lead along @a axis from the voxels that @a mask has on in leaf i of a run.
/// Few need a walk: most are 0, or short, or lead where the voxel before led, which has marked that
/// already.
/// @param steps    512 of the leaf, in leaf order
/// @param marksOf  gives the mask to mark in of a leaf of the run
template <typename Step, typename MarksOf>
void markEnds(
    Axis axis, uint32_t i, const Step* steps, const LeafMask& mask, const MarksOf& marksOf)
{
    const StepBits bits = stepBits(steps, axis, mask);
    const int shift = 6 - 3 * int(axis), position = int(i) * kLeafDim;
    LeafMask& own = marksOf(i);
    for (uint32_t x = 0; x < 8; ++x) {
        if (mask[x] == 0) continue;
        own[x] |= mask[x] & bits.stays[x];
        const uint64_t done = bits.stays[x] | (bits.asBefore[x] & movedOn(axis, mask, x));
        uint64_t left = mask[x] & ~done;
        left &= ~markNeighbours(axis, x, left & bits.forward[x], left & bits.back[x], own);
        for (; left; left &= left - 1) {
            const int offset = int(64 * x + openvdb::util::FindLowestOn(left));
            const int here = offset >> shift & 7, end = position + here + steps[offset];
            const int there = offset + ((end & 7) - here) * (1 << shift);
            marksOf(uint32_t(end >> 3))[there >> 6] |= uint64_t(1) << (there & 63);
        }
    }
}

} // namespace detail
} // namespace openvdb_spheretree
