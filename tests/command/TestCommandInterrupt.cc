// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and its relatives stop the command cleanly: exit code 5, no file, no temporary file.

#include "CommandRunner.h"

#include <chrono>
#include <fstream>
#include <random>
#include <thread>

#include <sys/stat.h>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;
using command_test::Running;

class CommandInterrupt : public CommandTest {
protected:
    void writeNoise(const std::string& name, int size) const
    {
        std::mt19937 random(7);
        std::string values(size_t(size) * size * size, '\0');
        for (char& value : values) value = char(random() & 1);
        writeVol(name, openvdb::Coord(size), values);
    }
};

TEST_F(CommandInterrupt, StopsALongBuildAndLeavesNothing)
{
    writeNoise("noise.vol", 320); // 16 million balls: many seconds of work
    command_test::writeText(path("t.vdb"), "precious");
    const auto before = files();
    for (const int signal : {SIGINT, SIGTERM}) {
        Running command = start({"-read", "noise.vol", "-spheretree", "-write", "t.vdb"});
        ASSERT_TRUE(command.waitForError("-read noise.vol ... completed"));
        command.send(signal);
        const Result result = command.wait();
        EXPECT_EQ(result.exitCode, 5) << result.err;
        EXPECT_NE(result.err.find("interrupted"), std::string::npos);
        EXPECT_EQ(files(), before);
        EXPECT_EQ(readText(path("t.vdb")), "precious");
    }
}

/// A script's background jobs ignore Ctrl-C, and what nohup starts ignores the end of its terminal.
TEST_F(CommandInterrupt, LeavesIgnoredSignalsIgnored)
{
    ASSERT_EQ(mkfifo(path("silent").c_str(), 0600), 0);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
        Running command = start(
            {"-config", "silent", "-print"}, "/dev/null", [number] { signal(number, SIG_IGN); });
        std::ofstream pipe(path("silent")); // waits for the command to open it
        command.send(number);
        std::this_thread::sleep_for(std::chrono::milliseconds(200)); // in which a stop would end it
        pipe << "quiet\n";
        pipe.close();
        const Result result = command.wait();
        EXPECT_EQ(result.exitCode, 0) << result.err;
    }
}

/// A limit of processor time is a request to stop as well.
TEST_F(CommandInterrupt, WakesACommandThatWaitsForItsInput)
{
    ASSERT_EQ(mkfifo(path("silent").c_str(), 0600), 0);
    writeBlock("a.vol");
    const auto before = files();
    for (const int number : {SIGINT, SIGXCPU}) {
        Running command =
            start({"-read", "a.vol", "-read", "stdin.vdb", "-spheretree", "-write", "t.vdb"},
                path("silent").string());
        ASSERT_TRUE(command.waitForError("-read a.vol ... completed"));
        command.send(number);
        EXPECT_EQ(command.wait().exitCode, 5) << number;
        EXPECT_EQ(files(), before);
    }
}

TEST_F(CommandInterrupt, WakesACommandThatWaitsForTheWriterOfAPipe)
{
    for (const char* name : {"first", "second", "silent.vdb"}) {
        ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0);
    }
    const auto before = files();
    const std::vector<std::string> lines[] = {
        {"-config", "first", "second"}, {"-config", "first", "-read", "silent.vdb"}};
    for (const auto& line : lines) {
        Running command = start(line);
        command_test::writeText(path("first"), "quiet\n"); // waits for the command to open it
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        command.send(SIGTERM);
        const Result result = command.wait();
        EXPECT_EQ(result.exitCode, 5) << result.err;
        EXPECT_NE(result.err.find("interrupted"), std::string::npos) << result.err;
        EXPECT_EQ(files(), before);
    }
}

TEST_F(CommandInterrupt, ReadsAPipeWhoseWriterComesLate)
{
    writeBlock("block.vol");
    ASSERT_EQ(run("-read block.vol -write block.vdb").exitCode, 0);
    for (const char* name : {"late.vdb", "late.txt"}) {
        ASSERT_EQ(mkfifo(path(name).c_str(), 0600), 0);
    }
    const Result result =
        shell("(sleep 0.5; echo read late.vdb > late.txt; sleep 0.5; cat block.vdb > late.vdb) & "
              "$VDB_SPHERETREE -config late.txt -print");
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("block"), std::string::npos) << result.out;
}

} // namespace
