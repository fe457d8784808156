// SPDX-License-Identifier: Apache-2.0
/// @file TestMeshLevelSet.cc
/// @brief Meshes to level sets: the inside, far meshes, what is refused; voxel sizes and open edges.

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/input/mesh/MeshLevelSet.h>

#include <openvdb/tools/LevelSetUtil.h>

#include "support/Messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;
using openvdb::Vec3I;
using openvdb::Vec4I;

/// From 0 to 1, facing outwards; bit a of a point's number is its coordinate on axis a.
TriangleMesh cubeMesh()
{
    TriangleMesh mesh;
    mesh.name = "cube";
    for (int p = 0; p < 8; ++p) mesh.points.emplace_back(p & 1, p >> 1 & 1, p >> 2 & 1);
    for (const auto& q : {Vec4I(0, 2, 3, 1), Vec4I(4, 5, 7, 6), Vec4I(0, 1, 5, 4),
             Vec4I(2, 6, 7, 3), Vec4I(0, 4, 6, 2), Vec4I(1, 3, 7, 5)}) {
        mesh.triangles.emplace_back(q[0], q[1], q[2]);
        mesh.triangles.emplace_back(q[0], q[2], q[3]);
    }
    return mesh;
}

openvdb::Index64 interiorVoxels(const openvdb::FloatGrid& grid)
{
    return openvdb::tools::sdfInteriorMask(grid)->activeVoxelCount();
}

TEST(MeshLevelSet, MakesALevelSetWhoseInteriorIsTheSolid)
{
    openvdb::initialize();
    TriangleMesh mesh = cubeMesh();
    for (Vec3d& point : mesh.points) point = point * 10.f + Vec3d(0.05f);
    const auto grid = meshToLevelSet(mesh, 0.1, 4);
    EXPECT_EQ("cube", grid->getName());
    EXPECT_EQ(openvdb::GRID_LEVEL_SET, grid->getGridClass());
    EXPECT_NEAR(0.4, grid->background(), 1e-6);
    EXPECT_EQ(Vec3d(0.1), grid->voxelSize());
    EXPECT_EQ(1000000u, interiorVoxels(*grid)); // faces lie halfway between voxel centres
}

TEST(MeshLevelSet, KeepsFarMeshesInPlace)
{
    openvdb::initialize();
    TriangleMesh mesh = cubeMesh(); // at index 34952550, which no float holds
    for (Vec3d& point : mesh.points) point = point * 4.f + Vec3d(1048576.5f);
    const auto grid = meshToLevelSet(mesh, 0.03);
    const auto box = openvdb::tools::sdfInteriorMask(*grid)->evalActiveVoxelBoundingBox();
    EXPECT_NEAR(1048576.5 / 0.03, box.min().x(), 1);
    EXPECT_NEAR(1048580.5 / 0.03, box.max().z(), 1);
}

TEST(MeshLevelSet, MakesALevelSetOfAMeshWithTrianglesWithoutArea)
{
    openvdb::initialize();
    TriangleMesh mesh = cubeMesh();
    for (Vec3d& point : mesh.points) point = point * 10.f + Vec3d(0.25f);
    const auto count = interiorVoxels(*meshToLevelSet(mesh, 0.5));
    const auto n = openvdb::Index32(mesh.points.size());
    for (const float at : {0.3f, 5.f, 9.9f}) mesh.points.push_back(Vec3d(0.25f + at, 0.25f, 0.25f));
    mesh.triangles.push_back(Vec3I(n, n + 1, n + 2)); // on an edge
    mesh.triangles.push_back(Vec3I(n, n, n));
    const auto grid = meshToLevelSet(mesh, 0.5);
    EXPECT_EQ(count, interiorVoxels(*grid));
    for (auto it = grid->cbeginValueOn(); it; ++it) ASSERT_TRUE(std::isfinite(*it));
}

TEST(MeshLevelSet, RejectsLevelSetArgumentsOutOfRange)
{
    openvdb::initialize();
    const TriangleMesh mesh = cubeMesh();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    for (const double size : {0.0, -1.0, nan, inf, 1e-300, 1e-12}) {
        EXPECT_THROW(meshToLevelSet(mesh, size), openvdb::ValueError) << size;
    }
    for (const double width : {0.0, 0.99, -3.0, nan, inf, 1001.0}) {
        EXPECT_THROW(meshToLevelSet(mesh, 0.1, width), openvdb::ValueError) << width;
    }
}

