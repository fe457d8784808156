// SPDX-License-Identifier: Apache-2.0
// Sequences: a frame after the other, what is there of one that fails or has no object, and what is found
// before any work.

#include "FramesTest.h"

#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <algorithm>
#include <fstream>

#include <sys/stat.h>

namespace {

using namespace command_test;

TEST_F(CommandFrames, ASequenceIsDoneFrameByFrameWithoutALoop)
{
    writeFrames({8, 9, 10});
    const Result result =
        run("-read smoke_####.vdb -spheretree spheres=8 -write tree_####.vdb tree_%04d.csv");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(existAll("tree", {8, 9, 10}));
    EXPECT_TRUE(existAll("tree", {8, 9, 10}, "csv"));
    EXPECT_TRUE(holds(result.err, "frame=9 (2 of 3): tree of ")) << result.err;
}

TEST_F(CommandFrames, FramesGiveTheBytesThatTheyGiveAlone)
{
    writeFrames({8, 10});
    ASSERT_EQ(run("-read smoke_####.vdb -spheretree spheres=8 -write tree_####.csv").exitCode, 0);
    ASSERT_EQ(run("-read smoke_0010.vdb -spheretree spheres=8 -write alone.csv").exitCode, 0);
    EXPECT_EQ(readText(path("tree_0010.csv")), readText(path("alone.csv")));
    EXPECT_NE(readText(path("tree_0008.csv")), readText(path("alone.csv")));
}

TEST_F(CommandFrames, ALoopHasTheNumberOfItsFrameInNames)
{
    writeFrames({8, 9, 10});
    const Result result = run("-for n=8,11,2 -read smoke_%04d.vdb -spheretree spheres=8 "
                              "-write {$n:2:pad0}_####.csv -end");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(exists("08_0008.csv"));
    EXPECT_TRUE(exists("10_0010.csv"));
    EXPECT_FALSE(exists("09_0009.csv"));
}

TEST_F(CommandFrames, ALoopOfNamesHasNoNumber)
{
    const Result result =
        run("-for n=1,3 -each s=a,b -generate ball voxels=1e4 -write {$s}_##.vdb -end -end");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(
        exists("a_01.vdb") && exists("b_01.vdb") && exists("a_02.vdb") && exists("b_02.vdb"));
}

TEST_F(CommandFrames, OfTwoNumbersTheInnerOneCounts)
{
    const Result result =
        run("-for n=1,3 -for m=5,6 -generate ball voxels=1e4 -write {$n}_##.vdb -end -end");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(exists("1_05.vdb") && exists("2_05.vdb"));
}

TEST_F(CommandFrames, FramesMayBeChosen)
{
    writeFrames({8, 9, 10, 11});
    const Result result =
        run("-read smoke_####.vdb frames=8-10x2,11 -spheretree spheres=1 -write tree_####.vdb");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(existAll("tree", {8, 10, 11}));
    EXPECT_FALSE(exists("tree_0009.vdb"));
}

/// Slices are one volume. Only where someone says frames they are images, one after the other.
TEST_F(CommandFrames, PicturesAreAStackUnlessFramesAreNamed)
{
    for (const int number : {1, 2, 3}) {
        writeText(path("s_000" + std::to_string(number) + ".pgm"), "P2 2 1 9\n5 5\n");
    }
    const Result stack = run("-read s_####.pgm -print");
    EXPECT_EQ(stack.exitCode, 0) << stack.err;
    EXPECT_NE(stack.out.find("6 active voxels"), std::string::npos) << stack.out;
    const Result frames = run("-read s_%04d.pgm frames=1-3 -print");
    EXPECT_EQ(frames.exitCode, 0) << frames.err;
    EXPECT_EQ(std::count(frames.out.begin(), frames.out.end(), '\n'), 3) << frames.out;
    const Result loop = run("-for i=1,3 -read s_%04d.pgm -print -clear -end");
    EXPECT_NE(loop.out.find("2 active voxels"), std::string::npos) << loop.out << loop.err;
}

TEST_F(CommandFrames, AGapIsNoted)
{
    writeFrames({8, 9, 12});
    const Result result = run("-read smoke_####.vdb -spheretree spheres=1 -write tree_####.vdb");
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_TRUE(holds(result.err, "the frames 8, 9, 12; 2 in between are not there")) << result.err;
}

TEST_F(CommandFrames, AllMissingFramesAreNamedBeforeAnyWork)
{
    writeFrames({8, 9});
    for (const char* line : {"-read smoke_####.vdb frames=7-11 -spheretree -write tree_####.vdb",
             "-for i=7,12 -read smoke_####.vdb -spheretree -write tree_####.vdb -end"}) {
        const Result result = run(line);
        EXPECT_EQ(result.exitCode, 3) << line;
        EXPECT_TRUE(holds(result.err,
            "3 of the 5 files that loops read are not there: smoke_0007.vdb, "
            "smoke_0010.vdb, smoke_0011.vdb"))
            << result.err;
        EXPECT_FALSE(existAll("tree", {8})) << line;
    }
}

TEST_F(CommandFrames, AFileThatAnEarlierFrameWritesIsNotMissing)
{
    const Result result = run("-generate ball voxels=1e4 -write f_00.vdb "
                              "-for i=0,3 -read f_##.vdb -write f_{$i:1:+:2:pad0}.vdb -end");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(exists("f_03.vdb"));
}

TEST_F(CommandFrames, TwoFramesToOneFileAreRefusedBeforeAnyWork)
{
    writeFrames({8, 9});
    const Result result = run("-read smoke_####.vdb -spheretree -write tree.vdb");
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_TRUE(holds(result.err, "tree.vdb would be written by frame=8 and by frame=9"))
        << result.err;
    EXPECT_FALSE(exists("tree.vdb"));
}

TEST_F(CommandFrames, AFileThatHoldsAllFramesIsWrittenBehindTheLoop)
{
    writeFrames({8, 9});
    const Result result = run("-read smoke_####.vdb -spheretree -write shot.usda");
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_TRUE(holds(result.err, "-end -write shot.usda")) << result.err;
}

TEST_F(CommandFrames, FilesThatTheShellHasNamedAreTakenForASequence)
{
    writeFrames({8, 9, 10});
    const Result result =
        run("-read smoke_0008.vdb smoke_0009.vdb smoke_0010.vdb -spheretree -write t.vdb");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_TRUE(holds(result.err, "; -read smoke_####.vdb takes them one by one, as frames"))
        << result.err;
}

TEST_F(CommandFrames, AFrameThatFailsIsNamedAndTheOthersAreThere)
{
    writeFrames({8, 9, 10});
    command_test::writeText(path("smoke_0009.vdb"), "no grid");
    const std::string line = "-read smoke_####.vdb -spheretree spheres=1 -write tree_####.vdb";
    const Result result = run(line);
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_TRUE(existAll("tree", {8, 10}));
    EXPECT_FALSE(exists("tree_0009.vdb"));
    EXPECT_TRUE(
        holds(result.err, "1 of 3 frames failed, 2 are done: frame=9: -read: smoke_0009.vdb"))
        << result.err;
}

TEST_F(CommandFrames, AFailureMayEndTheLoop)
{
    writeFrames({8, 9, 10});
    command_test::writeText(path("smoke_0009.vdb"), "no grid");
    const Result result =
        run("-onerror stop -read smoke_####.vdb -spheretree spheres=1 -write tree_####.vdb");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_TRUE(existAll("tree", {8}));
    EXPECT_FALSE(exists("tree_0010.vdb"));
    EXPECT_TRUE(holds(result.err, "(of 3 frames 1 is done)")) << result.err;
}

TEST_F(CommandFrames, NothingAfterALoopIsDoneIfAFrameHasFailed)
{
    writeFrames({8, 9});
    command_test::writeText(path("smoke_0009.vdb"), "no grid");
    const Result result = run("-for i=8,10 -read smoke_####.vdb -end -write all.vdb");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_FALSE(exists("all.vdb"));
}

TEST_F(CommandFrames, ACheckThatFailsIsAFailureOfItsFrame)
{
    writeFrames({8, 9, 10});
    ASSERT_EQ(run("-read smoke_0009.vdb -spheretree spheres=4 -write other.csv").exitCode, 0);
    const Result result =
        run("-for i=8,11 -read smoke_####.vdb other.csv -check -write ok_####.vdb -end");
    EXPECT_EQ(result.exitCode, 6) << result.err;
    EXPECT_TRUE(exists("ok_0009.vdb"));
    EXPECT_FALSE(exists("ok_0010.vdb"));
}

TEST_F(CommandFrames, AnEmptyFrameFailsOrIsSkippedOrWritten)
{
    writeFrames({8, 9, 10}, 9);
    const std::string line = "-read smoke_####.vdb -spheretree spheres=4 empty=";
    const Result fail = run(line + "fail -write fail_####.vdb");
    EXPECT_EQ(fail.exitCode, 3);
    EXPECT_TRUE(holds(fail.err, "1 of 3 frames failed")) << fail.err;

    const Result skip = run(line + "skip -write skip_####.vdb");
    EXPECT_EQ(skip.exitCode, 0) << skip.err;
    EXPECT_TRUE(existAll("skip", {8, 10}));
    EXPECT_FALSE(exists("skip_0009.vdb"));
    EXPECT_TRUE(holds(skip.err, "frame=9 (2 of 3): skipped: -spheretree")) << skip.err;

    const Result write = run(line
        + "write -stats json={$frame}.json -write e_####.vdb e_####.csv e_####.json e_####.png "
          "width=32");
    EXPECT_EQ(write.exitCode, 0) << write.err;
    EXPECT_TRUE(existAll("e", {8, 9, 10}) && existAll("e", {8, 9, 10}, "png"));
    const std::string table = readText(path("e_0009.csv"));
    EXPECT_EQ(table.find("level,id,parent"), 0u);
    EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1);
    EXPECT_TRUE(holds(readText(path("e_0009.json")), "\"levels\": []"));
    EXPECT_FALSE(exists("9.json")); // there is nothing to tell
    const command_test::Grids grids = readGrids("e_0009.vdb");
    ASSERT_EQ(grids.size(), 1u);
    EXPECT_TRUE(grids[0]->isType<openvdb::points::PointDataGrid>());
    EXPECT_EQ(grids[0]->getName(), "spheretree");
    EXPECT_EQ(grids[0]->activeVoxelCount(), 0u);
    EXPECT_EQ(grids[0]->voxelSize(), readGrids("smoke_0009.vdb")[0]->voxelSize());
}

