// SPDX-License-Identifier: Apache-2.0
// The trees of many frames: as samples of one file, chosen by name behind their loop, and those of frames without
// an object.

#include "FramesTest.h"

#include <algorithm>
#include <string>

#include <unistd.h>

namespace {

using namespace command_test;

TEST_F(CommandFrames, FilesOfOtherToolsAreThereOfAnEmptyFrameIfTheyCanBe)
{
    writeFrames({8, 9}, 9);
    const std::string line = "-read smoke_####.vdb -spheretree spheres=4 empty=write -write ";
    const Result write = run(line
        + "e_####.usda e_####.ply e_####.xyz e_####.obj e_####.vtp e_####.vtk e_####.csv "
          "format=deme");
    EXPECT_EQ(write.exitCode, 0) << write.err;
    EXPECT_TRUE(holds(readText(path("e_0009.usda")), "point3f[] points = []"));
    EXPECT_TRUE(holds(readText(path("e_0009.ply")), "element vertex 0\n"));
    EXPECT_TRUE(holds(readText(path("e_0009.vtp")), "NumberOfPoints=\"0\""));
    EXPECT_TRUE(holds(readText(path("e_0009.vtk")), "POINTS 0 double"));
    EXPECT_EQ(readText(path("e_0009.xyz")).find("0\n"), 0u);
    EXPECT_EQ(readText(path("e_0009.csv")), "x,y,z,r\n");
    for (const char* file : {"f_####.glb", "f_####.urdf", "f_####.nvdb", "f_####.html"}) {
        const Result refused = run(line + file + " g_####.csv");
        EXPECT_EQ(refused.exitCode, 3) << file;
        EXPECT_TRUE(holds(refused.err, "by empty=skip where the tree is built")) << refused.err;
        EXPECT_FALSE(exists("g_0009.csv")) << "all of a -write, or nothing";
        EXPECT_TRUE(exists("g_0008.csv"));
    }
}

TEST_F(CommandFrames, EmptyFramesAreSamplesWithoutSpheres)
{
    writeFrames({8, 9, 10, 11}, 8);
    const std::string build = "-spheretree spheres=4,1 empty=write ";
    ASSERT_EQ(run("-read smoke_####.vdb " + build + "-write tree_####.vdb").exitCode, 0);
    // From the cache at once, and from its trees.
    for (const std::string& trees :
        {"-read smoke_####.vdb " + build, std::string("-read tree_####.vdb ")}) {
        const Result result = run("-for i=8,12 " + trees + "-end -write smoke.usda");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        const std::string stage = readText(path("smoke.usda"));
        EXPECT_TRUE(holds(stage, "startTimeCode = 8\n")) << trees;
        EXPECT_TRUE(holds(stage, "endTimeCode = 11\n")) << trees;
        EXPECT_TRUE(
            holds(stage, "point3f[] points.timeSamples = {\n            8: [],\n            9: [("))
            << stage.substr(0, 2000);
    }
    const Result table = run("-read tree_0008.vdb -write again.csv");
    EXPECT_EQ(table.exitCode, 0) << table.err;
    const std::string lines = readText(path("again.csv"));
    EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 1);
}

TEST_F(CommandFrames, ASampleOfFewerLevelsShowsTheCoarsestThatItHas)
{
    writeBlock("a.vol");
    writeVol("point.vol", {1, 1, 1}, "\x01");
    ASSERT_EQ(run("-read a.vol -spheretree spheres=6,1 -write tree_0009.vdb").exitCode, 0);
    ASSERT_EQ(run("-read point.vol -spheretree spheres=1 -write tree_0010.vdb").exitCode, 0);
    ASSERT_EQ(run("-for i=9,11 -read tree_####.vdb -end -write t.usda").exitCode, 0);
    const std::string stage = readText(path("t.usda"));
    const std::size_t coarse = stage.find("def Points \"level_1\"");
    const std::size_t sample = stage.find("10: [", stage.find("points.timeSamples", coarse));
    ASSERT_NE(sample, stage.npos) << stage;
    EXPECT_EQ(stage.compare(sample, 6, "10: [("), 0) << stage.substr(sample, 100);
}

