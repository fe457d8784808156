// SPDX-License-Identifier: Apache-2.0
// What long work shows on a terminal and in a log. (unit/TestProgress.cc has its parts.)

#include "CommandRunner.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include <pty.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

class CommandProgress : public command_test::CommandTest {
protected:
    /// @return all that the command prints on a terminal of so many columns.
    std::string onTerminal(unsigned short columns, const std::string& arguments) const
    {
        std::vector<std::string> line = command_test::split(arguments);
        std::vector<char*> argv;
        const std::string program = command_test::program();
        argv.push_back(const_cast<char*>(program.c_str()));
        for (std::string& word : line) argv.push_back(word.data());
        argv.push_back(nullptr);
        winsize size = {};
        size.ws_col = columns;
        size.ws_row = 24;
        int terminal = -1;
        const pid_t child = forkpty(&terminal, nullptr, nullptr, &size);
        if (child == 0) {
            if (chdir(mWork.c_str()) == 0) execv(argv[0], argv.data());
            _exit(127);
        }
        std::string all;
        char block[4096];
        for (ssize_t count; (count = read(terminal, block, sizeof(block))) > 0;) {
            all.append(block, size_t(count));
        }
        close(terminal);
        int status = 0;
        waitpid(child, &status, 0);
        EXPECT_EQ(status, 0) << all;
        return all;
    }
};

TEST_F(CommandProgress, OnATerminalThereIsOneBarThatNeverFalls)
{
    const std::string all = onTerminal(60,
        "-generate gyroid voxels=1e6 name=an_object_with_a_long_name -spheretree "
        "spheres=1024,256,64 name=a_tree_with_a_long_name topology=0 -stats");
    std::istringstream in(all);
    std::string frame;
    int last = 0, bars = 0;
    while (std::getline(in, frame, '\r')) {
        const size_t end = frame.find('%');
        if (frame.rfind("\033[K-spheretree", 0) != 0 || end == frame.npos) continue;
        EXPECT_LE(frame.size() - 3, 59u) << frame;
        const int percent = std::atoi(frame.c_str() + frame.find_last_of(" ]", end) + 1);
        EXPECT_GE(percent, last) << frame;
        last = percent;
        ++bars;
    }
    EXPECT_GE(bars, 2) << all;
    EXPECT_EQ(last, 100);
}

TEST_F(CommandProgress, AQuickActionInALogShowsNothing)
{
    const command_test::Result result =
        run("-generate ball voxels=1e4 -spheretree reversible -write t.vdb");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 3) << result.err;
    EXPECT_EQ(result.err.find('%'), std::string::npos);
}

} // namespace