TEST_F(CommandFrames, AnEmptyFrameTakesNothingOfBeforeTheSequence)
{
    writeFrames({9});
    writeGrids("smoke_0008.vdb", {});
    auto still = sphereGrid("still", 5);
    still->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    writeGrids("still.vdb", {still});
    const Result result =
        run("-read still.vdb -read smoke_####.vdb -spheretree spheres=4 empty=write "
            "-write v_####.vdb");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    for (const int frame : {8, 9})
        EXPECT_EQ(readGrids(nameOf("v", frame, "vdb")).size(), 2u) << frame;
}

TEST_F(CommandFrames, ASequenceInALoopThatFailsLeavesWhatWasThereBefore)
{
    writeFrames({8, 9});
    std::string grids;
    for (int i = 0; i < 9; ++i) {
        const std::string name = "g" + std::to_string(i);
        writeGrids(name + ".vdb", {sphereGrid(name, 3)});
        grids += " " + name + ".vdb";
    }
    for (const char* bad : {"bad_0008.vdb", "bad_0009.vdb"}) writeText(path(bad), "no grid");
    const Result result = run("-read" + grids
        + " -each s=bad,smoke -read {$s}_####.vdb frames=8-9 "
          "-print -spheretree spheres=4 -write {$s}_t_####.csv -end");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_TRUE(exists("smoke_t_0009.csv")) << result.err;
    // Nine of before, and the frame's own.
    EXPECT_TRUE(holds(result.out, "vdb 9: ")) << result.out;
    EXPECT_FALSE(holds(result.out, "vdb 10: ")) << result.out;
    std::size_t last = result.out.rfind("vdb 0: ");
    EXPECT_TRUE(holds(result.out.substr(last), "vdb 9: ")) << result.out;
}

