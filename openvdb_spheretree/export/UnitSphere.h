// SPDX-License-Identifier: Apache-2.0
/// @file UnitSphere.h
/// @brief A sphere of radius 1 as triangles: an icosahedron whose triangles are split in four.

#pragma once

#include <openvdb/Types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

struct UnitSphere {
    std::vector<openvdb::Vec3d> points;             ///< on the sphere
    std::vector<std::array<uint32_t, 3>> triangles; ///< counterclockwise as seen from outside
};

/// @param splits  0 for the icosahedron itself; each one makes four times the triangles
UnitSphere unitSphere(int splits);

/// @return that of each of so many spheres in a mesh: 320 triangles, or 80 where there are many. Its triangles
///         are inside the sphere, by 1.3 % or 4.8 % of the radius at most.
UnitSphere meshShapeFor(std::size_t spheres);

} // namespace openvdb_spheretree::detail
