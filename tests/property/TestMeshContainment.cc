// SPDX-License-Identifier: Apache-2.0
/// @file TestMeshContainment.cc
/// @brief With cover=1 every point of a mesh lies in the stored spheres of every level: all corners and many
/// points of every mesh, held against the spheres one by one. $SPHERETREE_SAMPLES says how many points
/// of each mesh; meshes are those of $SPHERETREE_DATA, and some made here.

#include "support/Meshes.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/MeshCheck.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/index/BoundingTree.h>
#include <openvdb_spheretree/input/mesh/MeshFile.h>
#include <openvdb_spheretree/solid/MeshSolid.h>

#include <openvdb/openvdb.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

int samples()
{
    const char* const asked = std::getenv("SPHERETREE_SAMPLES");
    return asked ? std::atoi(asked) : 20000;
}

std::vector<TriangleMesh> meshes()
{
    std::vector<TriangleMesh> result{boxMesh(Vec3d(0.1), Vec3d(30, 20.2, 9)),
        boxMesh(Vec3d(0.1), Vec3d(30, 0.3, 20)), boxMesh(Vec3d(1e4), Vec3d(1e4 + 5))};
    result[0].name = "bar", result[1].name = "plate", result[2].name = "far";
    addBox(result[0], Vec3d(25, 9, 4), Vec3d(80, 9.4, 6)); // and a thin arm
    if (const char* const folder = std::getenv("SPHERETREE_DATA")) {
        for (const auto& file :
            std::filesystem::directory_iterator(std::filesystem::path(folder) / "mesh")) {
            result.push_back(readMeshFile(file.path().string()));
        }
    }
    return result;
}

/// All corners, and points of triangles chosen by their area.
std::vector<Vec3d> pointsOf(const TriangleMesh& mesh, std::mt19937& random)
{
    std::vector<Vec3d> points(mesh.points.begin(), mesh.points.end());
    std::vector<double> areas;
    for (const auto& t : mesh.triangles) {
        const Vec3d a(mesh.points[t[0]]), b(mesh.points[t[1]]), c(mesh.points[t[2]]);
        areas.push_back((b - a).cross(c - a).length());
    }
    std::discrete_distribution<std::size_t> choose(areas.begin(), areas.end());
    std::uniform_real_distribution<double> part(0, 1);
    for (int n = 0; n < samples(); ++n) {
        const auto& t = mesh.triangles[choose(random)];
        double u = part(random), v = part(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const Vec3d a(mesh.points[t[0]]), b(mesh.points[t[1]]), c(mesh.points[t[2]]);
        points.push_back(a + u * (b - a) + v * (c - a));
    }
    return points;
}

/// @return how far the point that is furthest from a level's stored spheres is outside of them.
double furthestOutside(
    const SphereTree& tree, const SphereTreeLevel& level, const std::vector<Vec3d>& points)
{
    std::vector<detail::Bound> bounds;
    for (int32_t id = level.begin; id < level.end; ++id) {
        bounds.push_back(detail::Bound::ofBall(
            tree.centerWorld(id), double(tree.spheres.radiusWorld[std::size_t(id)])));
    }
    const detail::BoundingTree index(bounds);
    double furthest = 0;
    for (const Vec3d& point : points) {
        double outside = INFINITY;
        index.visitMeeting(detail::Bound::ofBall(point, tree.voxelSize()), [&](int32_t place) {
            const detail::Bound& ball = bounds[std::size_t(index.order()[std::size_t(place)])];
            outside = std::min(outside, (ball.center - point).length() - ball.radius);
        });
        furthest = std::max(furthest, outside);
    }
    return furthest;
}

TEST(MeshContainment, OfEveryPointInEveryLevel)
{
    openvdb::initialize();
    std::mt19937 random(1);
    for (const TriangleMesh& mesh : meshes()) {
        SCOPED_TRACE(mesh.name);
        const std::vector<Vec3d> points = pointsOf(mesh, random);
        const auto object = meshToObject(mesh, voxelSizeForDim(mesh, 48));
        TightOptions options;
        options.quality = Quality::Fast;
        const SphereTree tree = buildSphereTree(*object, options);
        for (const SphereTreeLevel& level : tree.levels) {
            EXPECT_LT(furthestOutside(tree, level, points), 1e-6 * tree.voxelSize() + 1e-9)
                << level.level;
        }
        EXPECT_TRUE(checkMeshCovered(tree, mesh, &*object).empty());
    }
}

} // namespace