TEST_F(CommandFrames, EachFrameFindsWhatWasThereBeforeTheSequence)
{
    writeFrames({8, 9, 10});
    writeGrids("still.vdb", {sphereGrid("still", 5)});
    const Result grids = run("-read still.vdb -read smoke_####.vdb -spheretree spheres=4 "
                             "-write k_####.vdb");
    EXPECT_EQ(grids.exitCode, 0) << grids.err;
    for (const int frame : {8, 9, 10}) {
        EXPECT_EQ(readGrids(nameOf("k", frame, "vdb")).size(), 2u) << frame;
    }
    // A tree that the last action of each frame writes, too.
    ASSERT_EQ(
        run("-read still.vdb -spheretree spheres=3 name=still -write still_tree.vdb").exitCode, 0);
    const Result trees = run("-read still_tree.vdb -read smoke_####.vdb -spheretree spheres=4 "
                             "-write t_####.vdb");
    EXPECT_EQ(trees.exitCode, 0) << trees.err;
    for (const int frame : {8, 9, 10}) {
        EXPECT_EQ(readGrids(nameOf("t", frame, "vdb")).size(), 2u) << frame;
    }
}

TEST_F(CommandFrames, WhatIsFoundEmptyBeforeTheTreeIsEmptyToo)
{
    writeFrames({8, 9}, 9);
    for (const char* before : {"-mask", "-mask cover=1"}) {
        const Result result = run("-read smoke_####.vdb " + std::string(before)
            + " -spheretree spheres=4 empty=write -write e_####.csv");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_TRUE(existAll("e", {8, 9}, "csv")) << before;
    }
}

