// SPDX-License-Identifier: Apache-2.0
/// @file TerrainShape.h
/// @brief A square sheet along a height field: the voxels from the lowest of a column and its eight
/// neighbours up to two above its own height.
///
/// So each column is three voxels or more, overlaps with its neighbours (the sheet is one part, by
/// faces), and begins no higher than any neighbour's height: nothing comes through, not even by
/// corners. Columns at the border are as if the sheet went on.
///
/// The side is found by counting: columns of the squares that begin at the origin, ring by ring,
/// over the largest square that may be needed. Then the sheet is made anew, a block at a time.

#pragma once

#include "HeightField.h"
#include "VoxelRule.h"

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

class TerrainShape : public VoxelRule {
public:
    static constexpr int kThickness = 3; ///< of the thinnest column, in voxels

    /// @throw Interrupted if the interrupter (may be null) said so
    TerrainShape(int64_t voxels, uint64_t seed, openvdb::util::NullInterrupter* interrupter);

    openvdb::CoordBBox box() const override;
    void paint(BoolBlockNode& block) const override;

private:
    HeightField mHeights;
    int mSide = 0;
};

} // namespace detail
} // namespace openvdb_spheretree
