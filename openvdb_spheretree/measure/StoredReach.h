// SPDX-License-Identifier: Apache-2.0
/// @file StoredReach.h
/// @brief How far spheres reach out of a solid: an upper bound for every point of them, not only
/// for the voxel centers that they hold.
///
/// The solid S is the union of the object's closed voxel cubes. What is wanted is the largest
/// distance of a point p of any sphere to S. Branch and bound over cubes of space ("cells"):
///
/// 1. seed: the distances of some points of spheres, a lower bound B from the start.
/// 2. visitNode: voxels that a sphere may touch (and that the object has not) go by words where
///    they are within B of the object's nearest voxel, as in FarthestVoxel.cc: a point is as far
///    from a voxel's cube as its own voxel is from that voxel, at most. Before that, blocks of 4^3
///    leaves, and then leaves, are dismissed where one query tells that all of their voxels are that
///    near. The voxels that are left are cells, with that distance for a bound (LeafReach.h knows it
///    where it is small); so are tiles, without.
/// 3. visitGroup: which spheres meet a cell, from the node down.
/// 4. visit: cells are halved along all axes. One that no sphere meets is dropped. So is one with a
///    bound of at most B. The bound of a cell is the smallest of three:
///      - that of the cell it is part of;
///      - the largest distance of a point of the cell to one box K of the solid, that nearest to
///        the cell's middle: dist(p, S) <= dist(p, K), whatever K is;
///      - the same for points of the cell that are in a sphere (c, r), by Lagrange's multiplier:
///        for any t >= 0, dist(p, K)^2 <= dist(p, K)^2 + t (r^2 - |p - c|^2). The right side is a
///        sum over axes, so its largest value in the cell is found axis by axis. With
///        t = dist(p, S) / |p - c| its gradient vanishes where p sticks out along the radius, and
///        the bound is off only by the square of the cell's size.
/// 5. A cell of 1/32 voxel is not halved any more: its bound counts, and raises B.
///
/// Sound: every point of a sphere lies in a chain of cells, and a cell's bound, or B when it was
/// dropped, is at least the point's distance. Tight: a cell that counts has a point of a sphere,
/// and is sqrt(3)/32 = 0.055 voxel across, so the result is no farther than that from the truth.
/// Cells lie within voxels, so spheres that keep within the solid reach exactly 0. Doubles are
/// rounded up in the end.
///
/// The result is a maximum over smallest cells of numbers that depend on a cell and its ancestors
/// alone, so it is the same for any number of threads. Where distances are those of a norm, step 4
/// has its first bound only, and cells end at 1/4 voxel.
///
/// Cost: a microsecond a leaf of the spheres' surface, less where B is 27 voxels or more, and about
/// as much a cell. Few cells are
/// looked at but where very many spheres reach nearly as far as the farthest one: leaf balls of a
/// few voxels with padding (a gyroid of 300,000 voxels and 53,000 balls: 870,000 cells; its other
/// levels together: 52,000).

#pragma once

#include <openvdb_spheretree/index/NearestVoxel.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/Types.h>
#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree::detail {

/// In index space of the object.
struct ReachSphere {
    openvdb::Vec3d center;
    double radius; ///< voxels; of a norm: how far it reaches along an axis
};

/// @return a distance, in voxels, that no point of the spheres exceeds to the solid; 0 if there are
///         none. In units where a voxel is 1, of norms too.
/// @param touched   at least all voxels whose cubes have a point of a sphere, less the object
/// @param object    which must have a voxel
/// @param solid     the same, as an index
/// @param flatAxis  -1, or the axis that takes no part: spheres are discs in the plane of their
///                  centers, which must be that of the object
double storedReach(const std::vector<ReachSphere>& spheres, const MaskMinus& touched,
    const openvdb::MaskTree& object, const NearestVoxel& solid, int flatAxis,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
