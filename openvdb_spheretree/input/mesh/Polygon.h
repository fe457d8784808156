// SPDX-License-Identifier: Apache-2.0
/// @file Polygon.h
/// @brief Cuts a polygon in space into triangles (G. Meisters, "Polygons have ears", 1975).

#pragma once

#include <openvdb_spheretree/base/InterruptSteps.h>

#include <openvdb/Types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// Cutting ears takes quadratic time, in the worst case cubic.
constexpr std::size_t kMaxConcaveCorners = 2000;

/// @brief Append the n - 2 triangles of a polygon, with its orientation.
/// A convex polygon becomes a fan. From any other one, ears are cut off in the axis plane that is
/// nearest to its own. A polygon that crosses itself becomes n - 2 triangles as well, though no
/// result is right.
/// @param corners  at least three indices into @a points
/// @param steps  asks an interrupter as corners are looked at
/// @throw openvdb::ValueError if it is concave and has more than kMaxConcaveCorners; Interrupted
void triangulate(const std::vector<openvdb::Vec3d>& points,
    const std::vector<std::uint32_t>& corners, std::vector<openvdb::Vec3I>& triangles,
    InterruptSteps& steps);

} // namespace openvdb_spheretree::detail
