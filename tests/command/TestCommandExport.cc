// SPDX-License-Identifier: Apache-2.0
// -write of files for other tools: which one it is, what it says of them, and nothing half-written.

#include "CommandRunner.h"

#include "support/DataFolder.h"
#include "support/Messages.h"

#include <openvdb_spheretree/export/NanoVdbWriter.h>

#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;
using command_test::writeText;
using spheretree_test::mentions;

testing::AssertionResult beginsWith(const std::string& text, const std::string& start)
{
    if (text.rfind(start, 0) == 0) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "begins with " << text.substr(0, 60);
}

class CommandExport : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
        writeVol("one.vol", {1, 1, 1}, "\x01");
        const Result made = run("-read a.vol -spheretree spheres=6,1 -write tree.vdb");
        ASSERT_EQ(made.exitCode, 0) << made.err;
    }

    std::string written(const std::string& name, const std::string& options = "") const
    {
        const Result result = run("-read tree.vdb -write " + name + " " + options);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return readText(path(name));
    }
};

TEST_F(CommandExport, TheExtensionSaysWhichAndFormatWhereThereAreSeveral)
{
    EXPECT_TRUE(mentions(written("t.urdf"), "<link name=\"object\">"));
    EXPECT_TRUE(beginsWith(written("t.usda"), "#usda 1.0"));
    EXPECT_TRUE(beginsWith(written("t.yml"), "robot_cfg:"));
    EXPECT_TRUE(beginsWith(written("l.yml", "format=lula"), "api_version:"));
    EXPECT_TRUE(mentions(written("t.json"), "\"vdb_spheretree.tree.1\""));
    EXPECT_TRUE(beginsWith(written("f.json", "format=foam"), "[{\"mean\""));
    EXPECT_TRUE(beginsWith(written("t.csv"), "level,id,parent"));
    EXPECT_TRUE(beginsWith(written("x.csv", "format=multisphere"), "x,y,z,radius\n"));
    EXPECT_EQ(written("c.mol"), written("c.txt", "format=lammps"));
    EXPECT_EQ(written("c.multisphere"), written("c.txt", "format=liggghts"));
    EXPECT_TRUE(beginsWith(written("T.PLY"), "ply\nformat binary_little_endian"));
}

TEST_F(CommandExport, OneFormatAmongFilesOfOthers)
{
    const Result result = run("-read tree.vdb -write a.urdf b.csv format=deme link=arm");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(mentions(readText(path("a.urdf")), "\"arm\""));
    EXPECT_TRUE(mentions(readText(path("a.urdf")), "<robot name=\"a\">"));
    EXPECT_TRUE(beginsWith(readText(path("b.csv")), "x,y,z,r\n"));
}

TEST_F(CommandExport, AnOptionThatMeansNothingToAFileIsTold)
{
    const auto noted = [&](const std::string& arguments) {
        const Result result = run("-read tree.vdb -write " + arguments);
        EXPECT_TRUE(result.exitCode == 0) << arguments << ": " << result.err;
        return result.err;
    };
    for (const auto& [option, what] : {std::pair("link=arm", "hold no links"),
             std::pair("mass=object", "hold no mass"), std::pair("density=2", "hold no mass"),
             std::pair("start=3", "hold no samples over time"),
             std::pair("fps=25", "hold no samples over time"),
             std::pair("up=z", "say no axis that is up")}) {
        const std::string text = noted(std::string("a.ply ") + option);
        EXPECT_TRUE(mentions(text, "changes nothing, as .ply files ") && mentions(text, what))
            << option << text;
    }
    for (const char* taken : {"a.ply a.urdf link=arm density=2", "a.ply a.usda up=z fps=25",
             "a.ply a.png up=z width=16 height=16", "a.glb up=z", "a.ply"}) {
        EXPECT_FALSE(mentions(noted(taken), "changes nothing")) << taken;
    }
    EXPECT_TRUE(mentions(noted("a.ply a.vdb up=z"), "a.ply: up= changes nothing"));
    EXPECT_TRUE(
        mentions(noted("a.vtp name=b"), "name= changes nothing, as .vtp files hold no name"));
    EXPECT_TRUE(
        mentions(noted("a.yml format=lula name=b"), "as .yml format=lula files hold no name"));
}

TEST_F(CommandExport, ToStdout)
{
    const Result result = run("-quiet -read tree.vdb -write stdout.srdf link=arm");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out, written("t.srdf", "link=arm name=spheretree"));
}