TEST_F(CommandFrames, FramesThatAreSkippedAreNamedWhereSamplesAreWritten)
{
    writeFrames({8, 9, 10}, 9);
    const std::string read = "-for i=8,11 -read smoke_####.vdb -spheretree spheres=2 empty=";
    const Result skipped = run(read + "skip -end -write t.usda");
    EXPECT_TRUE(holds(skipped.err, "t.usda: no sample of i=9, skipped")) << skipped.err;
    EXPECT_FALSE(holds(run(read + "write -end -write t.usda").err, "no sample"));
    EXPECT_TRUE(holds(readText(path("t.usda")), "9: [(3402823466385288598"))
        << "the box of nothing";
}

TEST_F(CommandFrames, NumbersOfFewerDigitsAreTold)
{
    writeFrames({8, 9, 10});
    for (const int frame : {9, 10}) {
        std::filesystem::copy(
            path(nameOf("smoke", frame, "vdb")), path("f_" + std::to_string(frame) + ".vdb"));
    }
    const auto told = [&](const std::string& name) { return run("-read " + name + " -print").err; };
    EXPECT_TRUE(holds(told("f_##.vdb"), "f_9.vdb is no frame of f_##.vdb")) << told("f_##.vdb");
    EXPECT_FALSE(holds(told("f_%d.vdb"), "is no frame"));
    EXPECT_FALSE(holds(told("smoke_####.vdb"), "is no frame"));
}

TEST_F(CommandFrames, WhatNeedsSpheresIsLeftOutOfFramesWithoutThem)
{
    writeFrames({8, 9}, 8);
    ASSERT_EQ(
        run("-read smoke_####.vdb -spheretree spheres=2 empty=write -write t_####.vdb").exitCode,
        0);
    const Result result = run("-read t_####.vdb -stats st_####.csv -write u_####.csv");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(holds(result.err, "what needs spheres is left out")) << result.err;
    EXPECT_TRUE(exists("st_0009.csv") && !exists("st_0008.csv"));
    EXPECT_TRUE(existAll("u", {8, 9}, "csv"));
}

TEST_F(CommandFrames, AnEmptyTreeThatIsReadIsATreeAmongOthers)
{
    writeFrames({8, 9, 10}, 8);
    ASSERT_EQ(run("-read smoke_####.vdb -spheretree tree=extended empty=write -write t_####.vdb")
                  .exitCode,
        0);
    for (const char* file : {"mixed.csv", "mixed.json", "mixed.vdb"}) {
        const Result result = run(std::string("-read t_0008.vdb t_0009.vdb -write ") + file);
        EXPECT_EQ(result.exitCode, 3) << file << result.err;
        EXPECT_FALSE(exists(file));
    }
    const Result stats = run("-read t_0008.vdb -stats");
    EXPECT_EQ(stats.exitCode, 3);
    EXPECT_TRUE(holds(stats.err, "sphere-tree without spheres 'spheretree'")) << stats.err;
    EXPECT_EQ(run("-read t_0008.vdb scale=2 -write x.vdb").exitCode, 3);
    const Result beside = run("-read smoke_0010.vdb t_0008.vdb -spheretree name=y -write y.vdb");
    EXPECT_EQ(beside.exitCode, 0) << beside.err;
    // The level that is chosen is the only one of the stage.
    const Result one = run("-for i=8,11 -read t_####.vdb -end -write one.usda level=1");
    ASSERT_EQ(one.exitCode, 0) << one.err;
    const std::string stage = readText(path("one.usda"));
    EXPECT_TRUE(holds(stage, "def Points \"level_1\""));
    EXPECT_FALSE(holds(stage, "level_0"));
    EXPECT_TRUE(holds(stage, "            8: [],\n"));
}

