// SPDX-License-Identifier: Apache-2.0
// Volume, center of mass and inertia in what -stats prints and writes.

#include "CommandRunner.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;
using command_test::writeText;

/// A box of 4 x 6 x 8 voxels of 0.5, whose first voxel is at the origin.
class CommandMass : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeText(path("box.vol"),
            "X: 4\nY: 6\nZ: 8\nVoxel-Size: 0.5\nVersion: 2\n.\n" + std::string(192, '\1'));
    }

    nlohmann::json statsOf(const std::string& actions)
    {
        const Result result = run("-quiet " + actions + " json=numbers.json");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return nlohmann::json::parse(readText(path("numbers.json")));
    }
};

/// Mass 24, sides 2, 3, 4.
void expectBox(const nlohmann::json& mass)
{
    EXPECT_EQ(mass["volume"], 24);
    EXPECT_EQ(mass["center"], nlohmann::json({0.75, 1.25, 1.75}));
    const double expected[] = {2 * 13, 2 * 20, 2 * 25};
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(mass["principal_moments"][i], expected[i], 1e-12);
        EXPECT_NEAR(mass["inertia"][2 - i][2 - i], expected[i], 1e-12);
        EXPECT_EQ(std::abs(double(mass["principal_axes"][i][2 - i])), 1);
    }
}

TEST_F(CommandMass, ThatOfTheObjectIsAlwaysThere)
{
    const nlohmann::json stats = statsOf("-read box.vol -spheretree tree=reversible -stats");
    expectBox(stats["mass"]);
    EXPECT_EQ(stats["levels"][0].count("mass"), 0u);
    const Result table = run("-read box.vol -spheretree -stats");
    EXPECT_NE(
        table.out.find("mass of the object, of density 1: 24 at (0.75, 1.25, 1.75), principal "
                       "moments (26, 40, 50)"),
        std::string::npos)
        << table.out;
}

TEST_F(CommandMass, ThatOfATreeAloneIsNotKnown)
{
    EXPECT_EQ(run("-read box.vol -spheretree -write t.vdb").exitCode, 0);
    EXPECT_TRUE(statsOf("-read t.vdb -stats")["mass"].is_null());
    EXPECT_EQ(run("-read t.vdb -stats").out.find("mass"), std::string::npos);
    expectBox(statsOf("-read box.vol t.vdb -stats mass=1")["mass"]);
}

TEST_F(CommandMass, OfLevelsAreOfTheirSpheresAsStored)
{
    // The leaf balls of a reversible tree without padding hold the object's voxels, and no others.
    const nlohmann::json stats =
        statsOf("-read box.vol -spheretree tree=reversible padding=0 -stats mass=1");
    expectBox(stats["levels"][0]["mass"]);
    const nlohmann::json padded =
        statsOf("-read box.vol -spheretree tree=reversible padding=1 -stats mass=1");
    EXPECT_GT(padded["levels"][0]["mass"]["volume"], 24);
}

TEST_F(CommandMass, OfLevelsAreInTableAndCsvAsInJson)
{
    const std::string build = "-read box.vol -spheretree tree=reversible padding=0 -stats mass=1";
    const Result csv = run(build + " csv=-");
    EXPECT_NE(
        csv.out.find(",dice,volume,center_x,center_y,center_z,inertia_xx,inertia_yy,inertia_zz,"
                     "inertia_xy,inertia_xz,inertia_yz\n0,"),
        std::string::npos)
        << csv.out;
    EXPECT_NE(csv.out.find(",24,0.75,1.25,1.75,50,40,26,0,0,0\n"), std::string::npos) << csv.out;
    const Result table = run(build);
    EXPECT_NE(table.out.find("volume  of object %"), std::string::npos) << table.out;
    EXPECT_NE(table.out.find("24       100.00"), std::string::npos) << table.out;
    EXPECT_EQ(run("-read box.vol -spheretree -stats csv=-").out.find("volume"), std::string::npos);
}

TEST_F(CommandMass, FilesOfRobotsHaveThatOfTheSpheresOrOfTheObject)
{
    const std::string tree = "-read box.vol -spheretree spheres=1 ";
    const Result spheres = run(tree + "-write s.urdf density=2");
    EXPECT_EQ(spheres.exitCode, 0) << spheres.err;
    EXPECT_NE(
        spheres.err.find("mass and inertia are those of the spheres together"), std::string::npos)
        << spheres.err;
    const Result object = run(tree + "-write o.urdf o.mjcf density=2 mass=object");
    EXPECT_EQ(object.exitCode, 0) << object.err;
    EXPECT_EQ(object.err.find("of the spheres together"), std::string::npos) << object.err;
    const std::string urdf = readText(path("o.urdf"));
    EXPECT_NE(urdf.find("<origin xyz=\"0.75 1.25 1.75\""), std::string::npos) << urdf;
    EXPECT_NE(urdf.find("<mass value=\"48\"/>"), std::string::npos) << urdf;
    EXPECT_NE(urdf.find("ixx=\"100\" "), std::string::npos) << urdf;
    EXPECT_NE(readText(path("o.mjcf")).find("mass=\"48\""), std::string::npos);
    // Of a tree that is read, the object is another file.
    EXPECT_EQ(run(tree + "-write t.vdb").exitCode, 0);
    const Result alone = run("-read t.vdb -write a.urdf mass=object");
    EXPECT_EQ(alone.exitCode, 3);
    EXPECT_NE(alone.err.find("mass=object: no grid on the stack has the voxels"), std::string::npos)
        << alone.err;
    // Spheres of others meet the object here, too.
    writeText(path("ball.csv"), "x,y,z,r\n0.75,1.25,1.75,3\n");
    EXPECT_EQ(run("-read ball.csv box.vol -write b.urdf density=2 mass=object").exitCode, 0);
    EXPECT_NE(readText(path("b.urdf")).find("<mass value=\"48\"/>"), std::string::npos);
    EXPECT_EQ(run("-read box.vol t.vdb -write a.urdf density=2 mass=object").exitCode, 0);
    EXPECT_NE(readText(path("a.urdf")).find("<mass value=\"48\"/>"), std::string::npos);
}

TEST_F(CommandMass, WhereSpheresAreTooLargeTheReasonIsSaid)
{
    writeText(path("far.csv"), "x,y,z,r\n0,0,0,100000\n");
    const std::string line = "-read box.vol far.csv -stats mass=1";
    const nlohmann::json level = statsOf(line)["levels"][0];
    EXPECT_TRUE(level["mass"].is_null());
    EXPECT_NE(level["mass_unknown"].get<std::string>().find("rows of voxels"), std::string::npos);
    const Result table = run(line);
    EXPECT_NE(table.out.find("'-' for mass: the spheres of level 0 cross more"), std::string::npos)
        << table.out;
    EXPECT_NE(run(line + " csv=-").out.find(",,,,,,,,,,\n"), std::string::npos);
}

TEST_F(CommandMass, SpheresThatHoldNoVoxelHaveNone)
{
    writeText(path("small.csv"), "x,y,z,r\n0.25,0.25,0.25,0.01\n");
    const nlohmann::json level = statsOf("-read box.vol small.csv -stats mass=1")["levels"][0];
    EXPECT_TRUE(level["mass"].is_null());
    EXPECT_EQ(level["mass_unknown"], "no voxel center lies in the spheres of the level");
}

} // namespace