TEST_F(CommandExport, UnitsAndUp)
{
    EXPECT_TRUE(
        mentions(written("t.usda", "units=mm up=z"), "metersPerUnit = 0.001\n    upAxis = \"Z\""));
    const std::string metres = written("m.xyz", "level=1"),
                      millimetres = written("mm.xyz", "level=1 units=mm");
    double m = 0, mm = 0;
    ASSERT_EQ(std::sscanf(metres.c_str(), "1\n%*[^\n]\nH %lf", &m), 1);
    ASSERT_EQ(std::sscanf(millimetres.c_str(), "1\n%*[^\n]\nH %lf", &mm), 1);
    EXPECT_NEAR(mm, 1000 * m, 1e-2);
}

TEST_F(CommandExport, WhatThereIsNoRoomForIsSaid)
{
    const Result result = run("-read tree.vdb -write t.urdf");
    EXPECT_TRUE(mentions(result.err, "t.urdf: urdf holds one level"));
    EXPECT_FALSE(mentions(run("-read tree.vdb -write t.urdf level=1").err, "holds one level"));
    EXPECT_TRUE(mentions(run("-read a.vol -spheretree tree=extended dag=1 -write t.ply").err,
        "no room for the edges of the Sphere-DAG"));
}

TEST_F(CommandExport, WhatAFormatCannotHoldLeavesTheOldFile)
{
    const struct {
        const char* line;
        const char* file;
        const char* why;
    } cases[] = {
        {"-read a.vol -spheretree tree=reversible dist=l1 -write t.ply", "t.ply",
            "those of a norm"},
        {"-read one.vol -spheretree padding=0 -write t.urdf", "t.urdf", "radius 0"},
        {"-read a.vol -spheretree spheres=6,2 -write t.sph", "t.sph", "begins with one sphere"},
        {"-read tree.vdb -write t.usda level=7", "t.usda", "level 7"},
        {"-read a.vol -write t.ply", "t.ply", "put -spheretree before"},
        {"-read tree.vdb -read tree.vdb -write t.ply", "t.ply", "choose with vdb="},
        {"-read tree.vdb -write t.vol", "t.vol", "-spheres2mask"},
    };
    for (const auto& bad : cases) {
        writeText(path(bad.file), "precious");
        const Result result = run(bad.line);
        EXPECT_EQ(result.exitCode, 3) << bad.line << "\n" << result.err;
        EXPECT_TRUE(mentions(result.err, bad.why)) << bad.line;
        EXPECT_EQ(readText(path(bad.file)), "precious") << bad.line;
    }
}

TEST_F(CommandExport, SeveralTreesAreSamplesOfOneStage)
{
    const Result result = run("-read tree.vdb -read tree.vdb -write t.usda start=25");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(mentions(result.err, "2 sphere-trees are samples over time, from 25 to 26"));
    EXPECT_TRUE(mentions(readText(path("t.usda")), "endTimeCode = 26"));
    const auto times = [&](const std::string& line) {
        const Result stage = run(line + " -write t.usda");
        EXPECT_EQ(stage.exitCode, 0) << stage.err;
        const std::string text = readText(path("t.usda"));
        return std::array<bool, 3>{
            mentions(text, " 3: [("), mentions(text, " 2: [("), mentions(text, " 1: [(")};
    };
    EXPECT_EQ(times("-read tree.vdb tree.vdb"), (std::array<bool, 3>{false, true, true}));
    EXPECT_EQ(times("-for i=1,5,2 -read tree.vdb -end"), (std::array<bool, 3>{true, false, true}));
    EXPECT_EQ(times("-for i=3,0,-1 -read tree.vdb -end"), (std::array<bool, 3>{true, true, true}));
}

TEST_F(CommandExport, SeveralTreesAreLinksOfOneRobot)
{
    ASSERT_EQ(run("-read a.vol -spheretree spheres=3 name=palm -write palm.vdb").exitCode, 0);
    const auto linksOf = [&](const std::string& line) {
        const Result result = run(line + " -write robot.yml level=0");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_FALSE(mentions(result.err, "samples")) << result.err;
        const std::string text = readText(path("robot.yml"));
        const std::string before = "collision_link_names: [";
        const std::size_t begin = text.find(before) + before.size();
        return text.substr(begin, text.find(']', begin) - begin);
    };
    EXPECT_EQ(linksOf("-read tree.vdb palm.vdb"), "\"tree\", \"palm\"");
    ASSERT_EQ(run("-read tree.vdb -write arm.vdb").exitCode, 0);
    EXPECT_EQ(linksOf("-read tree.vdb arm.vdb palm.vdb"), "\"tree\", \"arm\", \"palm\"");
    EXPECT_EQ(linksOf("-each link=upper,lower -read a.vol -spheretree spheres=3 name={$link} -end"),
        "\"upper\", \"lower\"");
    EXPECT_EQ(
        run("-read tree.vdb tree.vdb -write robot.xrdf robot.srdf link=left,right").exitCode, 0);
    EXPECT_TRUE(mentions(readText(path("robot.srdf")), "<robot name=\"robot\">"));
    EXPECT_TRUE(mentions(readText(path("robot.srdf")), "approximation link=\"right\">"));
    EXPECT_EQ(linksOf("-read palm.vdb"), "\"palm\"");
    ASSERT_EQ(run("-read palm.vdb -write other.vdb").exitCode, 0);
    EXPECT_EQ(linksOf("-read other.vdb tree.vdb"), "\"palm\", \"tree\"")
        << "names come before files";
    EXPECT_TRUE(mentions(
        run("-read arm.vdb palm.vdb -write stdout.srdf level=0").out, "<robot name=\"robot\">"));
}

