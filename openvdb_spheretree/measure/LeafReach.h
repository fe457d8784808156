// SPDX-License-Identifier: Apache-2.0
/// @file LeafReach.h
/// @brief Which voxels of a leaf are within a few voxels of an object: all 512 at once, by words.
///
/// The object's voxels in the 27 leaves around are dilated by a ball, row by row:
///     near(x, y) = OR over dx, dy of row(x + dx, y + dy), widened by reach(dx, dy) along z
/// 1. gather: a byte for each row of eight voxels, of the 24 x 24 rows around and three leaves deep
/// 2. widen: the middle bytes, widened by 0, 1, 2, ... voxels
/// 3. takeNear: eight rows along y are the word of a slice, so each (dx, dy) costs eight ORs of
///    words; nearest rows first, until no voxel is left
///
/// The same rows tell which voxel is the nearest one to a voxel of the leaf, row by row.
///
/// A microsecond a leaf. Exact, for every Distance. Kept by a thread from leaf to leaf.

#pragma once

#include <openvdb_spheretree/voxel/Distance.h>
#include <openvdb_spheretree/voxel/LeafMask.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

class LeafReach {
public:
    /// Voxels beyond this are never near, however large the limit: the leaves around end there.
    static constexpr int kReach = 8;

    /// Takes those voxels off the mask of the leaf at @a origin that are within the squared
    /// distance @a limitSq of the object, and nearer than kReach + 1 voxels.
    void takeNear(const openvdb::MaskTree& object, const Distance& distance, int64_t limitSq,
        const openvdb::Coord& origin, LeafMask& mask);

    /// @param voxel    of the leaf that takeNear() was called for last
    /// @param nearest  receives the nearest voxel of the object
    /// @return the squared distance to it; -1 where it is kReach + 1 voxels or more.
    int64_t nearest(const openvdb::Coord& voxel, openvdb::Coord& nearest) const;

private:
    static constexpr int kSide = 8 + 2 * kReach; ///< of the rows around
    static constexpr int kRows = kSide * kSide;

    /// Rows from the leaf's own, and how far the ball reaches along z there.
    struct Offset {
        int dx, dy, reach;
    };
    /// 64-bit words of eight rows; row (x, y) is byte kSide x + y.
    using Rows = uint64_t[kRows / 8];

    void order(const Distance& distance, int64_t limitSq);
    uint32_t column(int row) const;
    bool gather(const openvdb::MaskTree& object, const openvdb::Coord& origin);
    void widen();

    Distance mDistance;
    int64_t mLimitSq = -1;
    std::vector<Offset> mOffsets; ///< nearest first; of mDistance and mLimitSq
    openvdb::Coord mOrigin;       ///< of the leaf that the rows are around
    Rows mBelow, mMiddle, mAbove; ///< by leaf along z
    Rows mWidened[kReach + 1];    ///< by how far
};

} // namespace openvdb_spheretree::detail
