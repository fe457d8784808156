// SPDX-License-Identifier: Apache-2.0
#include "Polygon.h"

#include <openvdb/Exceptions.h>

#include <cmath>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Vec2d;
using openvdb::Vec3d;
using openvdb::Vec3I;

/// Twice the signed area of the triangle.
double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c)
{
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// @return the polygon, counterclockwise, without the axis that is nearest to its (Newell) normal.
std::vector<Vec2d> flattened(
    const std::vector<Vec3d>& points, const std::vector<std::uint32_t>& corners)
{
    const Vec3d& origin = points[corners[0]];
    Vec3d normal(0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const Vec3d a = points[corners[i]] - origin;
        normal += a.cross(points[corners[i + 1]] - origin);
    }
    int axis = 0;
    for (int i = 1; i < 3; ++i) axis = std::abs(normal[i]) > std::abs(normal[axis]) ? i : axis;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double side = normal[axis] < 0 ? -1 : 1;
    std::vector<Vec2d> flat;
    for (const std::uint32_t corner : corners) {
        const Vec3d p = points[corner] - origin;
        flat.emplace_back(side * p[u], p[v]);
    }
    return flat;
}

bool isConvex(const std::vector<Vec2d>& flat)
{
    const std::size_t n = flat.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) < 0) return false;
    }
    return true;
}

/// Whether remaining[at] is convex, and no other corner is in its triangle with its neighbours.
bool isEar(
    const std::vector<Vec2d>& flat, const std::vector<std::uint32_t>& remaining, std::size_t at)
{
    const std::size_t n = remaining.size();
    const Vec2d &a = flat[remaining[(at + n - 1) % n]], &b = flat[remaining[at]],
                &c = flat[remaining[(at + 1) % n]];
    if (turn(a, b, c) <= 0) return false;
    for (const std::uint32_t i : remaining) {
        const Vec2d& p = flat[i];
        if (p == a || p == b || p == c) continue;
        if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
}

void cutEars(const std::vector<Vec2d>& flat, const std::vector<std::uint32_t>& corners,
    std::vector<Vec3I>& triangles, InterruptSteps& steps)
{
    std::vector<std::uint32_t> remaining(corners.size());
    for (std::size_t i = 0; i < remaining.size(); ++i) remaining[i] = std::uint32_t(i);
    std::size_t at = 0, tried = 0;
    while (remaining.size() > 3) {
        const std::size_t n = remaining.size();
        steps.add(n);
        // If no corner is an ear, the polygon crosses itself. Then any corner goes, so this ends.
        if (tried < n && !isEar(flat, remaining, at)) {
            at = (at + 1) % n;
            ++tried;
            continue;
        }
        triangles.emplace_back(corners[remaining[(at + n - 1) % n]], corners[remaining[at]],
            corners[remaining[(at + 1) % n]]);
        remaining.erase(remaining.begin() + std::ptrdiff_t(at));
        at = (at + n - 2) % (n - 1); // the corner before may have become an ear
        tried = 0;
    }
    triangles.emplace_back(corners[remaining[0]], corners[remaining[1]], corners[remaining[2]]);
}

} // namespace

void triangulate(const std::vector<Vec3d>& points, const std::vector<std::uint32_t>& corners,
    std::vector<Vec3I>& triangles, InterruptSteps& steps)
{
    steps.add(corners.size());
    if (corners.size() > 3) {
        const std::vector<Vec2d> flat = flattened(points, corners);
        if (!isConvex(flat)) {
            if (corners.size() > kMaxConcaveCorners) {
                OPENVDB_THROW(openvdb::ValueError,
                    "a concave polygon has " << corners.size()
                                             << " corners; triangulate the mesh first");
            }
            return cutEars(flat, corners, triangles, steps);
        }
    }
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        triangles.emplace_back(corners[0], corners[i], corners[i + 1]);
    }
}

} // namespace openvdb_spheretree::detail
