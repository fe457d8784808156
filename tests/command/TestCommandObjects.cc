// SPDX-License-Identifier: Apache-2.0
// From grids, volumes and meshes to objects: cover=, ranges and labels, units, voxels that are no cubes;
// and warnings of what is seldom meant.

#include "CommandRunner.h"

#include <openvdb_spheretree/voxel/MakeGrid.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using command_test::CommandTest;
using command_test::Result;
using openvdb::Coord;

class CommandObjects : public CommandTest {
protected:
    void expectError(int code, const std::string& arguments, const std::string& message) const
    {
        const auto before = files();
        const Result result = run(arguments);
        EXPECT_EQ(result.exitCode, code) << arguments << "\n" << result.err;
        EXPECT_NE(result.err.find(message), std::string::npos) << arguments << "\n" << result.err;
        EXPECT_EQ(files(), before) << arguments;
    }

    /// The only grid that the line leaves.
    openvdb::GridBase::Ptr gridOf(const std::string& arguments) const
    {
        const Result result = run(arguments + " -write out.vdb");
        EXPECT_EQ(result.exitCode, 0) << arguments << "\n" << result.err;
        const auto grids = readGrids("out.vdb");
        EXPECT_EQ(grids.size(), 1u);
        return grids.at(0);
    }

    uint64_t voxelsOf(const std::string& arguments) const
    {
        return gridOf(arguments)->activeVoxelCount();
    }

    /// A volume of the values 0 to 5, in six slices; and its header's voxel size.
    void writeSlices(const std::string& name, const std::string& voxelSize) const
    {
        std::string values;
        for (char value = 0; value < 6; ++value) values += std::string(20 * 20, value);
        command_test::writeText(path(name),
            "X: 20\nY: 20\nZ: 6\nVersion: 2\nVoxel-Size: " + voxelSize + "\n.\n" + values);
    }

