// SPDX-License-Identifier: Apache-2.0
/// @file QueryBodies.h
/// @brief The bodies that questions are measured on: trees, meshes of the same voxels, poses.

#pragma once

#include <openvdb_spheretree/query/QueryTree.h>
#include <openvdb_spheretree/query/RigidMotion.h>
#include <openvdb_spheretree/query/RigidTransform.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace spheretree_benchmark {

/// The surface of a body's voxels, through the middles between voxels inside and outside.
struct BodyMesh {
    std::vector<openvdb::Vec3d> points;
    std::vector<std::array<int32_t, 3>> triangles;
};

struct QueryBody {
    std::string name;
    openvdb_spheretree::SphereTree tree;
    openvdb_spheretree::QueryTree query; ///< of the tree as it is
    openvdb_spheretree::QueryTree
        plain; ///< the same leaves under a hierarchy by the surface area heuristic
    BodyMesh mesh;
};

/// @param file  a .vol; the tree is tight, of all medial balls that are needed, of @a quality
QueryBody queryBody(const std::string& file, openvdb_spheretree::Quality quality);

/// How near two bodies are: beyond contact along a random direction by 10 to 100% of the sum of their radii, by 0 to
/// 5%, within it by 0 to 5%, or with the offset scaled by 0 to 0.7.
enum class Stratum { Apart, Near, Slight, Deep };
constexpr std::array<const char*, 4> kStrata = {"apart", "near", "slight", "deep"};

/// @return where b is in the frame of a; the same ones each time.
std::vector<openvdb_spheretree::RigidTransform> posesOf(
    const QueryBody& a, const QueryBody& b, Stratum stratum, int count);

/// @return screws that end in such poses, from places apart along the directions of these, turned by up to half a
///         turn.
std::vector<openvdb_spheretree::RigidMotion> motionsTo(const QueryBody& a, const QueryBody& b,
    const std::vector<openvdb_spheretree::RigidTransform>& ends);

} // namespace spheretree_benchmark
