// SPDX-License-Identifier: Apache-2.0
// Where results go: targets that cannot be written (exit code 4), files that are whole or absent,
// the same bytes always, pipes, stdout and stderr.

#include "CommandRunner.h"
#include "support/VdbSamples.h"

#include <openvdb/openvdb.h>

#include <sys/resource.h>
#include <sys/stat.h>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;
using command_test::writeText;

class CommandOutput : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        writeBlock("a.vol");
    }

    void expectOutputError(const std::string& target) const
    {
        const Result result = run("-read a.vol -spheretree -write " + target);
        EXPECT_EQ(result.exitCode, 4) << result.err;
        EXPECT_NE(result.err.find(target), std::string::npos) << result.err;
        EXPECT_EQ(result.err.find("completed"), std::string::npos)
            << "work was done: " << result.err;
    }
};

TEST_F(CommandOutput, AFolderThatIsNotThereIsFoundBeforeAnyWork)
{
    expectOutputError("nowhere/t.vdb");
    EXPECT_FALSE(exists("nowhere"));
}

TEST_F(CommandOutput, ATargetThatIsAFolder)
{
    std::filesystem::create_directory(path("t.vdb"));
    expectOutputError("t.vdb");
    expectOutputError("a.vol/t.vdb");
}

TEST_F(CommandOutput, ATargetThatIsNoRegularFile)
{
    ASSERT_EQ(mkfifo(path("t.vdb").c_str(), 0600), 0);
    expectOutputError("t.vdb");
}

TEST_F(CommandOutput, AProtectedFileOrFolder)
{
    if (geteuid() == 0) GTEST_SKIP() << "nothing is protected from root";
    writeText(path("t.vdb"), "precious");
    chmod(path("t.vdb").c_str(), 0444);
    expectOutputError("t.vdb");
    std::filesystem::create_directory(path("locked"));
    chmod(path("locked").c_str(), 0555);
    expectOutputError("locked/t.vdb");
}

TEST_F(CommandOutput, ADiskThatIsFullLeavesTheOldFile)
{
    writeText(path("t.vdb"), "precious");
    const auto before = files();
    const auto limit = [] {
        const rlimit small = {1000, 1000};
        setrlimit(RLIMIT_FSIZE, &small);
    };
    // stderr is a file too; -quiet keeps it short.
    const Result result =
        start({"-quiet", "-read", "a.vol", "-spheretree", "-write", "t.vdb"}, "/dev/null", limit)
            .wait();
    EXPECT_EQ(result.exitCode, 4) << result.err;
    EXPECT_NE(result.err.find("t.vdb"), std::string::npos) << result.err;
    EXPECT_EQ(readText(path("t.vdb")), "precious");
    EXPECT_EQ(files(), before);
}

TEST_F(CommandOutput, TheSecondFileFailingLeavesTheFirstUnwritten)
{
    writeText(path("t.vdb"), "precious");
    const Result result = run("-read a.vol -write t.vdb t.csv");
    EXPECT_EQ(result.exitCode, 3) << "a table needs a sphere-tree";
    EXPECT_EQ(readText(path("t.vdb")), "precious");
    EXPECT_FALSE(exists("t.csv"));
}