    /// A box of 2 x 3 x 4.
    void writeBoxMesh(const std::string& name) const
    {
        command_test::writeText(path(name),
            "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nv 0 0 4\nv 2 0 4\nv 2 3 4\nv 0 3 4\n"
            "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
    }
};

TEST_F(CommandObjects, MoreVoxelsMeetASolidThanLieInIt)
{
    writeGrids("ball.vdb", {sphereGrid("ball", 12)});
    const uint64_t met = voxelsOf("-read ball.vdb -mask cover=1");
    const uint64_t centers = voxelsOf("-read ball.vdb -mask cover=0");
    const uint64_t whole = voxelsOf("-read ball.vdb -mask cover=whole");
    EXPECT_EQ(centers, voxelsOf("-read ball.vdb -mask"));
    EXPECT_GT(met, centers);
    EXPECT_GT(centers, whole);
    EXPECT_EQ(met, voxelsOf("-read ball.vdb delayed=1 -mask cover=1"));
    expectError(2, "-read ball.vdb -mask cover=2 -write t.vdb", "it takes 0, 1, whole");
    auto bits = openvdb::BoolGrid::create();
    bits->tree().setValueOn(Coord(0));
    bits->setName("bits");
    writeGrids("bits.vdb", {bits});
    expectError(3, "-read bits.vdb -mask cover=1 -write t.vdb", "'bits' is none");
}

TEST_F(CommandObjects, ValuesThatAreNoNumbersAreTold)
{
    const auto fog = openvdb::FloatGrid::create();
    fog->setName("density");
    fog->fill(openvdb::CoordBBox(Coord(0), Coord(9)), 1.0f);
    writeGrids("whole.vdb", {fog});
    for (int i = 0; i < 3; ++i) fog->tree().setValue(Coord(i + 2, 4, 4), std::nanf(""));
    writeGrids("holes.vdb", {fog});
    const std::string told = "3 values are no numbers (NaN), and count as outside";
    for (const std::string action : {"-mask", "-mask cover=1", "-spheretree quality=fast"}) {
        const Result result = run("-read holes.vdb " + action + " -write t.vdb");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        const std::size_t at = result.err.find(told);
        ASSERT_NE(at, std::string::npos) << action << "\n" << result.err;
        EXPECT_NE(result.err.find("density"), std::string::npos) << result.err;
        EXPECT_EQ(result.err.find(told, at + 1), std::string::npos) << "twice: " << result.err;
        const Result whole = run("-read whole.vdb " + action + " -write t.vdb");
        EXPECT_EQ(whole.err.find("NaN"), std::string::npos) << whole.err;
    }
    const Result checked = run("-read holes.vdb -spheretree quality=fast -check -write t.vdb");
    EXPECT_EQ(checked.exitCode, 0) << checked.err;
    ASSERT_NE(checked.err.find(told), std::string::npos) << checked.err;
    EXPECT_EQ(checked.err.find(told), checked.err.rfind(told)) << checked.err;
    const Result later = run("-read holes.vdb t.vdb -check");
    EXPECT_EQ(later.exitCode, 0) << later.err;
    ASSERT_NE(later.err.find(told), std::string::npos) << later.err;
    EXPECT_EQ(later.err.find(told), later.err.rfind(told)) << later.err;
}

TEST_F(CommandObjects, RangesAndLabelsChooseValues)
{
    writeSlices("a.vol", "1");
    EXPECT_EQ(voxelsOf("-read a.vol -mask above=1 below=4"), 800u);
    EXPECT_EQ(voxelsOf("-read a.vol -mask above=3.5"), 800u);
    EXPECT_EQ(voxelsOf("-read a.vol -mask label=3,5"), 800u);
    EXPECT_EQ(voxelsOf("-read a.vol -mask label=2"), 400u);
    EXPECT_GT(voxelsOf("-read a.vol -mask above=1 below=4 cover=1"), 800u);
    expectError(3, "-read a.vol -mask below=4 -write t.vdb", "no bounds");
    expectError(3, "-read a.vol -mask label=7 -write t.vdb", "no value of label=7");
    expectError(2, "-read a.vol -mask above=1 threshold=2 -write t.vdb", "exclude");
    expectError(2, "-read a.vol -mask label=1 iso=2 -write t.vdb", "exclude");
    expectError(2, "-read a.vol -mask label=1 below=2 -write t.vdb", "label excludes above");
    expectError(2, "-read a.vol -mask label=1 cover=1 -write t.vdb", "label excludes cover");
    expectError(2, "-read a.vol -mask label=1.5 -write t.vdb", "label=1.5 is not understood");
    expectError(2, "-read a.vol -mask above=4 below=1 -write t.vdb", "no value is above 4");
    writeGrids("ls.vdb", {sphereGrid("ball")});
    expectError(3, "-read ls.vdb -mask above=1 -write t.vdb", "use iso=");
    expectError(3, "-read ls.vdb -mask label=1 -write t.vdb", "use iso=");
}

TEST_F(CommandObjects, ALabelOf64BitsKeepsItsLastDigit)
{
    std::string values(8 * 8, '\0');
    for (int n = 0; n < 8; ++n) {
        values[8 * n + 7] = 0x40; // 2^62
        values[8 * n] = char(n);
    }
    command_test::writeText(path("a.longvol"), "X: 8\nY: 1\nZ: 1\nVersion: 2\n.\n" + values);
    EXPECT_EQ(voxelsOf("-read a.longvol -mask label=4611686018427387907"), 1u);
    EXPECT_EQ(voxelsOf("-read a.longvol -mask above=4611686018427387907"), 4u);
    EXPECT_EQ(
        voxelsOf("-read a.longvol -mask above=4611686018427387905 below=4611686018427387908"), 2u);
}

TEST_F(CommandObjects, DustIsDroppedAndCavitiesAreFilled)
{
    std::string values(10 * 10 * 10, '\0');
    for (int n = 0; n < 1000; ++n) {
        const int x = n % 10, y = n / 10 % 10, z = n / 100;
        if (x < 5 && y < 5 && z < 5) values[n] = 1;
    }
    values[2 + 20 + 200] = 0; // a cavity
    values[999] = 1;          // dust
    writeVol("a.vol", Coord(10), values);
    EXPECT_EQ(voxelsOf("-read a.vol -mask"), 125u);
    EXPECT_EQ(voxelsOf("-read a.vol -mask largest=1"), 124u);
    EXPECT_EQ(voxelsOf("-read a.vol -mask fill=1"), 126u);
    EXPECT_EQ(voxelsOf("-read a.vol -mask largest=1 fill=1"), 125u);
}

TEST_F(CommandObjects, UnitsBecomeMetres)
{
    writeBoxMesh("box.obj");
    const auto sizeOf = [&](const std::string& reading) {
        return gridOf("-read box.obj " + reading + " -mesh2ls dim=40")->voxelSize()[0];
    };
    EXPECT_NEAR(sizeOf(""), 0.1, 1e-6);
    EXPECT_NEAR(sizeOf("scale=2.5"), 0.25, 1e-6);
    EXPECT_NEAR(sizeOf("units=cm"), 0.001, 1e-8);
    EXPECT_NEAR(sizeOf("units=ft"), 0.03048, 1e-7);
    writeSlices("a.vol", "1");
    EXPECT_NEAR(gridOf("-read a.vol units=mm -mask")->voxelSize()[0], 0.001, 1e-12);
    writeGrids("ls.vdb", {sphereGrid("ball")});
    EXPECT_EQ(
        voxelsOf("-read ls.vdb scale=10 -mask iso=5"), voxelsOf("-read ls.vdb -mask iso=0.5"));
    expectError(2, "-read box.obj scale=2 units=mm -mesh2ls -write t.vdb", "exclude each other");
    expectError(2, "-read box.obj units=parsec -mesh2ls -write t.vdb", "mm, cm, m, in, ft, um, km");
    expectError(2, "-read box.obj scale=0 -mesh2ls -write t.vdb", "scale=0");
    command_test::writeText(
        path("huge.obj"), "v 0 0 0\nv 1e20 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\n");
    expectError(3, "-read huge.obj scale=1e30 -mesh2ls dim=9 -write t.vdb", "a smaller scale");
    ASSERT_EQ(run("-read a.vol -spheretree quality=fast -write tree.vdb").exitCode, 0);
    expectError(3, "-read tree.vdb units=mm -write t.vdb", "read the tree by a -read of its own");
}

TEST_F(CommandObjects, VoxelsThatAreNoCubesAreMadeCubes)
{
    writeSlices("a.vol", "0.5 0.5 1");
    expectError(3, "-read a.vol -spheretree -write t.vdb", "-resample voxel=0.5");
    expectError(3, "-read a.vol -spheretree -write t.vdb", "for labels with nearest=1");
    expectError(3, "-read a.vol -resample voxel=0.5 -mask label=3 -write t.vdb", "nearest=1");
    const auto grid = gridOf("-read a.vol -resample voxel=0.5");
    EXPECT_EQ(grid->type(), "Tree_int32_5_4_3");
    EXPECT_EQ(grid->getName(), "a");
    EXPECT_EQ(grid->voxelSize(), openvdb::Vec3d(0.5));
    EXPECT_EQ(voxelsOf("-read a.vol -resample -mask above=3.5"),
        voxelsOf("-read a.vol -resample 0.5 "
                 "-mask above=3.5"));
    EXPECT_EQ(
        run("-read a.vol -resample 1 name=b -spheretree quality=fast -check -write t.vdb").exitCode,
        0);
    EXPECT_EQ(voxelsOf("-read a.vol -resample voxel=0.5 nearest=1 -mask label=3"), 800u);
    expectError(3, "-read a.vol -resample voxel=1e-4 -write u.vdb", "larger voxel");
    const std::string huge = run("-quiet -read a.vol -resample voxel=300 -write u.vdb").err;
    EXPECT_NE(huge.find("is larger than all of grid 'a'"), std::string::npos) << huge;
    for (const std::string size : {"0.5 0.5", "1 2 3 4", "1 x 1", "1 0 1", ""}) {
        writeSlices("bad.vol", size);
        expectError(3, "-read bad.vol -mask -write u.vdb", "'Voxel-Size'");
    }
}

TEST_F(CommandObjects, FewVoxelsAndFlatObjectsAreWarnedOf)
{
    const auto warnings = [&](const std::string& size, const std::string& options) {
        writeVol("a.vol", size == "small" ? Coord(8, 8, 8) : Coord(20, 20, 1),
            std::string(size == "small" ? 512 : 400, '\1'));
        const std::string err = run("-quiet -read a.vol -spheretree quality=fast " + options).err;
        return std::to_string(std::count(err.begin(), err.end(), '\n')) + " " + err;
    };
    EXPECT_EQ(warnings("flat", "dim=2"), "0 ");
    EXPECT_NE(warnings("flat", "")
                  .find("one voxel thick along z: a picture or a slice wants -spheretree dim=2"),
        std::string::npos);
    EXPECT_EQ(warnings("flat", "")[0], '1');
    EXPECT_NE(
        warnings("small", "").find("only 8 voxels across its longest side"), std::string::npos);
    EXPECT_EQ(warnings("small", "")[0], '1');
    EXPECT_NE(warnings("small", "").find("'a'"), std::string::npos);
}

} // namespace
