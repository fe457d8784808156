// SPDX-License-Identifier: Apache-2.0
/// @file TestMeshCheck.cc
/// @brief Whether stored spheres cover a mesh: trees that do, and trees that were damaged so that they do not.

#include "support/Meshes.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/MeshCheck.h>
#include <openvdb_spheretree/solid/MeshSolid.h>
#include <openvdb_spheretree/tree/GivenTree.h>

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

/// Radii are smaller than they ought to be: spheres hold only some of the surface.
TEST_F(MeshCheck, AgreesWithPointsOfTheSurface)
{
    const TriangleMesh mesh = bracket();
    const auto object = meshToObject(mesh, 1);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> part(0, 1);
    int quiet = 0;
    for (int n = 0; n < 12; ++n) {
        SphereTree tree = treeOf(*object, SphereTreeSettings::kPadCubes);
        const double least = n < 4 ? 0.99 : 0.75;
        for (float& radius : tree.spheres.radiusWorld) {
            radius *= float(least + (1 - least) * part(random));
        }
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
            quiet += !reported;
        }
    }
    EXPECT_GE(quiet, 6) << "half of those whose radii are all but right";
}

/// The cubes that a level covers are those of the object, not those of the mesh.
TEST_F(MeshCheck, FindsWhatAnObjectLacksOfTheMesh)
{
    const TriangleMesh mesh = bracket();
    const auto object = meshToObject(mesh, 1);
    const openvdb::CoordBBox arm({9, -5, -5}, {30, 30, 30});
    object->fill(arm, false, false);
    const SphereTree tree = treeOf(*object, SphereTreeSettings::kPadCubes);
    const auto faults = checkMeshCovered(tree, mesh, &*object);
    EXPECT_EQ(tree.levels.size(), faults.size());
    for (const TreeFault& fault : faults) EXPECT_EQ(FaultKind::Surface, fault.kind);
}

TEST_F(MeshCheck, FindsATriangleThatIsALine)
{
    TriangleMesh mesh = bracket();
    const auto object = meshToObject(mesh, 1);
    const SphereTree tree = treeOf(*object, SphereTreeSettings::kPadCubes);
    const auto first = uint32_t(mesh.points.size());
    for (const float x : {0.5f, 50.f, 100.f}) mesh.points.emplace_back(x, 2.f, 2.f);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    const auto faults = checkMeshCovered(tree, mesh, &*object);
    ASSERT_EQ(tree.levels.size(), faults.size());
    EXPECT_NE(std::string::npos, faults[0].sentence.find("pieces of triangles without area"))
        << faults[0].sentence;
}

/// Voxels have coordinates of 32 bits, the mesh is beyond them.
TEST_F(MeshCheck, OfAMeshFarFromItsTreeSaysThatNothingIsCovered)
{
    const TriangleMesh mesh = bracket();
    const auto object = meshToObject(mesh, 1);
    for (const double away : {1e4, 1e10, 1e15}) {
        const auto moved = object->deepCopy();
        moved->transform().postTranslate(Vec3d(away, 0, -away));
        const SphereTree tree = treeOf(*moved, SphereTreeSettings::kPadCubes);
        const auto faults = checkMeshCovered(tree, mesh, &*moved);
        ASSERT_EQ(tree.levels.size(), faults.size()) << away;
        EXPECT_NE(std::string::npos, faults[0].sentence.find(": 100% of its surface"))
            << faults[0].sentence;
    }
}

/// In pieces of a voxel it would be 10^12 of them.
TEST_F(MeshCheck, OfAHugeTriangleLooksOnlyAtWhatIsNearTheObject)
{
    const auto object = meshToObject(bracket(), 1);
    const SphereTree tree = treeOf(*object, SphereTreeSettings::kPadCubes);
    TriangleMesh mesh;
    mesh.name = "huge";
    mesh.points = {openvdb::Vec3d(-1e6f, -1e6f, 5), openvdb::Vec3d(1e6f, -1e6f, 5),
        openvdb::Vec3d(0, 1e6f, 5)};
    mesh.triangles = {openvdb::Vec3I(0, 1, 2)};
    EXPECT_EQ(tree.levels.size(), checkMeshCovered(tree, mesh, &*object).size());
}

TEST_F(MeshCheck, TakesTheObjectsCubesOnlyWhereSpheresCoverThem)
{
    const TriangleMesh mesh = bracket();
    const auto object = meshToObject(mesh, 1);
    const SphereTree tree = treeOf(*object, 0); // voxel centers alone
    EXPECT_FALSE(checkMeshCovered(tree, mesh, &*object).empty());
}

/// The proof of the mesh takes cubes of the object on trust, so it is not asked alone.
TEST_F(MeshCheck, AgainstVoxelsAndTheMeshNamesWhatEitherFinds)
{
    TriangleMesh mesh = bracket();
    const auto object = meshToObject(mesh, 1);
    SphereTree tree = treeOf(*object, SphereTreeSettings::kPadCubes);
    EXPECT_TRUE(checkAgainst(tree, &*object, &mesh).empty());
    for (float& radius : tree.spheres.radiusWorld) radius *= 0.5f;
    EXPECT_TRUE(checkMeshCovered(tree, mesh, &*object).empty()) << "all of it lies in cubes";
    const auto ofVoxels = checkAgainst(tree, &*object, nullptr);
    ASSERT_FALSE(ofVoxels.empty());
    for (const TreeFault& fault : ofVoxels) EXPECT_NE(FaultKind::Surface, fault.kind);
    EXPECT_EQ(ofVoxels.size(), checkAgainst(tree, &*object, &mesh).size());
    const auto ofMesh = checkAgainst(tree, nullptr, &mesh);
    EXPECT_EQ(tree.levels.size(), ofMesh.size());
    for (const TreeFault& fault : ofMesh) EXPECT_EQ(FaultKind::Surface, fault.kind);
    EXPECT_TRUE(checkAgainst(tree, nullptr, nullptr).empty());

    addBox(mesh, Vec3d(50), Vec3d(60)); // not in the object
    const auto all = checkAgainst(tree, &*object, &mesh);
    EXPECT_EQ(ofVoxels.size() + tree.levels.size(), all.size());
    EXPECT_EQ(ofVoxels.front().sentence, all.front().sentence);
    EXPECT_EQ(FaultKind::Surface, all.back().kind);
}

/// Centers of spheres of others are rounded by up to 1/2048 voxel along an axis: what holds a corner only
/// thanks to that proves nothing.
TEST_F(MeshCheck, OfSpheresOfOthersAllowsForTheirRounding)
{
    const TriangleMesh mesh = boxMesh(Vec3d(-5), Vec3d(5));
    const auto object = meshToObject(mesh, 1);
    WorldSpheres spheres;
    spheres.center = {Vec3d(0.00048, 0, 0)};
    spheres.radius = {std::sqrt(75.0) + 1e-7}; // 2.8e-4 too small
    EXPECT_EQ(1u, checkMeshCovered(givenTree(spheres, *object), mesh, nullptr).size());
    spheres.radius[0] += 2e-3;
    EXPECT_TRUE(checkMeshCovered(givenTree(spheres, *object), mesh, nullptr).empty());
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
