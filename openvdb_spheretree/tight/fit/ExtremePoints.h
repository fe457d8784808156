// SPDX-License-Identifier: Apache-2.0
/// @file ExtremePoints.h
/// @brief The few voxels of a set that a ball must hold to hold them all.
///
/// A ball is convex, so it holds a set of voxels when it holds the corners of its convex hull. Those
/// are among the corners of the 2-D hulls of the set's slices, along any direction of slices: a
/// slice is cut down to its hull by a monotone chain (A. M. Andrew, "Another efficient algorithm for
/// convex hulls in two dimensions", 1979), in integers, and that for several directions one after
/// the other. What is left are all corners of the hull and few points more; flat, thin and single
/// voxels are no special cases.

#pragma once

#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <openvdb/Types.h>

#include <vector>

namespace openvdb_spheretree {
namespace tight {

/// Takes voxels leaf by leaf.
class ExtremePoints {
public:
    void clear();
    /// @param origin  leaves come in the order of their origins, x first
    void add(const openvdb::Coord& origin, const LeafMask& mask);
    /// @return the points, a superset of the hull's corners; empty if nothing was added. Valid until
    /// the next clear().
    std::vector<openvdb::Coord>& finish();

private:
    struct Row {
        int32_t y, first, last; ///< of the voxels along z
    };
    void addRow(std::vector<Row>& slice, int32_t y, int32_t first, int32_t last);
    void flush();

    openvdb::Coord mSlab;        ///< origin of the slab of leaves that is collected; only x counts
    std::vector<Row> mSlices[8]; ///< one row for each y
    std::vector<openvdb::Coord> mPoints;
};

/// @brief Drops points that are no corners of the hull: of every slice along x, y and z, and where
/// many are left, of diagonal slices.
void dropInnerPoints(std::vector<openvdb::Coord>& points);

} // namespace tight
} // namespace openvdb_spheretree
