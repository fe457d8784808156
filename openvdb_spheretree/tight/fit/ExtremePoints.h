// SPDX-License-Identifier: Apache-2.0
/// @file ExtremePoints.h
/// @brief The few voxels of a set that a ball must hold to hold them all.
///
/// A ball is convex, so it holds a set of voxels if it holds the corners of the set's convex hull.
/// If the set is cut into parallel slices, each of these corners is also a corner of the 2-D hull
/// of its slice. So each slice is reduced to the corners of its hull, by a monotone chain (A. M.
/// Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979) in integers.
/// That is done for slices in several directions, one after the other. What is left are all corners
/// of the hull and a few points more. Flat sets, thin sets and single voxels are no special cases.

#pragma once

#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <openvdb/Types.h>

#include <vector>

namespace openvdb_spheretree::tight {

/// Takes voxels leaf by leaf.
class ExtremePoints {
public:
    void clear();
    /// @param origin  leaves come in the order of their origins, x first
    void add(const openvdb::Coord& origin, const LeafMask& mask);
    /// @return the points, a superset of the hull's corners; empty if nothing was added. Valid
    /// until the next clear().
    std::vector<openvdb::Coord>& finish();

private:
    struct Row {
        int32_t y, first, last; ///< of the voxels along z
    };
    void addRow(std::vector<Row>& slice, int32_t y, int32_t first, int32_t last);
    void flush();

    openvdb::Coord mSlab;        ///< origin of a leaf of the slab that is collected; only x counts
    std::vector<Row> mSlices[8]; ///< one row for each y
    std::vector<openvdb::Coord> mPoints;
};

/// Keeps the corners of the hulls of slices across x, y and z, and across diagonals if many are
/// left.
void dropInnerPoints(std::vector<openvdb::Coord>& points);

} // namespace openvdb_spheretree::tight
