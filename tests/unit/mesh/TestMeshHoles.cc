// SPDX-License-Identifier: Apache-2.0
/// @file TestMeshHoles.cc
/// @brief Open edges and their directions, the widths of holes, and the volume of what is closed by cones.

#include <openvdb_spheretree/mesh/MeshHoles.h>

#include "support/Meshes.h"

#include <gtest/gtest.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

MeshHoles holesOf(const TriangleMesh& mesh)
{
    return openvdb_spheretree::holesOf(mesh, openEdgesOf(mesh));
}

/// A box of 40 x 40 x 40 without so many of its triangles; the first two are one side.
TriangleMesh boxWithout(int triangles, const Vec3d& at = Vec3d(0))
{
    TriangleMesh mesh = boxMesh(at, at + Vec3d(40));
    mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + triangles);
    return mesh;
}

TEST(MeshHoles, AClosedMeshHasNone)
{
    const TriangleMesh mesh = boxMesh(Vec3d(1), Vec3d(2, 3, 5));
    EXPECT_TRUE(openEdgesOf(mesh).empty());
    EXPECT_EQ(0, holesOf(mesh).widest);
    EXPECT_NEAR(1 * 2 * 4, holesOf(mesh).volume, 1e-12);
}

TEST(MeshHoles, AnOpenEdgeHasTheDirectionOfItsTriangle)
{
    const TriangleMesh mesh = boxWithout(2);
    const auto edges = openEdgesOf(mesh);
    ASSERT_EQ(4u, edges.size());
    EXPECT_EQ(4, openEdges(mesh));
    for (const OpenEdge& edge : edges) {
        int found = 0;
        for (const openvdb::Vec3I& t : mesh.triangles) {
            for (int i = 0; i < 3; ++i) found += t[i] == edge.from && t[(i + 1) % 3] == edge.to;
        }
        EXPECT_EQ(1, found) << edge.from << " to " << edge.to;
    }
}

TEST(MeshHoles, AFlatHoleThatIsClosedGivesTheWholeVolume)
{
    for (const Vec3d& at : {Vec3d(0), Vec3d(-7, 3, 1e6)}) {
        EXPECT_NEAR(64000, holesOf(boxWithout(2, at)).volume, 1e-3) << at;
        EXPECT_NEAR(40, holesOf(boxWithout(2, at)).widest, 1e-9) << at;
    }
    EXPECT_NEAR(64000, holesOf(boxWithout(1)).volume, 1e-9);
    TriangleMesh inverted = boxWithout(2);
    for (openvdb::Vec3I& t : inverted.triangles) std::swap(t[0], t[1]);
    EXPECT_NEAR(64000, holesOf(inverted).volume, 1e-9);
}

TEST(MeshHoles, EachHoleIsClosedByItself)
{
    TriangleMesh two = boxWithout(2);
    two.triangles.erase(two.triangles.begin(), two.triangles.begin() + 2); // another side
    const TriangleMesh far = boxWithout(2, Vec3d(1000, 0, 0));
    const auto first = uint32_t(two.points.size());
    two.points.insert(two.points.end(), far.points.begin(), far.points.end());
    for (const openvdb::Vec3I& t : far.triangles)
        two.triangles.push_back(t + openvdb::Vec3I(first));
    EXPECT_NEAR(128000, holesOf(two).volume, 1e-3);
}

} // namespace