TEST_F(CommandFrames, AFileWithoutAnyGridIsAnEmptyFrame)
{
    writeFrames({8});
    writeGrids("smoke_0009.vdb", {});
    for (const char* read : {"-read smoke_####.vdb", "-read smoke_####.vdb grids=density"}) {
        const Result result =
            run(std::string(read) + " -spheretree spheres=4 empty=write -write e_####.csv");
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_TRUE(existAll("e", {8, 9}, "csv")) << read;
    }
}

TEST_F(CommandFrames, AnEmptyObjectWithoutALoopMayBeSkipped)
{
    writeFrames({9}, 9);
    const Result result = run("-read smoke_0009.vdb -spheretree empty=skip -write tree.vdb");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(holds(result.err, "nothing more is done (empty=skip)")) << result.err;
    EXPECT_FALSE(exists("tree.vdb"));
}

TEST_F(CommandFrames, AFrameOfOtherVoxelsFailsBeforeItsTreeIsMade)
{
    writeFrames({8, 9, 11});
    writeLargerVoxels("smoke_0010.vdb");
    const Result result = run("-read smoke_####.vdb -spheretree spheres=1 -write tree_####.vdb");
    EXPECT_EQ(result.exitCode, 3);
    EXPECT_TRUE(holds(
        result.err, "frame=10: -spheretree: voxels are of 0.25, and in the frames before of 0.5"))
        << result.err;
    EXPECT_TRUE(holds(result.err, "1 of 4 frames failed, 3 are done")) << result.err;
    EXPECT_TRUE(existAll("tree", {8, 9, 11}, "vdb"));
    EXPECT_FALSE(exists("tree_0010.vdb"));
    const Result within = run(
        "-read smoke_####.vdb -each k=1,2 -eval {$k} -end -spheretree spheres=1 -write t_####.vdb");
    EXPECT_EQ(within.exitCode, 3) << "a loop within the frames has ended before: " << within.err;
}

TEST_F(CommandFrames, OtherVoxelsAreTakenOrMadeTheSame)
{
    writeFrames({8, 9});
    writeLargerVoxels("smoke_0010.vdb");
    for (const char* line :
        {"-spheretree spheres=1 samevoxels=0", "-resample voxel=1 -spheretree spheres=1",
            "-spheretree spheres=1 keep=1 samevoxels=0 name=a -resample voxel=2 -spheretree",
            "-each v=1,2 -resample voxel={$v} keep=1 -spheretree spheres=1 name={$v} -end"}) {
        const Result result =
            run("-read smoke_####.vdb " + std::string(line) + " -write tree_####.vdb");
        EXPECT_EQ(result.exitCode, 0) << result.err;
    }
    const Result twoSizes =
        run("-each d=smoke,smoke -read {$d}_####.vdb frames=8,9 -spheretree spheres=1 name=a "
            "keep=1 -resample voxel=2 -spheretree spheres=1 name=b -clear -end");
    EXPECT_EQ(twoSizes.exitCode, 0) << twoSizes.err;
}

