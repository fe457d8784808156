// SPDX-License-Identifier: Apache-2.0
/// @file WindingNumber.h
/// @brief How often a mesh winds around voxels that no triangle meets: 0 outside, 1 inside, 2 where two
/// solids overlap, 0 again in a hollow whose surface faces it.
///
/// A ray counts 1 for each triangle that it leaves the solid through, and -1 for each that it enters by. It
/// starts somewhere in the voxel's cube, where the number is the same everywhere. If it comes so near to an
/// edge that rounding might decide, another place is taken: the next of a fixed list. A ray along each axis is
/// counted, and the middle one of the three numbers taken: one ray may leave by a hole of the mesh.
///
/// Cost: a bounding tree of the triangles, and for each ray those whose boxes it meets. Parallel. Tests:
/// TestWindingNumber.cc.

#pragma once

#include <openvdb_spheretree/mesh/TriangleVoxels.h>

#include <openvdb/Types.h>
#include <openvdb/util/NullInterrupter.h>

#include <vector>

namespace openvdb_spheretree {

/// @param mesh    its corners must be there
/// @param voxels  no triangle meets their cubes
/// @return the number of each; 0 where all places of the list were too near to edges
/// @throw Interrupted if the interrupter (may be null) said so
std::vector<int> windingNumbers(const IndexMesh& mesh, const std::vector<openvdb::Coord>& voxels,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
