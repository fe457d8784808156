// SPDX-License-Identifier: Apache-2.0
/// @file Meshes.h
/// @brief Closed meshes for tests: boxes, joined into one.

#pragma once

#include <openvdb_spheretree/mesh/TriangleMesh.h>

#include <utility>

namespace spheretree_test {

/// Facing outwards; bit a of a point's number says whether it is at the high end of axis a.
inline void addBox(openvdb_spheretree::TriangleMesh& mesh, const openvdb::Vec3d& low,
    const openvdb::Vec3d& high, bool inverted = false)
{
    const auto first = uint32_t(mesh.points.size());
    for (int p = 0; p < 8; ++p) {
        mesh.points.emplace_back(
            p & 1 ? high[0] : low[0], p & 2 ? high[1] : low[1], p & 4 ? high[2] : low[2]);
    }
    constexpr uint32_t kSides[6][4] = {
        {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : kSides) {
        openvdb::Vec3I a(first + q[0], first + q[1], first + q[2]);
        openvdb::Vec3I b(first + q[0], first + q[2], first + q[3]);
        if (inverted) {
            std::swap(a[1], a[2]);
            std::swap(b[1], b[2]);
        }
        mesh.triangles.push_back(a);
        mesh.triangles.push_back(b);
    }
}

inline openvdb_spheretree::TriangleMesh boxMesh(
    const openvdb::Vec3d& low, const openvdb::Vec3d& high, bool inverted = false)
{
    openvdb_spheretree::TriangleMesh mesh;
    mesh.name = "box";
    addBox(mesh, low, high, inverted);
    return mesh;
}

} // namespace spheretree_test
