// SPDX-License-Identifier: Apache-2.0
#include "TriangleMesh.h"

#include "MeshHoles.h"

#include <openvdb/Exceptions.h>
#include <openvdb/math/Transform.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {

namespace {

using openvdb::BBoxd;
using openvdb::Vec3d;
using openvdb::Vec3I;

/// Half of what Coord holds, so that a narrow band and OpenVDB's own margins fit around it.
constexpr double kMaxIndex = 1 << 29; // a side of twice that has boxes of 2^31

} // namespace

int64_t openEdges(const TriangleMesh& mesh, openvdb::util::NullInterrupter* interrupter)
{
    return int64_t(openEdgesOf(mesh, interrupter).size());
}

double voxelSizeForDim(const TriangleMesh& mesh, int dim)
{
    if (dim < 1) {
        OPENVDB_THROW(openvdb::ValueError, "dim " << dim << " is out of range; it must be >= 1");
    }
    const auto isFinite = [](const Vec3d& point) { return point.isFinite(); };
    const bool hasBox =
        !mesh.points.empty() && std::all_of(mesh.points.begin(), mesh.points.end(), isFinite);
    const Vec3d sides = hasBox ? boxOf(mesh).extents() : Vec3d(0);
    const double side = std::max({sides[0], sides[1], sides[2]});
    if (!(side > 0)) {
        OPENVDB_THROW(openvdb::ValueError,
            "mesh '" << mesh.name
                     << "' is empty, has no extent, or is not finite: no voxel size fits it");
    }
    return side / dim;
}

openvdb::math::Transform::Ptr transformOfVoxels(double voxelSize)
{
    if (std::isfinite(voxelSize) && voxelSize > 0) {
        try {
            return openvdb::math::Transform::createLinearTransform(voxelSize);
        } catch (const openvdb::ArithmeticError&) { // nearly singular, in OpenVDB's eyes
        }
    }
    OPENVDB_THROW(openvdb::ValueError,
        "voxel size " << voxelSize
                      << " is out of range; it must be "
                         "a finite number above 0.0001 or so: is the unit of length right?");
}

void requireUsableMesh(const TriangleMesh& mesh, double voxelSize)
{
    if (mesh.triangles.empty()) {
        OPENVDB_THROW(openvdb::ValueError, "mesh '" << mesh.name << "' has no triangles");
    }
    for (const Vec3I& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            if (triangle[i] < mesh.points.size()) continue;
            OPENVDB_THROW(openvdb::ValueError,
                "mesh '" << mesh.name << "' has a triangle of point " << triangle[i]
                         << ", but only " << mesh.points.size() << " points");
        }
    }
    for (const Vec3d& point : mesh.points) {
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(point[axis] / voxelSize) <= kMaxIndex) continue; // false for NaN too
            OPENVDB_THROW(openvdb::ValueError,
                "mesh '" << mesh.name << "' reaches coordinate " << point[axis]
                         << ", too far for voxel size " << voxelSize
                         << " (indices must stay within 2^29); use larger voxels");
        }
    }
}

double longestEdge(const TriangleMesh& mesh)
{
    double longestSq = 0;
    for (const openvdb::Vec3I& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const Vec3d &from = mesh.points[t[i]], &to = mesh.points[t[(i + 1) % 3]];
            longestSq = std::max(longestSq, (to - from).lengthSqr());
        }
    }
    return std::sqrt(longestSq);
}

double areaOf(const TriangleMesh& mesh)
{
    double area = 0;
    for (const Vec3I& triangle : mesh.triangles) {
        const Vec3d &a = mesh.points[triangle[0]], &b = mesh.points[triangle[1]],
                    &c = mesh.points[triangle[2]];
        area += (b - a).cross(c - a).length() / 2;
    }
    return area;
}

BBoxd boxOf(const TriangleMesh& mesh)
{
    BBoxd box;
    for (const Vec3d& point : mesh.points) box.expand(point);
    return box;
}

} // namespace openvdb_spheretree