TEST_F(CommandOutput, ANewFileReplacesTheOldOneAndKeepsItsPermissions)
{
    writeText(path("t.vdb"), "old");
    chmod(path("t.vdb").c_str(), 0640);
    EXPECT_EQ(run("-read a.vol -spheretree -write t.vdb u.vdb").exitCode, 0);
    EXPECT_GT(readText(path("t.vdb")).size(), 100u);
    struct stat info;
    ASSERT_EQ(stat(path("t.vdb").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, 0640u);
    const mode_t mask = umask(0);
    umask(mask);
    ASSERT_EQ(stat(path("u.vdb").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777, 0666u & ~mask);
    EXPECT_EQ(files(), (std::vector<std::string>{"a.vol", "t.vdb", "u.vdb"}));
}

TEST_F(CommandOutput, ALinkIsFollowed)
{
    writeText(path("real.vdb"), "old");
    std::filesystem::create_symlink("real.vdb", path("t.vdb"));
    EXPECT_EQ(run("-read a.vol -spheretree -write t.vdb").exitCode, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(path("t.vdb")));
    EXPECT_GT(readText(path("real.vdb")).size(), 100u);
}

TEST_F(CommandOutput, AFileMayReplaceTheOneItWasMadeFrom)
{
    EXPECT_EQ(run("-read a.vol -mask -write a.vdb").exitCode, 0);
    EXPECT_EQ(run("-read a.vdb -spheretree -write a.vdb").exitCode, 0);
    EXPECT_EQ(run("-read a.vdb -stats").exitCode, 0);
}

TEST_F(CommandOutput, TheSameBytesForEveryRunAndNumberOfThreads)
{
    writeGrids("ball.vdb", {sphereGrid("ball", 12)});
    for (const std::string input : {"a.vol", "ball.vdb"}) {
        for (const std::string options : {"", " tree=reversible dag=1 padding=voxels"}) {
            const std::string make = "-read " + input + " -spheretree" + options + " -write ";
            EXPECT_EQ(run("-threads 1 " + make + "one.vdb one.csv").exitCode, 0);
            EXPECT_EQ(run("-threads 2 " + make + "two.vdb two.csv").exitCode, 0);
            EXPECT_EQ(run(make + "again.vdb").exitCode, 0);
            const std::string one = readText(path("one.vdb"));
            EXPECT_GT(one.size(), 100u);
            EXPECT_EQ(one, readText(path("two.vdb")));
            EXPECT_EQ(one, readText(path("again.vdb")));
            EXPECT_EQ(readText(path("one.csv")), readText(path("two.csv")));
        }
    }
}

TEST_F(CommandOutput, SameBytesOnStdoutAndForOtherGrids)
{
    const std::string line = "$VDB_SPHERETREE -quiet -read a.vol -spheretree "
                             "-spheres2ls -write stdout.vdb | cksum";
    const std::string first = shell(line).out;
    EXPECT_EQ(first, shell(line).out);
    EXPECT_EQ(first.find(" 0\n"), std::string::npos) << "nothing came: " << first;
}

TEST_F(CommandOutput, FilesOfDifferentContentHaveDifferentIdentifiers)
{
    ASSERT_EQ(run("-read a.vol -spheretree -write a.vdb").exitCode, 0);
    ASSERT_EQ(run("-read a.vol -spheretree tree=extended factor=3 -write b.vdb").exitCode, 0);
    openvdb::io::File a(path("a.vdb").string()), b(path("b.vdb").string());
    a.open();
    b.open();
    EXPECT_EQ(a.getUniqueTag().size(), 36u);
    EXPECT_NE(a.getUniqueTag(), b.getUniqueTag());
}

TEST_F(CommandOutput, EveryCodecReadsBackTheSame)
{
    const Result expected = run("-quiet -read a.vol -spheretree -write t.csv");
    ASSERT_EQ(expected.exitCode, 0);
    for (const std::string codec : {"none", "zip", "blosc", "active"}) {
        EXPECT_EQ(run("-read a.vol -spheretree -write t.vdb codec=" + codec).exitCode, 0);
        EXPECT_EQ(run("-read t.vdb -write back.csv").exitCode, 0);
        EXPECT_EQ(readText(path("back.csv")), readText(path("t.csv"))) << codec;
    }
}

TEST_F(CommandOutput, TimesGoToStderrAndQuietMeansQuiet)
{
    writeVol("a.vol", openvdb::Coord(16, 3, 2), std::string(96, '\1')); // too few are warned of
    const Result normal = run("-read a.vol -spheretree -write t.vdb");
    EXPECT_EQ(normal.out, "");
    EXPECT_EQ(std::count(normal.err.begin(), normal.err.end(), '\n'), 3) << normal.err;
    EXPECT_EQ(normal.err.find('\033'), std::string::npos) << "colour, and no terminal";
    const Result quiet = run("-quiet -read a.vol -spheretree -write t.vdb");
    EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(CommandOutput, StdoutCarriesNothingButTheGrids)
{
    const Result result = run("-read a.vol -spheretree -stats -print -write stdout.vdb");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.err.find("hamming"), std::string::npos);
    writeText(path("t.vdb"), result.out);
    EXPECT_EQ(readGrids("t.vdb").size(), 1u);
}

TEST_F(CommandOutput, AClosedPipeIsAnOutputError)
{
    const Result result = shell("{ $VDB_SPHERETREE -read a.vol -spheretree -spheres2ls voxel=0.05 "
                                "-write stdout.vdb codec=none;"
                                " echo $? > code; } | true");
    EXPECT_EQ(readText(path("code")), "4\n") << result.err;
    EXPECT_EQ(shell("$VDB_SPHERETREE -read a.vol -write stdout.vdb | cat > c.vdb").exitCode, 0);
    EXPECT_EQ(readGrids("c.vdb").size(), 1u) << "an open one is none";
}

TEST_F(CommandOutput, WhatVdbToolWritesIsReadAsItIsWithEachCodec)
{
    if (!isInstalled("vdb_tool")) GTEST_SKIP() << "needs vdb_tool";
    for (const std::string codec : {"none", "zip", "blosc", "active"}) {
        SCOPED_TRACE(codec);
        const Result tool = shell(
            "vdb_tool -quiet -sphere dim=40 -dilate radius=1 -ls2fog keep=1 -write tool.vdb codec="
            + codec);
        ASSERT_EQ(tool.exitCode, 0) << tool.err;
        ASSERT_EQ(run("-read tool.vdb -write ours.vdb codec=" + codec).exitCode, 0);
        const auto expected = readGrids("tool.vdb"), grids = readGrids("ours.vdb");
        ASSERT_EQ(grids.size(), expected.size());
        for (size_t i = 0; i < grids.size(); ++i) {
            EXPECT_TRUE(
                spheretree_test::contentOf(grids[i]) == spheretree_test::contentOf(expected[i]))
                << expected[i]->getName();
        }
    }
}

TEST_F(CommandOutput, VdbToolAndVdbPrintTakeWhatWeWrite)
{
    if (!isInstalled("vdb_tool") || !isInstalled("vdb_print")) {
        GTEST_SKIP() << "needs vdb_tool and vdb_print";
    }
    const Result piped =
        shell("vdb_tool -quiet -sphere dim=40 -o stdout.vdb"
              " | $VDB_SPHERETREE -quiet -read stdin.vdb -spheretree tree=extended dag=1 -write "
              "stdout.vdb"
              " | vdb_tool -quiet -read stdin.vdb -write tool.vdb && vdb_print -l tool.vdb");
    EXPECT_EQ(piped.exitCode, 0) << piped.err;
    EXPECT_NE(piped.out.find("spheretree"), std::string::npos) << piped.out << piped.err;
    const Result back = run("-read tool.vdb -stats");
    EXPECT_EQ(back.exitCode, 0) << back.err;
    EXPECT_EQ(run("-read a.vol -spheretree -write t.vdb").exitCode, 0);
    const Result printed = shell("vdb_print -m t.vdb && vdb_tool -read t.vdb -print");
    EXPECT_EQ(printed.exitCode, 0) << printed.err;
    EXPECT_NE(printed.out.find("spheretree"), std::string::npos) << printed.out;
}

} // namespace
