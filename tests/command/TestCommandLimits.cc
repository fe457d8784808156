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

TEST_F(CommandLimits, LevelSetsOfTooManyVoxelsAreRefusedWithTheNumber)
{
    writeCube("cube.vdb", openvdb::Coord(0));
    expectRefused("-read cube.vdb -spheretree extended -spheres2ls voxel=0.002 -write s.vdb",
        "1073741824 is the most: use a larger voxel");
    expectRefused("-read cube.vdb -spheretree extended -spheres2ls width=1000 -write s.vdb",
        "a narrower band");
}

} // namespace