TEST_F(CommandFrames, BehindLoopsWithinEachOtherANameStandsForAllTurnsThatHaveEnded)
{
    writeFrames({8, 9, 10});
    const Result result =
        run("-for a=0,2 -for i=8,11 -read smoke_####.vdb -spheretree spheres=4 name=few -end "
            "-write in_{$a}.usda vdb=few keep=1 -end -write all.usda vdb=few,0 start=1");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    for (const char* file : {"in_0.usda", "in_1.usda"}) {
        EXPECT_TRUE(holds(readText(path(file)), "startTimeCode = 8\n    endTimeCode = 10\n"))
            << file;
    }
    EXPECT_TRUE(holds(readText(path("all.usda")), "startTimeCode = 1\n    endTimeCode = 6\n"));
}

TEST_F(CommandFrames, BehindALoopANameStandsForTheTreesOfAllFrames)
{
    writeFrames({8, 9, 10});
    const std::string loop =
        "-for i=8,11 -read smoke_####.vdb -spheretree spheres=4 name=few keep=1 "
        "-spheretree spheres=9 name=many -end ";
    const Result result = run(loop + "-write few.usda vdb=few keep=1 -write many.usda vdb=many");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    for (const char* file : {"few.usda", "many.usda"}) {
        EXPECT_TRUE(holds(readText(path(file)), "startTimeCode = 8\n")) << file;
        EXPECT_TRUE(holds(readText(path(file)), "endTimeCode = 10\n")) << file;
    }
    // Within the loop it is that of the frame.
    const Result within = run("-for i=8,11 -read smoke_####.vdb -spheretree spheres=4 name=few "
                              "-write few_####.csv vdb=few keep=1 -end");
    EXPECT_EQ(within.exitCode, 0) << within.err;
    const Result alone =
        run("-read smoke_0010.vdb -spheretree spheres=4 name=few -write alone.csv");
    EXPECT_EQ(readText(path("few_0010.csv")), readText(path("alone.csv")));
}

TEST_F(CommandFrames, WithoutALoopANameStandsForTheNewest)
{
    writeFrames({8, 9});
    const std::string tree = " -spheretree spheres=4 name=few ";
    const Result newest = run("-read smoke_0008.vdb" + tree + "-read smoke_0009.vdb" + tree
        + "-write newest.csv vdb=few");
    EXPECT_EQ(newest.exitCode, 0) << newest.err;
    ASSERT_EQ(run("-read smoke_0009.vdb" + tree + "-write alone.csv").exitCode, 0);
    EXPECT_EQ(readText(path("newest.csv")), readText(path("alone.csv")));
}

TEST_F(CommandFrames, TreesOfTwoNamesAreNoSamplesOfOneThing)
{
    writeFrames({8, 9});
    const std::string two = "-read smoke_####.vdb -spheretree spheres=4 name=few keep=1 "
                            "-spheretree spheres=9 name=many ";
    for (const std::string& line :
        {"-for i=8,10 " + two + "-end ", "-for i=8,9 " + two + "-end "}) {
        const Result result = run(line + "-write both.usda");
        EXPECT_EQ(result.exitCode, 3) << result.err;
        EXPECT_TRUE(holds(result.err, "there are 'few' and 'many': choose by name with vdb="))
            << result.err;
        EXPECT_FALSE(exists("both.usda"));
        EXPECT_EQ(run(line + "-write both.usda start=1").exitCode, 0);
        EXPECT_EQ(::unlink(path("both.usda").c_str()), 0);
    }
    const Result named = run("-for i=8,10 -read smoke_####.vdb -spheretree spheres=4 "
                             "name=t_{$i} -end -write all.vdb all.usda fps=30");
    EXPECT_EQ(named.exitCode, 0) << named.err;
    EXPECT_TRUE(holds(readText(path("all.usda")), "timeCodesPerSecond = 30\n"));
    EXPECT_TRUE(holds(readText(path("all.usda")), "endTimeCode = 9\n"));
}

} // namespace
