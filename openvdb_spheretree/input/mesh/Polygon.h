// SPDX-License-Identifier: Apache-2.0
/// @file Polygon.h
/// @brief A polygon in space, concave ones included, as triangles.

#pragma once

#include <openvdb/Types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

/// Cutting ears takes quadratic time, or worse where the polygon is made for it.
constexpr std::size_t kMaxConcaveCorners = 2000;

/// @brief Append the triangles of a polygon, n - 2 of them, turning the way it turns.
/// A convex polygon becomes a fan; of any other one ears are cut off in the plane it lies in best.
/// One that crosses itself gets triangles too, as good as may be.
/// @param corners  at least three indices into @a points
/// @throw openvdb::ValueError if it is concave and has more than kMaxConcaveCorners
void triangulate(const std::vector<openvdb::Vec3s>& points,
    const std::vector<std::uint32_t>& corners, std::vector<openvdb::Vec3I>& triangles);

} // namespace detail
} // namespace openvdb_spheretree
