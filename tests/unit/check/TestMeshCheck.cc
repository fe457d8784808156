// SPDX-License-Identifier: Apache-2.0
/// @file TestMeshCheck.cc
/// @brief Whether stored spheres cover a mesh: trees that do, and trees that were damaged so that they do not.

#include "support/Meshes.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/MeshCheck.h>
#include <openvdb_spheretree/solid/MeshSolid.h>

#include <openvdb/openvdb.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

class MeshCheck : public ::testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }

    /// An L with arms of other thickness than voxels have.
    static TriangleMesh bracket()
    {
        TriangleMesh mesh = boxMesh(Vec3d(0.1), Vec3d(20.3, 4.2, 9.7));
        addBox(mesh, Vec3d(0.1), Vec3d(3.3, 17.2, 9.7));
        return mesh;
    }
    static SphereTree treeOf(const openvdb::BoolGrid& object, double padding)
    {
        TightOptions options;
        options.budget.spheres = {30, 7, 1};
        options.quality = Quality::Fast;
        SphereTreeSettings settings = options;
        settings.padding = padding;
        return buildSphereTree(object, settings);
    }
};

TEST_F(MeshCheck, FindsNothingWrongWithTheTreeOfAllVoxelsThatAreMet)
{
    const TriangleMesh mesh = bracket();
    const auto object = meshToObject(mesh, 1);
    const SphereTree tree = treeOf(*object, SphereTreeSettings::kPadCubes);
    EXPECT_TRUE(checkMeshCovered(tree, mesh, &*object).empty());
    EXPECT_TRUE(checkMeshCovered(tree, mesh, nullptr).empty()) << "spheres by themselves";
}

TEST_F(MeshCheck, FindsTheLevelThatASphereIsMissingOf)
{
    const TriangleMesh mesh = bracket();
    const auto object = meshToObject(mesh, 1);
    SphereTree tree = treeOf(*object, SphereTreeSettings::kPadCubes);
    for (int32_t id = tree.levels[1].begin; id < tree.levels[1].end; ++id) {
        if (tree.centerWorld(id)[0] > 12) tree.spheres.radiusWorld[std::size_t(id)] = 0.01f;
    }
    const auto faults = checkMeshCovered(tree, mesh, nullptr);
    ASSERT_EQ(1u, faults.size());
    EXPECT_EQ(FaultKind::Surface, faults.front().kind);
    EXPECT_NE(std::string::npos,
        faults.front().sentence.find("level 1 is not proven to cover mesh 'box'"))
        << faults.front().sentence;
}

/// A voxel that the mesh meets and the object has not, in each place: spheres hold only some of these.
TEST_F(MeshCheck, AgreesWithPointsOfTheSurface)
{
    const TriangleMesh mesh = bracket();
    const auto object = meshToObject(mesh, 1);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(0, 1);
    for (int n = 0; n < 12; ++n) {
        SphereTree tree = treeOf(*object, SphereTreeSettings::kPadCubes);
        for (float& radius : tree.spheres.radiusWorld) radius *= float(0.75 + 0.25 * part(random));
        const auto faults = checkMeshCovered(tree, mesh, nullptr);
        for (const SphereTreeLevel& level : tree.levels) {
            bool anyOutside = false;
            for (int k = 0; k < 20000; ++k) {
                const auto& t = mesh.triangles[std::size_t(k) % mesh.triangles.size()];
                const double u = part(random), v = part(random) * (1 - u);
                const Vec3d a(mesh.points[t[0]]), b(mesh.points[t[1]]), c(mesh.points[t[2]]);
                const Vec3d point = a + u * (b - a) + v * (c - a);
                bool held = false;
                for (int32_t id = level.begin; id < level.end && !held; ++id) {
                    held = (tree.centerWorld(id) - point).length()
                        <= double(tree.spheres.radiusWorld[std::size_t(id)]);
                }
                anyOutside |= !held;
            }
            const std::string start = "level " + std::to_string(level.level) + " is not proven";
            bool reported = false;
            for (const TreeFault& fault : faults) reported |= fault.sentence.rfind(start, 0) == 0;
            // Every point outside is found; what is found may be less than what samples see.
            EXPECT_LE(anyOutside, reported) << n << ' ' << level.level;
        }
    }
}

TEST_F(MeshCheck, TakesTheObjectsCubesOnlyWhereSpheresCoverThem)
{
    const TriangleMesh mesh = bracket();
    const auto object = meshToObject(mesh, 1);
    const SphereTree tree = treeOf(*object, 0); // voxel centers alone
    EXPECT_FALSE(checkMeshCovered(tree, mesh, &*object).empty());
}

TEST_F(MeshCheck, RefusesSpheresThatCoverNothing)
{
    const TriangleMesh mesh = bracket();
    const auto object = meshToObject(mesh, 1);
    InnerOptions inner;
    inner.budget.spheres = {4};
    const SphereTree tree = buildSphereTree(*object, inner);
    EXPECT_THROW(checkMeshCovered(tree, mesh, &*object), openvdb::ValueError);
}

TEST_F(MeshCheck, StopsWhenAskedTo)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    const TriangleMesh mesh = bracket();
    const auto object = meshToObject(mesh, 1);
    const SphereTree tree = treeOf(*object, 0);
    EXPECT_THROW(checkMeshCovered(tree, mesh, &*object, &stop), Interrupted);
}

} // namespace