TEST(MeshLevelSet, RejectsAMeshTooLargeForItsVoxels)
{
    TriangleMesh mesh = cubeMesh();
    mesh.points[3] = Vec3d(0, 0, 2e9f);
    EXPECT_THROW(meshToLevelSet(mesh, 1), openvdb::ValueError);
    mesh.points[3] = Vec3d(0, -3e38f, 0);
    EXPECT_THROW(meshToLevelSet(mesh, 0.01), openvdb::ValueError);
}

TEST(MeshLevelSet, RefusesWhatWouldNotFitThisMachineWithTheNumberOfVoxels)
{
    TriangleMesh mesh; // half of a square of 10^6 x 10^6
    mesh.name = "field";
    mesh.points = {Vec3d(0), Vec3d(1e6f, 0, 0), Vec3d(0, 1e6f, 0)};
    mesh.triangles = {Vec3I(0, 1, 2)};
    const std::string message =
        messageOf<openvdb::ValueError>([&] { meshToLevelSet(mesh, 1.0, 3.0); });
    EXPECT_TRUE(
        mentions(message, "the up to 3e+12 voxels at the surface of mesh 'field' need about"));
    EXPECT_TRUE(mentions(message, "use a larger voxel"));
}

/// The band around a small mesh is as large as its half width.
TEST(MeshLevelSet, RefusesAWideBandThatWouldNotFitThisMachine)
{
    const double there = openvdb_spheretree::detail::physicalMemory(); // 0: it cannot be told
    if (there <= 0 || there > 30e9) GTEST_SKIP() << "it fits";
    const std::string message =
        messageOf<openvdb::ValueError>([&] { meshToLevelSet(cubeMesh(), 0.1, 1000); });
    EXPECT_TRUE(mentions(message, "a narrower band")) << message;
}

TEST(MeshLevelSet, RejectsADamagedMesh)
{
    EXPECT_THROW(meshToLevelSet(TriangleMesh(), 0.1), openvdb::ValueError);
    TriangleMesh mesh = cubeMesh();
    mesh.triangles.push_back(Vec3I(0, 1, 8));
    EXPECT_THROW(meshToLevelSet(mesh, 0.1), openvdb::ValueError);
    mesh = cubeMesh();
    mesh.points[2].y() = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(meshToLevelSet(mesh, 0.1), openvdb::ValueError);
    EXPECT_THROW(voxelSizeForDim(mesh, 10), openvdb::ValueError);
}

TEST(MeshLevelSet, FitsTheVoxelSizeToTheLongestSide)
{
    TriangleMesh mesh = cubeMesh();
    for (Vec3d& point : mesh.points) point *= Vec3d(1, 8, 4);
    EXPECT_DOUBLE_EQ(0.125, voxelSizeForDim(mesh, 64));
    EXPECT_DOUBLE_EQ(8, voxelSizeForDim(mesh, 1));
    for (const int dim : {0, -5}) EXPECT_THROW(voxelSizeForDim(mesh, dim), openvdb::ValueError);
    EXPECT_THROW(voxelSizeForDim(TriangleMesh(), 10), openvdb::ValueError);
    for (Vec3d& point : mesh.points) point = Vec3d(1);
    EXPECT_THROW(voxelSizeForDim(mesh, 10), openvdb::ValueError);
}

struct StopAtOnce final : openvdb::util::NullInterrupter {
    bool wasInterrupted(int = -1) override { return true; }
};

TEST(MeshLevelSet, StopsWhenInterrupted)
{
    openvdb::initialize();
    StopAtOnce interrupter;
    EXPECT_THROW(meshToLevelSet(cubeMesh(), 0.1, 3, &interrupter), Interrupted);
}

TEST(MeshLevelSet, CountsTheEdgesWhereAMeshIsOpen)
{
    TriangleMesh mesh; // a tetrahedron
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    EXPECT_EQ(openEdges(mesh), 0);
    mesh.triangles.pop_back();
    EXPECT_EQ(openEdges(mesh), 3);
    mesh.triangles = {{0, 2, 1}};
    EXPECT_EQ(openEdges(mesh), 3);
    mesh.triangles.clear();
    EXPECT_EQ(openEdges(mesh), 0);
}

} // namespace