TEST_F(CommandFrames, MeshesOfOneResolutionAreToldToHaveOneVoxelSize)
{
    const auto writeMesh = [&](const std::string& name, const std::string& side) {
        command_test::writeText(path(name),
            "v 0 0 0\nv " + side + " 0 0\nv 0 " + side + " 0\nv 0 0 " + side
                + "\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    };
    writeMesh("part_0001.obj", "8");
    writeMesh("part_0002.obj", "16");
    const std::string read = "-read part_####.obj -mesh2ls ", write = " -write t_####.vdb";
    const Result other = run(read + "dim=16 -spheretree spheres=1" + write);
    EXPECT_EQ(other.exitCode, 3) << other.err;
    EXPECT_TRUE(holds(other.err,
        "voxels are of 1, and in the frames before of 0.5: -mesh2ls voxel=0.5 (meshes) or "
        "-resample "
        "voxel=0.5 (volumes) makes them the same; samevoxels=0 allows it\n"))
        << other.err;
    for (const char* line :
        {"voxel=0.5 -spheretree spheres=1", "dim=16 -spheretree spheres=1 samevoxels=0"}) {
        const Result result = run(read + line + write);
        EXPECT_EQ(result.exitCode, 0) << result.err;
    }
}

TEST_F(CommandFrames, VoxelsOfAFrameWithoutATreeAreNoMeasureForOthers)
{
    writeLargerVoxels("smoke_0008.vdb"); // a ball, of which no flat tree is made
    auto disc = openvdb::FloatGrid::create(0);
    disc->setName("density");
    disc->fill(openvdb::CoordBBox({0, 0, 0}, {5, 5, 0}), 1);
    for (const char* name : {"smoke_0009.vdb", "smoke_0010.vdb"}) writeGrids(name, {disc});
    const Result result = run("-read smoke_####.vdb -spheretree dim=2 spheres=1 -write t_####.vdb");
    EXPECT_EQ(result.exitCode, 3) << result.err;
    EXPECT_TRUE(holds(result.err, "1 of 3 frames failed, 2 are done")) << result.err;
    EXPECT_TRUE(existAll("t", {9, 10}));
}

TEST_F(CommandFrames, OtherVoxelsInALoopOfNumbersAreWarnedOf)
{
    writeFrames({8, 9});
    writeLargerVoxels("smoke_0010.vdb");
    const Result result =
        run("-for i=8,11 -read smoke_####.vdb -spheretree spheres=1 -write tree_####.vdb -end");
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_TRUE(holds(result.err, "warning: i=10 (3 of 3): voxels are of 0.25")) << result.err;
    EXPECT_FALSE(holds(result.err, "i=9 (2 of 3): voxels")) << result.err;
}

TEST_F(CommandFrames, QuietSaysNothingOfFrames)
{
    writeFrames({8, 12, 13}, 12);
    const Result result =
        run("-quiet -read smoke_####.vdb -spheretree spheres=1 empty=skip -write tree_####.vdb");
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.out, "");
}

TEST_F(CommandFrames, VerboseHasALineForEachAction)
{
    writeFrames({8});
    const std::string line = "-read smoke_####.vdb -spheretree spheres=1 -write tree_####.vdb";
    EXPECT_FALSE(holds(run(line).err, "completed"));
    EXPECT_TRUE(holds(
        run("-verbose " + line).err, "frame=8 (1 of 1): -spheretree spheres=1 ... completed"));
}

TEST_F(CommandFrames, CtrlCLeavesTheFramesThatAreDone)
{
    writeFrames({8});
    const std::string fifo = path("smoke_0009.vdb");
    ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0); // nobody writes: the frame waits
    auto running = start(
        command_test::split("-read smoke_####.vdb -spheretree spheres=1 -write tree_####.vdb"));
    ASSERT_TRUE(running.waitForError("frame=8 (1 of 2): "));
    running.send(SIGINT);
    const Result result = running.wait();
    EXPECT_EQ(result.exitCode, 5);
    EXPECT_TRUE(holds(result.err, "frame=9 (2 of 2) is interrupted, and 1 is done")) << result.err;
    EXPECT_TRUE(exists("tree_0008.vdb"));
    EXPECT_FALSE(exists("tree_0009.vdb"));
}

TEST_F(CommandFrames, AFullDiskEndsTheLoop)
{
    writeFrames({8, 9});
    std::filesystem::create_directory(path("tree_0008.csv"));
    const Result result = run("-read smoke_####.vdb -spheretree spheres=1 -write tree_####.csv");
    EXPECT_EQ(result.exitCode, 4);
    EXPECT_FALSE(exists("tree_0009.csv")); // and before any work, where that is known
}