TEST_F(CommandExport, AFileBehindALoopSaysWhichTreesItLacks)
{
    const std::string lack = " lacks 2 of the 3 sphere-trees of the loop", advice = "keep=1";
    const auto linesOf = [&](const std::string& keep, const std::string& behind) {
        const Result result = run(
            "-each link=a,b,c -read a.vol -spheretree spheres=3 name={$link} -write {$link}.vdb "
            + keep + " -end " + behind);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result.err;
    };
    for (const std::string file : {"robot.yml", "robot.usda", "all.vdb"}) {
        const std::string told = linesOf("", "-write " + file);
        EXPECT_TRUE(mentions(told, file + lack) && mentions(told, advice)) << told;
        const std::string one = file == "robot.usda" ? " start=1" : "";
        EXPECT_FALSE(mentions(linesOf("keep=1", "-write " + file + one), "lacks"));
    }
    const std::string make = "-read a.vol -spheretree spheres=2 name={$l} ";
    for (const std::string& behind :
        {std::string("-write last.urdf"), std::string("-write c.yml vdb=c"),
            std::string("-read a.vol -spheretree spheres=2 name=d -write d.yml"),
            "-each l=d,e " + make + "-write {$l}.vdb keep=1 -end -write de.yml vdb=d,e",
            "-clear -each l=d,e " + make + "-end -write de.yml",
            "-for l=0,2 " + make + "-write e{$l}.yml -end"}) {
        EXPECT_FALSE(mentions(linesOf("", behind), "lacks")) << behind;
    }
    const auto toldOf = [&](const std::string& line) {
        const Result result = run(line);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result.err;
    };
    EXPECT_FALSE(mentions(toldOf("-each l=a,b " + make + "-write {$l}.vdb -end -each l=d,e " + make
                              + "-write {$l}.vdb keep=1 -end -write de.yml"),
        "lacks"))
        << "the first loop is not that of the file";
    EXPECT_FALSE(mentions(toldOf("-each l=a,b " + make
                              + "-write {$l}.vdb -level level=0 name={$l} "
                                "-write {$l}.csv keep=1 -end -write r.yml"),
        "lacks"))
        << "-level took them";
    const std::string nested =
        toldOf("-each r=p,q -each l=a,b " + make + "-write {$r}{$l}.vdb -end -write {$r}.yml -end");
    EXPECT_TRUE(mentions(nested, "p.yml lacks 1 of the 2")) << nested;
    EXPECT_TRUE(mentions(nested, "q.yml lacks 1 of the 2")) << nested;
}

TEST_F(CommandExport, LinksAreInTheOrderOfTheList)
{
    ASSERT_EQ(run("-read a.vol -spheretree spheres=3 name=palm -write palm.vdb").exitCode, 0);
    ASSERT_EQ(run("-read a.vol -spheretree spheres=6 name=arm -write arm.vdb").exitCode, 0);
    const auto spheresOf = [&](const std::string& options) {
        const Result result = run("-read palm.vdb arm.vdb -write stdout.srdf " + options);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        std::vector<std::string> links;
        std::istringstream lines(result.out);
        for (std::string line; std::getline(lines, line);) {
            const std::size_t name = line.find(" link=\"");
            if (name != line.npos) links.push_back(line.substr(name + 7, 1) + " ");
            else if (mentions(line, "<sphere ")) links.back() += '*';
        }
        return links;
    };
    using Links = std::vector<std::string>;
    EXPECT_EQ(spheresOf(""), (Links{"p ***", "a ******"}));
    EXPECT_EQ(spheresOf("vdb=arm,palm"), (Links{"a ******", "p ***"}));
    EXPECT_EQ(spheresOf("vdb=palm,arm link=x,y"), (Links{"x ***", "y ******"}));
    EXPECT_EQ(spheresOf("vdb=0,1 link=x,y"), (Links{"x ******", "y ***"}));
    const Result result =
        start({"-read", "palm.vdb", "arm.vdb", "-write", "robot.yml", "link=x, arm"}).wait();
    EXPECT_TRUE(mentions(result.err, "robot.yml: its links are 'x' (sphere-tree 'palm'), 'arm'\n"))
        << result.err;
    EXPECT_TRUE(mentions(readText(path("robot.yml")), "[\"x\", \"arm\"]"));
    EXPECT_TRUE(mentions(run("-read palm.vdb arm.vdb -write robot.yml frame=centroid").err,
        "robot.yml: readers of curobo take its spheres in the frame of the link"));
    run("-read palm.vdb arm.vdb -write both.vdb vdb=arm,palm");
    const std::string listed = run("-read both.vdb -print").out;
    EXPECT_LT(listed.find("'palm'"), listed.find("'arm'")) << "the newest, age 0, is shown first";
}

