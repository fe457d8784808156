// SPDX-License-Identifier: Apache-2.0
/// @file TestWindingNumber.cc
/// @brief How often boxes, turned ones too, wind around voxels: overlapping, nested, inverted, with a hole.

#include "support/Meshes.h"

#include <openvdb_spheretree/solid/WindingNumber.h>

#include <openvdb/math/Mat3.h>
#include <openvdb/math/Transform.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Coord;
using openvdb::Vec3d;

struct Box {
    Vec3d low, high;
    bool inverted;
};

int numberBy(const std::vector<Box>& boxes, const Vec3d& point)
{
    int number = 0;
    for (const Box& box : boxes) {
        bool inside = true;
        for (int axis = 0; axis < 3; ++axis) {
            inside = inside && box.low[axis] < point[axis] && point[axis] < box.high[axis];
        }
        if (inside) number += box.inverted ? -1 : 1;
    }
    return number;
}

/// Voxels of which no cube is met, and the number of each by the boxes, which are turned by @a turn.
void expectNumbers(const std::vector<Box>& boxes, const openvdb::Mat3d& turn)
{
    TriangleMesh mesh;
    for (const Box& box : boxes) addBox(mesh, box.low, box.high, box.inverted);
    for (auto& point : mesh.points) point = openvdb::Vec3d(turn * Vec3d(point));
    const IndexMesh triangles =
        toIndexSpace(mesh, *openvdb::math::Transform::createLinearTransform(1));
    const auto surface = trianglesToVoxels(triangles);
    std::vector<Coord> voxels;
    std::vector<int> expected;
    for (auto voxel = openvdb::CoordBBox(Coord(-8), Coord(30)).begin(); voxel; ++voxel) {
        if (surface->isValueOn(*voxel) || ((*voxel)[0] + (*voxel)[1] * 3 + (*voxel)[2] * 5) % 7)
            continue;
        voxels.push_back(*voxel);
        expected.push_back(numberBy(boxes, turn.transpose() * (*voxel).asVec3d()));
    }
    ASSERT_GT(voxels.size(), 1000u);
    EXPECT_EQ(expected, windingNumbers(triangles, voxels));
}

const std::vector<Box> kBoxes = {{Vec3d(0), Vec3d(20), false}, {Vec3d(3), Vec3d(9), true},
    {Vec3d(10, 2, 2), Vec3d(28, 12, 12), false}, {Vec3d(12), Vec3d(18), false},
    {Vec3d(-6), Vec3d(-2, 6, 20), true}};

TEST(WindingNumber, CountsTheBoxesThatHoldAVoxel)
{
    // Corners and edges in line with centers of voxels, and others.
    expectNumbers(kBoxes, openvdb::Mat3d::identity());
    std::mt19937 random(1);
    std::uniform_real_distribution<double> angle(0, 6);
    for (int n = 0; n < 4; ++n) {
        const openvdb::Mat3d turn =
            openvdb::math::rotation<openvdb::Mat3d>(openvdb::math::X_AXIS, angle(random))
            * openvdb::math::rotation<openvdb::Mat3d>(openvdb::math::Z_AXIS, angle(random));
        expectNumbers(kBoxes, turn);
    }
}

/// Two of three rays count, wherever one leaves.
TEST(WindingNumber, IsThatOfTheClosedMeshBesideAHole)
{
    TriangleMesh mesh = boxMesh(Vec3d(0.3), Vec3d(20.3));
    mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 4); // at z = 20.3
    const IndexMesh triangles =
        toIndexSpace(mesh, *openvdb::math::Transform::createLinearTransform(1));
    EXPECT_EQ(std::vector<int>({1, 1, 0}),
        windingNumbers(triangles, {Coord(10), Coord(3, 17, 5), Coord(10, 10, 40)}));
}

/// A sheet before a voxel winds around nothing, though a ray along one axis crosses it.
TEST(WindingNumber, IsNoneBehindALoneSheet)
{
    for (int axis = 0; axis < 3; ++axis) {
        for (const double height : {-7.0, 7.0}) {
            TriangleMesh mesh;
            for (const auto& [u, v] : {std::pair(-9, -9), std::pair(30, -9), std::pair(-9, 30)}) {
                openvdb::Vec3d corner;
                corner[axis] = float(height);
                corner[(axis + 1) % 3] = float(u);
                corner[(axis + 2) % 3] = float(v);
                mesh.points.push_back(corner);
            }
            mesh.triangles = {openvdb::Vec3I(0, 1, 2)};
            const IndexMesh triangles =
                toIndexSpace(mesh, *openvdb::math::Transform::createLinearTransform(1));
            EXPECT_EQ(std::vector<int>({0}), windingNumbers(triangles, {Coord(0)}))
                << axis << height;
        }
    }
}

/// The first rays from this voxel leave through a corner, where three triangles meet: whether through one of
/// them or another is decided by rounding, so other rays are asked.
TEST(WindingNumber, RaysThroughCornersAreNotCounted)
{
    const Vec3d steps(0.7548776662466927, 0.5698402909980532, 0.4180339887498949);
    const Vec3d place = 0.8 * (steps - Vec3d(0.5)); // where windingNumbers() begins
    IndexMesh mesh;
    for (const int sign : {-1, 1}) {
        for (int axis = 0; axis < 3; ++axis) {
            // A side of a cube of 20 voxels, of four triangles around a point in line with the place.
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            const auto corner = [&](double atU, double atV) {
                Vec3d p;
                p[axis] = 10 * sign;
                p[u] = atU;
                p[v] = atV;
                mesh.points.push_back(p);
                return uint32_t(mesh.points.size() - 1);
            };
            const uint32_t middle = corner(place[u], place[v]);
            const uint32_t around[4] = {
                corner(-10, -10), corner(10, -10), corner(10, 10), corner(-10, 10)};
            for (int i = 0; i < 4; ++i) {
                const uint32_t a = around[i], b = around[(i + 1) % 4];
                mesh.triangles.push_back(
                    sign > 0 ? openvdb::Vec3I(middle, a, b) : openvdb::Vec3I(middle, b, a));
            }
        }
    }
    EXPECT_EQ(std::vector<int>({1, 0}), windingNumbers(mesh, {Coord(0), Coord(20)}));
}

} // namespace
