// SPDX-License-Identifier: Apache-2.0
// Ctrl-C and its relatives stop the command cleanly: exit code 5, no file, no temporary file.

#include "CommandRunner.h"

#include <random>

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

TEST_F(CommandInterrupt, WakesACommandThatWaitsForItsInput)
{
    ASSERT_EQ(mkfifo(path("silent").c_str(), 0600), 0);
    writeBlock("a.vol");
    const auto before = files();
    Running command =
        start({"-read", "a.vol", "-read", "stdin.vdb", "-spheretree", "-write", "t.vdb"},
            path("silent").string());
    ASSERT_TRUE(command.waitForError("-read a.vol ... completed"));
    command.send(SIGINT);
    EXPECT_EQ(command.wait().exitCode, 5);
    EXPECT_EQ(files(), before);
}

} // namespace