TEST_F(CommandExport, LinksWithoutANameOfTheirOwnAreRefused)
{
    const struct {
        const char* line;
        const char* why;
    } cases[] = {
        {"-read tree.vdb tree.vdb -write robot.yml",
            "robot.yml: several sphere-trees are called 'spheretree'"},
        {"-read a.vol -spheretree -read a.vol -spheretree -write robot.yml", "link=A,B"},
        {"-read tree.vdb tree.vdb -write robot.yml link=arm",
            "link= has 1 name for 2 sphere-trees"},
        {"-read tree.vdb -write robot.yml link=arm,hand", "link= has 2 names for 1 sphere-tree:"},
        {"-read tree.vdb tree.vdb -write robot.yml link=arm,arm", "are of the link 'arm'"},
        {"-read tree.vdb tree.vdb -write robot.urdf link=arm,hand", "holds one sphere-tree"},
    };
    for (const auto& bad : cases) {
        const Result result = run(bad.line);
        EXPECT_EQ(result.exitCode, 3) << bad.line << "\n" << result.err;
        EXPECT_TRUE(mentions(result.err, bad.why)) << result.err;
    }
    EXPECT_FALSE(exists("robot.yml"));
    EXPECT_FALSE(exists("robot.urdf"));
}

TEST_F(CommandExport, AnObjectAsVol)
{
    const Result result = run("-read a.vol -write b.vol -read b.vol -write c.vol");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(readText(path("b.vol")), readText(path("c.vol")));
    EXPECT_TRUE(mentions(readText(path("b.vol")), "X: 8\nY: 6\nZ: 5\n"));
    const Result moved = run("-read tree.vdb -spheres2mask level=1 -write d.vol");
    EXPECT_TRUE(mentions(moved.err, "its first voxel is that of index"));
    for (const char* file : {"volumes/placed.nrrd", "volumes/mirrored.nii"}) {
        const Result turned = run("-read " + spheretree_test::dataPath(file) + " -write e.vol");
        EXPECT_TRUE(mentions(turned.err, "in the world at 10,-5,1")) << turned.err;
        EXPECT_TRUE(mentions(turned.err, "no room for the turn or the mirror")) << turned.err;
    }
}

TEST_F(CommandExport, HelpListsAllFormats)
{
    const std::string help = run("-help write").out;
    for (const char* line :
        {".urdf", ".usda", "format=lammps: LAMMPS", "a level: centers, radii"}) {
        EXPECT_TRUE(mentions(help, line));
    }
}

TEST_F(CommandExport, NanoVdbHoldsTheTreeOrGridsWithoutOne)
{
    if (!openvdb_spheretree::writesNanoVdb()) GTEST_SKIP() << "this build has no NanoVDB";
    const auto nameIn = [](const std::string& file, const std::string& name) {
        return mentions(file, name + std::string(1, '\0'));
    };
    EXPECT_TRUE(nameIn(written("t.nvdb"), "spheretree"));
    const Result grid = run("-read a.vol -write g.nvdb");
    EXPECT_EQ(grid.exitCode, 0) << grid.err;
    EXPECT_TRUE(nameIn(readText(path("g.nvdb")), "a"));
    const Result piped = run("-read tree.vdb -write stdout.nvdb");
    EXPECT_EQ(piped.out, readText(path("t.nvdb")));
    const Result scaled = run("-read a.vol -write s.nvdb units=mm");
    EXPECT_EQ(scaled.exitCode, 3);
    EXPECT_TRUE(mentions(scaled.err, "units is for sphere-trees"));
    EXPECT_FALSE(exists("s.nvdb"));
}

} // namespace
