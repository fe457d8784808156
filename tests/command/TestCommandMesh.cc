// SPDX-License-Identifier: Apache-2.0
/// @file TestCommandMesh.cc
/// @brief Meshes and what covers them: -mesh2ls with cover=, fill= and gap=, its warnings, and -check with the mesh on
/// the stack.

#include "CommandRunner.h"

#include "support/Meshes.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>
#include <string>

using namespace command_test;
using namespace spheretree_test;
using openvdb::Vec3d;

namespace {

/// A cube of 60 with a flange of 200 that is 1.5 thick.
openvdb_spheretree::TriangleMesh flange()
{
    auto mesh = boxMesh(Vec3d(0), Vec3d(60));
    addBox(mesh, Vec3d(59, 10, 29.4), Vec3d(260, 50, 30.9));
    return mesh;
}

class CommandMesh : public CommandTest {
protected:
    void write(const std::string& name, const openvdb_spheretree::TriangleMesh& mesh)
    {
        std::ostringstream text;
        text.precision(17);
        for (const auto& p : mesh.points)
            text << "v " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
        for (const auto& t : mesh.triangles) {
            text << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
        }
        writeText(path(name), text.str());
    }
};

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

TEST_F(CommandMesh, WarnsOfThinPartsThatAnObjectLacks)
{
    write("flange.obj", flange());
    const Result result =
        run("-read flange.obj -mesh2ls dim=40 -spheretree spheres=8 quality=fast -stats");
    EXPECT_EQ(0, result.exitCode);
    EXPECT_TRUE(has(result.err, "the object of mesh 'flange' lacks thin parts: ")) << result.err;
    EXPECT_TRUE(has(result.err, "cover=1")) << result.err;
    EXPECT_FALSE(has(run("-read flange.obj -mesh2ls dim=40 cover=1").err, "warning"));
    write("cube.obj", boxMesh(Vec3d(0.3), Vec3d(60)));
    EXPECT_FALSE(has(run("-read cube.obj -mesh2ls dim=40").err, "warning"));
}

TEST_F(CommandMesh, TellsOfAMeshThatIsThinnerThanAVoxelAltogether)
{
    write("plate.obj", boxMesh(Vec3d(0.1), Vec3d(60, 50, 0.3)));
    const Result result = run("-read plate.obj -mesh2ls dim=40 -spheretree -write t.vdb");
    EXPECT_EQ(3, result.exitCode);
    EXPECT_TRUE(has(result.err, "holds no center of a voxel of 1.498")) << result.err;
    EXPECT_TRUE(has(result.err, "cover=1")) << result.err;
    EXPECT_EQ(0, run("-read plate.obj -mesh2ls dim=40 cover=1 -spheretree -write t.vdb").exitCode);
}

TEST_F(CommandMesh, CheckProvesThatSpheresCoverTheMesh)
{
    write("flange.obj", flange());
    const std::string tree = " keep=1 -spheretree spheres=40,9,1 quality=fast -check";
    const Result covered = run("-read flange.obj -mesh2ls dim=40 cover=1" + tree);
    EXPECT_EQ(0, covered.exitCode) << covered.err;
    EXPECT_EQ("all checks hold\nevery triangle of mesh 'flange' lies in the stored spheres of "
              "every level\n",
        covered.out);
    const Result lacking = run("-read flange.obj -mesh2ls dim=40 cover=0" + tree);
    EXPECT_EQ(6, lacking.exitCode);
    EXPECT_TRUE(has(lacking.out, "level 0 is not proven to cover mesh 'flange': ")) << lacking.out;
    EXPECT_TRUE(has(lacking.err, "covers all voxels of its object, but not all of the mesh"))
        << lacking.err;
    EXPECT_TRUE(has(lacking.err, "-mesh2ls cover=1")) << lacking.err;
}

/// In the meters of a map, where floats are half a meter apart: asked of the spheres as they are written.
TEST_F(CommandMesh, SpheresCoverAMeshThatLiesFarAway)
{
    const auto mesh = boxMesh(Vec3d(5400000.3, 2700000.1, 0), Vec3d(5400001.6, 2700001.4, 1.3));
    write("map.obj", mesh);
    const Result result = run("-read map.obj -mesh2ls dim=48 cover=1 keep=1 -spheretree "
                              "spheres=8,1 quality=fast -check -write map.json");
    EXPECT_EQ(0, result.exitCode) << result.err;
    const auto tree = nlohmann::json::parse(readText(path("map.json")));
    for (const int level : {0, 1}) {
        for (const Vec3d& corner : mesh.points) {
            bool isHeld = false;
            for (const auto& node : tree["nodes"]) {
                const Vec3d center(node[3], node[4], node[5]);
                isHeld |= node[0] == level && (corner - center).length() <= double(node[6]);
            }
            EXPECT_TRUE(isHeld) << corner << " on level " << level;
        }
    }
}

TEST_F(CommandMesh, CheckTakesATreeOfAFileAndItsMeshAlone)
{
    write("flange.obj", flange());
    ASSERT_EQ(0,
        run("-read flange.obj -mesh2ls dim=40 cover=1 -spheretree spheres=40 quality=fast -write "
            "t.vdb")
            .exitCode);
    const Result result = run("-read flange.obj t.vdb -check");
    EXPECT_EQ(0, result.exitCode) << result.err;
    EXPECT_EQ(
        "every triangle of mesh 'flange' lies in the stored spheres of every level\n", result.out);
    EXPECT_TRUE(has(result.err, "what is inside of the mesh was not looked at")) << result.err;
}

TEST_F(CommandMesh, CheckSaysThatTheMeshIsGone)
{
    write("flange.obj", flange());
    const auto told = [&](const std::string& keep) {
        return run("-read flange.obj -mesh2ls dim=20 cover=1 " + keep
            + " -spheretree spheres=2 quality=fast -check")
            .err;
    };
    EXPECT_TRUE(has(told(""), "keep=1 of -mesh2ls leaves it for -check")) << told("");
    EXPECT_FALSE(has(told("keep=1"), "leaves it for -check"));
}

TEST_F(CommandMesh, CheckSaysWhatItDoesNotHoldAgainstTheMesh)
{
    write("flange.obj", flange());
    for (const std::string side : {"fit", "inner"}) {
        const Result result =
            run("-read flange.obj -mesh2ls dim=40 cover=1 keep=1 -spheretree spheres=9 side=" + side
                + " -check");
        EXPECT_EQ(0, result.exitCode) << result.err;
        EXPECT_EQ("all checks hold\n", result.out);
        EXPECT_TRUE(has(result.err, "spheres of side=" + side + " need not cover anything"))
            << result.err;
    }
}

TEST_F(CommandMesh, ADistanceBeyondTheObjectsSizeIsWarnedOf)
{
    write("flange.obj", flange());
    const std::string line =
        "-read flange.obj units=mm -mesh2ls dim=40 -spheretree quality=fast distance=";
    EXPECT_TRUE(
        has(run(line + "5 -write t.csv").err, "distance=5 is more than the size of the object"));
    EXPECT_FALSE(has(run(line + "5mm -write t.csv").err, "more than the size"));
}

TEST_F(CommandMesh, AMeshOfOtherUnitsThanItsTreeIsWarnedOf)
{
    write("flange.obj", flange());
    ASSERT_EQ(
        run("-read flange.obj units=mm -mesh2ls dim=40 cover=1 -spheretree spheres=4 -write t.vdb")
            .exitCode,
        0);
    const Result other = run("-read flange.obj t.vdb -check");
    EXPECT_EQ(other.exitCode, 6);
    EXPECT_NE(other.err.find("mesh 'flange' is 970 times as large"), std::string::npos)
        << other.err;
    const Result larger = run("-quiet -read flange.obj units=um -read t.vdb -check");
    EXPECT_NE(larger.err.find("times as small"), std::string::npos) << larger.err;
    const Result same = run("-read flange.obj units=mm -read t.vdb -check");
    EXPECT_FALSE(has(same.err, "same unit")) << same.err;
}

TEST_F(CommandMesh, FillsAnOpenMeshFromOutside)
{
    auto mesh = boxMesh(Vec3d(0.2), Vec3d(40));
    mesh.triangles.pop_back(); // half of a side
    write("open.obj", mesh);
    const std::string tail = " -spheretree spheres=1 quality=fast -stats";
    const Result open = run("-read open.obj -mesh2ls voxel=1 cover=1" + tail);
    EXPECT_TRUE(has(open.err, "fill=outside")) << open.err;
    EXPECT_FALSE(has(open.out, " 68,9")) << open.out;
    const Result filled = run("-read open.obj -mesh2ls voxel=1 fill=outside gap=40" + tail);
    EXPECT_TRUE(has(filled.out, "box 41 x 41 x 41")) << filled.out << filled.err;
    EXPECT_FALSE(has(filled.err, "warning")) << filled.err;
    const Result hollow = run("-quiet -read open.obj -mesh2ls voxel=1 fill=outside gap=4" + tail);
    EXPECT_TRUE(has(hollow.err, "% of it has nothing inside")) << hollow.err;
    EXPECT_TRUE(has(hollow.err, "wider than gap=4, so make gap larger")) << hollow.err;
}

TEST_F(CommandMesh, RefusesOptionsThatSayNothing)
{
    write("a.obj", boxMesh(Vec3d(0), Vec3d(9)));
    const std::pair<const char*, const char*> lines[] = {{"gap=3", "fill=outside"},
        {"fill=outside cover=0", "leave cover=0 out"}, {"cover=1 width=4", "makes no level set"}};
    for (const auto& [options, message] : lines) {
        const Result result = run(std::string("-read a.obj -mesh2ls ") + options);
        EXPECT_EQ(2, result.exitCode) << options;
        EXPECT_TRUE(has(result.err, message)) << result.err;
    }
    const Result far = run("-read a.obj -mesh2ls dim=9 fill=outside gap=1e9");
    EXPECT_EQ(3, far.exitCode);
    EXPECT_TRUE(has(far.err, "gap=1e+09 is out of range")) << far.err;
}

TEST_F(CommandMesh, RefusesVoxelsThatAreTooManyBeforeAnyWork)
{
    write("a.obj", boxMesh(Vec3d(0), Vec3d(10000)));
    const Result result = run("-read a.obj -mesh2ls voxel=0.02 cover=1");
    EXPECT_EQ(3, result.exitCode);
    EXPECT_TRUE(has(result.err, "in a box of 1.3e+17 voxels, need about")) << result.err;
}

TEST_F(CommandMesh, KeepsTheLargestPartAndFillsCavities)
{
    auto mesh = boxMesh(Vec3d(0), Vec3d(40));
    addBox(mesh, Vec3d(60), Vec3d(65));
    write("two.obj", mesh);
    const std::string tree = " -spheretree tree=reversible errors=0 -stats";
    EXPECT_TRUE(
        has(run("-read two.obj -mesh2ls voxel=1 cover=1 -mask" + tree).out, "box 66 x 66 x 66"));
    EXPECT_TRUE(has(run("-read two.obj -mesh2ls voxel=1 cover=1 -mask largest=1" + tree).out,
        "box 41 x 41 x 41"));
    const Result shell = run("-read two.obj -mesh2ls voxel=1 -mask iso=0 largest=1 fill=1" + tree);
    EXPECT_EQ(0, shell.exitCode) << shell.err;
}

} // namespace