TEST_F(CommandFrames, AnInputOfAFrameThatIsDoneMayChange)
{
    for (const char* line :
        {"-read smoke_####.vdb delayed=1 -spheretree spheres=1 -write t_####.vdb",
            "-for i=8,10 -read smoke_####.vdb delayed=1 -spheretree spheres=1 -write t_####.vdb "
            "-end"}) {
        writeFrames({8, 9});
        const std::string bytes = readText(path("smoke_0009.vdb"));
        std::filesystem::remove(path("smoke_0009.vdb"));
        const std::string fifo = path("smoke_0009.vdb");
        ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
        auto running = start(command_test::split(line));
        ASSERT_TRUE(running.waitForError(" (1 of 2): tree"));
        std::ofstream(path("smoke_0008.vdb"), std::ios::app) << "more";
        command_test::writeText(fifo, bytes);
        const Result result = running.wait();
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_TRUE(existAll("t", {8, 9})) << line;
        std::filesystem::remove(fifo);
    }
}

TEST_F(CommandFrames, FilesThatAreReadMayBeReplaced)
{
    writeFrames({8, 9});
    const Result result = run("-read smoke_####.vdb -spheretree spheres=1 -write smoke_####.vdb");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(readGrids("smoke_0009.vdb")[0]->isType<openvdb::points::PointDataGrid>());
}

TEST_F(CommandFrames, TimesOfStatsCountFromTheBeginOfTheFrame)
{
    writeFrames({8, 9});
    const Result result =
        run("-read smoke_####.vdb -spheretree spheres=1 -stats json=s_{$frame}.json "
            "-write tree_####.vdb");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_TRUE(exists("s_8.json") && exists("s_9.json"));
}

struct BadFrames {
    const char* name;
    const char* line;
    int exitCode;
    const char* message;
};

void PrintTo(const BadFrames& bad, std::ostream* out) { *out << bad.line; }

class CommandBadFrames : public CommandFrames, public testing::WithParamInterface<BadFrames> {};

TEST_P(CommandBadFrames, AreRefusedBeforeAnyWork)
{
    writeFrames({8, 9});
    const auto before = files();
    const Result result = run(GetParam().line);
    EXPECT_EQ(result.exitCode, GetParam().exitCode) << result.err;
    EXPECT_TRUE(holds(result.err, GetParam().message)) << result.err;
    EXPECT_EQ(files(), before);
}

const BadFrames kBadFrames[] = {
    {"NoSuchSequence", "-read fog_####.vdb -spheretree -write t_####.vdb", 3,
        "no file is named like fog_####.vdb"},
    {"FramesWithoutAPlace", "-read smoke_0008.vdb frames=1-3 -spheretree -write t.vdb", 2,
        "frames= is for a sequence"},
    {"FramesInALoop", "-for i=8,9 -read smoke_####.vdb frames=8 -write t.vdb -end", 2,
        "frames= is for a sequence"},
    {"ARangeThatIsNone", "-read smoke_####.vdb frames=8..9 -write t_####.vdb", 2,
        "frames=8..9 is not understood: it takes ranges such as 1-25"},
    {"ARangeBackwards", "-read smoke_####.vdb frames=9-8 -write t_####.vdb", 2, "not understood"},
    {"AFrameTwice", "-read smoke_####.vdb frames=8,8-9 -write t_####.vdb", 2,
        "names a frame twice"},
    {"TooManyFrames", "-read smoke_####.vdb frames=1-1e9 -write t_####.vdb", 2, "not understood"},
    {"FarTooManyFrames", "-read smoke_####.vdb frames=1-1000000000 -write t_####.vdb", 2,
        "has more than 100000 frames"},
    {"FramesThatNobodyKnowsYet", "-read smoke_####.vdb frames={gridCount} -write t_####.vdb", 2,
        "frames= must be known before any work"},
    {"ANameWithoutAFrame", "-read smoke_0008.vdb -spheretree -write t_####.vdb", 2,
        "t_####.vdb has a place for a frame number, and there is none"},
    {"NoIntegerInTheLoop", "-each s=a,b -read smoke_0008.vdb -write {$s}_##.vdb -end", 2,
        "there is none"},
    {"ALoopWithoutEnd", "-for i=8,10 -read smoke_####.vdb -write t_####.vdb", 2,
        "-for has no -end"},
    {"StdoutForEachFrame", "-read smoke_####.vdb -spheretree -write stdout.csv", 2,
        "two outputs go to stdout"},
};

INSTANTIATE_TEST_SUITE_P(Frames, CommandBadFrames, testing::ValuesIn(kBadFrames),
    [](const auto& test) { return std::string(test.param.name); });

} // namespace
