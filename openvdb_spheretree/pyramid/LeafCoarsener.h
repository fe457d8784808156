// SPDX-License-Identifier: Apache-2.0
/// @file LeafCoarsener.h
/// @brief The parents of a leaf's voxels, for any factor, on whole mask words.
///
/// A parent's coordinate along an axis depends on its child's along that axis only, so the 512 bits
/// are folded one axis at a time. Along x, words of equal parent are ORed. Along y, rows of eight
/// bits move to their parent's row. Along z, the bits of a row come from a table of 256 entries.
/// With dim = 2 the factor along z is 1. Which of the eight coordinates of a leaf share a parent
/// depends only on how many of them the first parent takes, 1 to 8: eight tables an axis suffice.

#pragma once

#include "PyramidModel.h"
#include <openvdb_spheretree/voxel/LeafMask.h>

#include <array>
#include <cstdint>

namespace openvdb_spheretree::detail {

/// Division rounded down, also below zero.
/// @param b  1 or more
inline int floorDiv(int a, int b) { return a >= 0 ? a / b : -1 - (-1 - a) / b; }

class LeafCoarsener {
public:
    explicit LeafCoarsener(const PyramidStep& step);

    /// @return the origins of the first and of the last leaf, per axis, that the leaf at @a origin
    /// has parents in; more than one only where the factor or the pyramid's origin cuts leaves.
    openvdb::CoordBBox parentLeaves(const openvdb::Coord& origin) const;

    /// Adds to @a parent, the mask of the leaf at @a parentOrigin, the parents of the voxels of
    /// @a leaf, whose origin is @a origin.
    void add(const LeafMask& leaf, const openvdb::Coord& origin, const openvdb::Coord& parentOrigin,
        LeafMask& parent) const;

private:
    struct AxisMap {
        int factor = 1, origin = 0;
        /// By the number of coordinates that the first parent takes: parents counted from it.
        std::array<std::array<uint8_t, 8>, 9> steps{};
    };
    /// How one leaf's coordinates along an axis fall into a leaf of parents.
    struct Fall {
        int base;  ///< place of the first parent, counted from the parent leaf's origin
        int taken; ///< coordinates that it takes
    };

    Fall fall(int axis, int origin, int parentOrigin) const;
    uint64_t foldRows(uint64_t word, const Fall& y, const Fall& z) const;

    std::array<AxisMap, 3> mAxes;
    std::array<std::array<uint8_t, 256>, 9> mRows{}; ///< `steps` of z for all bits of a row at once
};

} // namespace openvdb_spheretree::detail
