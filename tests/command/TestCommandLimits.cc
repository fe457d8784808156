// SPDX-License-Identifier: Apache-2.0
// Objects at the ends of coordinates, and results that would not fit anywhere: exit code 3 and a
// sentence before the work, or the right result.

#include "CommandRunner.h"

#include <openvdb_spheretree/voxel/MaskGrids.h>

#include <openvdb/Grid.h>

#include <cstdint>

namespace {

using command_test::CommandTest;
using command_test::Result;
using command_test::writeText;

class CommandLimits : public CommandTest {
protected:
    /// A cube of 8^3 voxels.
    void writeCube(const std::string& name, const openvdb::Coord& corner) const
    {
        auto cube = openvdb::BoolGrid::create();
        cube->setName("cube");
        for (int n = 0; n < 512; ++n) { // a loop over a box would step beyond the last coordinate
            cube->tree().setValueOn(corner.offsetBy(n / 64, n / 8 % 8, n % 8), true);
        }
        writeGrids(name, {cube});
    }

    void expectRefused(const std::string& line, const std::string& part) const
    {
        const auto before = files();
        const Result result = run(line);
        EXPECT_EQ(result.exitCode, 3) << line << result.err;
        EXPECT_NE(result.err.find(part), std::string::npos) << line << result.err;
        EXPECT_EQ(files(), before);
    }
};

TEST_F(CommandLimits, TreesOfObjectsAtTheEndsOfCoordinatesAreRefused)
{
    for (const int corner : {INT32_MAX - 7, INT32_MAX - 8, INT32_MIN, INT32_MIN + 1}) {
        writeCube("end.vdb", openvdb::Coord(0, corner, 0));
        for (const std::string tree : {"quality=fast", "quality=best spheres=4", "cover=balls",
                 "extended", "reversible", "side=inner"}) {
            expectRefused("-read end.vdb -spheretree " + tree + " -write t.vdb",
                corner < 0 ? "too near the first coordinate along y"
                           : "too near the last coordinate along y");
        }
    }
}

/// They need no room around.
TEST_F(CommandLimits, MasksAndPicturesOfThemAreRight)
{
    for (const int corner : {INT32_MAX - 7, INT32_MIN}) {
        writeCube("end.vdb", openvdb::Coord(corner));
        const Result mask = run("-read end.vdb -mask -write m.vdb -print");
        EXPECT_EQ(mask.exitCode, 0) << mask.err;
        EXPECT_NE(mask.out.find("512 active voxels"), std::string::npos) << mask.out;
        const Result picture = run("-read end.vdb -write p.png width=32 height=24");
        EXPECT_EQ(picture.exitCode, 0) << picture.err;
    }
}

TEST_F(CommandLimits, AnObjectFromTheFirstCoordinateToTheLastIsAsWideAsItIs)
{
    auto ends = openvdb::BoolGrid::create();
    ends->setName("ends");
    for (const int x : {INT32_MIN, INT32_MAX}) {
        ends->tree().setValueOn(openvdb::Coord(x, 3, 4), true);
    }
    writeGrids("ends.vdb", {ends});
    const Result printed = run("-read ends.vdb -print");
    EXPECT_EQ(printed.exitCode, 0) << printed.err;
    EXPECT_NE(printed.out.find("box 4294967296 x 1 x 1"), std::string::npos) << printed.out;
    const Result asked = run("-read ends.vdb -eval {0:gridDim}");
    EXPECT_NE(asked.out.find("[4294967296, 1, 1]"), std::string::npos) << asked.out << asked.err;
    const std::string wide = "4294967296 voxels wide along x, more than 2^28";
    for (const std::string tree :
        {"quality=fast distance=5", "distance=5", "extended center=miniball", "side=inner"}) {
        expectRefused("-read ends.vdb -spheretree " + tree + " -write t.vdb", wide);
    }
    const Result result = run("-read ends.vdb -spheretree quality=fast distance=5");
    EXPECT_EQ(result.err.find("size of the object"), std::string::npos) << result.err;
    writeText(path("balls.csv"), "x,y,z,radius\n0,3,4,2\n9,3,4,2\n");
    const Result given = run("-read ends.vdb balls.csv -stats");
    EXPECT_EQ(given.exitCode, 0) << given.err;
    EXPECT_NE(given.out.find("box 4294967296 x 1 x 1"), std::string::npos) << given.out;
}

TEST_F(CommandLimits, LevelSetsOfTooManyVoxelsAreRefusedWithTheNumber)
{
    writeCube("cube.vdb", openvdb::Coord(0));
    expectRefused("-read cube.vdb -spheretree extended -spheres2ls voxel=0.002 -write s.vdb",
        "1073741824 is the most: use a larger voxel");
    expectRefused("-read cube.vdb -spheretree extended -spheres2ls width=1000 -write s.vdb",
        "a narrower band");
}

} // namespace
