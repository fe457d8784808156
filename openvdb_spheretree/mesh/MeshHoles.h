// SPDX-License-Identifier: Apache-2.0
/// @file MeshHoles.h
/// @brief Where a mesh is open, and what it would bound if it were closed there.

#pragma once

#include <openvdb_spheretree/mesh/TriangleMesh.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

/// An edge that belongs to an odd number of triangles, in the direction that it has in them.
struct OpenEdge {
    uint32_t from = 0, to = 0; ///< points of the mesh
};

/// @return all of them, in the order of their points. Cost: sorting the edges.
std::vector<OpenEdge> openEdgesOf(
    const TriangleMesh& mesh, openvdb::util::NullInterrupter* interrupter = nullptr);

/// The holes of a mesh: open edges that hang together.
struct MeshHoles {
    double widest = 0; ///< of all holes, the second side of the box around it; world units
    double volume =
        0; ///< that the mesh bounds if each hole is closed by a cone to its middle; world units cubed
};

/// @note Parts within each other count each, and triangles that face either way cancel.
MeshHoles holesOf(const TriangleMesh& mesh, const std::vector<OpenEdge>& edges);

} // namespace openvdb_spheretree
