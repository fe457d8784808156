// SPDX-License-Identifier: Apache-2.0
/// @file TerrainShape.h
/// @brief A square sheet along a height field. A column begins at the lowest height among its own
/// and those of its eight neighbours, and ends two voxels above its own height.
///
/// So a column has three voxels or more, and overlaps with its neighbours: the sheet is connected
/// by faces. It begins no higher than any neighbour's height: no path of voxels leads through the
/// sheet, not even by corners. At the border, heights beyond it count as well.
///
/// The side of the square is found by counting. The voxels of all columns with max(x, y) = n are
/// counted for every n that may be needed, and added up until there are enough.

#pragma once

#include "HeightField.h"
#include "VoxelRule.h"

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>

namespace openvdb_spheretree::detail {

class TerrainShape : public VoxelRule {
public:
    static constexpr int kThickness = 3; ///< of the thinnest column, in voxels

    /// @throw Interrupted if the interrupter (may be null) said so
    TerrainShape(int64_t voxels, uint64_t seed, openvdb::util::NullInterrupter* interrupter);

    openvdb::CoordBBox box() const override;
    void paint(BoolLowerNode& node) const override;

private:
    HeightField mHeights;
    int mSide = 0;
};

} // namespace openvdb_spheretree::detail
