// SPDX-License-Identifier: Apache-2.0
/// @file TestTriangleVoxels.cc
/// @brief The voxels that triangles meet, against the thirteen separating axes in integers.

#include <openvdb_spheretree/mesh/TriangleVoxels.h>
#include <openvdb_spheretree/base/Interrupted.h>

#include <openvdb/math/Transform.h>
#include <openvdb/openvdb.h>

#include <tbb/task_arena.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>

namespace {

using namespace openvdb_spheretree;
using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3I;

using Corner = std::array<int64_t, 3>; // in eighths of a voxel
using Triangle = std::array<Corner, 3>;

Corner cross(const Corner& a, const Corner& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

int64_t dot(const Corner& a, const Corner& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Corner minus(const Corner& a, const Corner& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// Of closed sets: no axis has a gap between their shadows. A triangle that is a segment or a point has
/// fewer directions of its own; those across it in the plane are its edges' with the axes, too.
bool meets(const Triangle& triangle, const Coord& voxel)
{
    std::vector<Corner> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::array<Corner, 3> edges{minus(triangle[1], triangle[0]),
        minus(triangle[2], triangle[1]), minus(triangle[0], triangle[2])};
    axes.push_back(cross(edges[0], edges[1]));
    for (const Corner& edge : edges) {
        for (int axis = 0; axis < 3; ++axis) axes.push_back(cross(edge, axes[std::size_t(axis)]));
    }
    for (const Corner& axis : axes) {
        const Corner center{8 * int64_t(voxel[0]), 8 * int64_t(voxel[1]), 8 * int64_t(voxel[2])};
        const int64_t reach = 4 * (std::abs(axis[0]) + std::abs(axis[1]) + std::abs(axis[2]));
        const auto [low, high] = std::minmax({dot(axis, minus(triangle[0], center)),
            dot(axis, minus(triangle[1], center)), dot(axis, minus(triangle[2], center))});
        if (low > reach || high < -reach) return false;
    }
    return true;
}

IndexMesh meshOf(const std::vector<Triangle>& triangles)
{
    IndexMesh mesh;
    for (const Triangle& triangle : triangles) {
        const auto first = uint32_t(mesh.points.size());
        for (const Corner& c : triangle) {
            mesh.points.emplace_back(double(c[0]) / 8, double(c[1]) / 8, double(c[2]) / 8);
        }
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

std::set<Coord> voxelsOf(const openvdb::MaskTree& tree)
{
    std::set<Coord> voxels;
    for (auto voxel = tree.cbeginValueOn(); voxel; ++voxel) voxels.insert(voxel.getCoord());
    return voxels;
}

std::set<Coord> expected(const Triangle& triangle)
{
    Coord low, high;
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t a(axis);
        const auto [least, most] = std::minmax({triangle[0][a], triangle[1][a], triangle[2][a]});
        low[axis] = int32_t(least / 8 - 2);
        high[axis] = int32_t(most / 8 + 2);
    }
    std::set<Coord> voxels;
    for (auto voxel = openvdb::CoordBBox(low, high).begin(); voxel; ++voxel) {
        if (meets(triangle, *voxel)) voxels.insert(*voxel);
    }
    return voxels;
}

Triangle randomTriangle(std::mt19937& random, int64_t reach)
{
    Triangle triangle;
    for (Corner& corner : triangle) {
        for (int64_t& c : corner) c = std::uniform_int_distribution<int64_t>(-reach, reach)(random);
    }
    return triangle;
}

TEST(TriangleVoxels, AreThoseOfTheSeparatingAxesForEveryTriangleOnASmallGrid)
{
    // Corners at centers, faces, edges and corners of a cube, so that touching is all that happens.
    for (int n = 0; n < 27 * 27 * 27; ++n) {
        Triangle triangle;
        for (int i = 0, digits = n; i < 9; ++i, digits /= 3) {
            triangle[std::size_t(i / 3)][std::size_t(i % 3)] = 4 * (digits % 3);
        }
        ASSERT_EQ(expected(triangle), voxelsOf(*trianglesToVoxels(meshOf({triangle})))) << n;
    }
}

TEST(TriangleVoxels, AreThoseOfTheSeparatingAxesForRandomTriangles)
{
    std::mt19937 random(1);
    for (int n = 0; n < 3000; ++n) {
        Triangle triangle = randomTriangle(random, n % 2 ? 20 : 150);
        if (n % 3 == 0) triangle[2][std::size_t(n) % 3 % 3] = triangle[1][std::size_t(n) % 3];
        if (n % 7 == 0) triangle[2] = triangle[0]; // a segment
        ASSERT_EQ(expected(triangle), voxelsOf(*trianglesToVoxels(meshOf({triangle})))) << n;
    }
}

TEST(TriangleVoxels, OfSliversAreThoseOfTheSeparatingAxes)
{
    std::mt19937 random(2);
    for (int n = 0; n < 500; ++n) {
        Triangle triangle = randomTriangle(random, 200);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            triangle[2][axis] = (triangle[0][axis] + triangle[1][axis]) / 2;
        }
        ASSERT_EQ(expected(triangle), voxelsOf(*trianglesToVoxels(meshOf({triangle})))) << n;
    }
}

/// It is cut along nodes. The oracle looks at voxels near its plane alone.
TEST(TriangleVoxels, OfALargeTriangleAreThoseOfTheSeparatingAxes)
{
    const Triangle triangle{Corner{-3001, 17, 5}, Corner{2999, 1203, 40}, Corner{-90, 2400, -33}};
    const auto found = trianglesToVoxels(meshOf({triangle}));
    int64_t count = 0;
    for (auto voxel = openvdb::CoordBBox(Coord(-380, -2, -8), Coord(380, 304, 9)).begin(); voxel;
         ++voxel) {
        const bool isMet = meets(triangle, *voxel);
        count += isMet;
        ASSERT_EQ(isMet, found->isValueOn(*voxel)) << *voxel;
    }
    EXPECT_EQ(count, int64_t(found->activeVoxelCount()));
}

TEST(TriangleVoxels, AreTheSameForAnyNumberOfThreadsAndFarFromTheOrigin)
{
    std::mt19937 random(3);
    std::vector<Triangle> triangles;
    for (int n = 0; n < 2000; ++n) triangles.push_back(randomTriangle(random, 400));
    triangles.push_back(randomTriangle(random, 8000));
    const IndexMesh mesh = meshOf(triangles);
    openvdb::MaskTree::Ptr one;
    tbb::task_arena(1).execute([&] { one = trianglesToVoxels(mesh); });
    openvdb::MaskTree::Ptr four;
    tbb::task_arena(4).execute([&] { four = trianglesToVoxels(mesh); });
    EXPECT_TRUE(one->hasSameTopology(*four));
    const Coord shift(1 << 29, -(1 << 29), 8);
    IndexMesh moved = mesh;
    for (Vec3d& point : moved.points) point += shift.asVec3d();
    const auto far = trianglesToVoxels(moved);
    ASSERT_EQ(one->activeVoxelCount(), far->activeVoxelCount());
    for (auto voxel = one->cbeginValueOn(); voxel; ++voxel) {
        ASSERT_TRUE(far->isValueOn(voxel.getCoord() + shift)) << voxel.getCoord();
    }
}

/// Where coordinates are rounded, a voxel may be met by the rounded triangle and not by the true one, but
/// never the other way around: sampled points of the true triangle lie in voxels that were found.
TEST(TriangleVoxels, HoldEveryPointOfTrianglesInTheWorld)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<float> where(-5, 5);
    TriangleMesh mesh;
    for (uint32_t n = 0; n < 300; ++n) {
        for (int i = 0; i < 3; ++i)
            mesh.points.emplace_back(where(random), where(random), where(random));
        mesh.triangles.emplace_back(3 * n, 3 * n + 1, 3 * n + 2);
    }
    const auto transform = openvdb::math::Transform::createLinearTransform(0.1);
    transform->postRotate(0.7, openvdb::math::X_AXIS);
    transform->postTranslate(Vec3d(1e5, -3, 0.01));
    for (openvdb::Vec3d& point : mesh.points) point += openvdb::Vec3d(1e5f, 0, 0);
    const auto found = trianglesToVoxels(toIndexSpace(mesh, *transform));
    std::uniform_real_distribution<double> part(0, 1);
    for (const Vec3I& triangle : mesh.triangles) {
        const Vec3d a(mesh.points[triangle[0]]), b(mesh.points[triangle[1]]),
            c(mesh.points[triangle[2]]);
        for (int n = 0; n < 100; ++n) {
            const double s = part(random), t = part(random) * (1 - s);
            const Vec3d point = transform->worldToIndex(a + s * (b - a) + t * (c - a));
            ASSERT_TRUE(found->isValueOn(Coord::round(point))) << point;
        }
    }
}

TEST(TriangleVoxels, StopWhenAskedTo)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    const IndexMesh mesh = meshOf({Triangle{Corner{0, 0, 0}, Corner{80, 0, 0}, Corner{0, 80, 8}}});
    EXPECT_THROW(trianglesToVoxels(mesh, &stop), Interrupted);
}

} // namespace
