// SPDX-License-Identifier: Apache-2.0
/// @file CommandRunner.h
/// @brief For tests of the command: a folder of their own, small inputs, and the program run as a
/// user runs it, with what it printed and how it ended.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <sys/types.h>

namespace command_test {

/// OpenVDB's GridPtrVec.
using Grids = std::vector<openvdb::SharedPtr<openvdb::GridBase>>;

struct Result {
    int exitCode = -1; ///< -1: killed by a signal
    int signal = 0;    ///< the one that killed it
    std::string out, err;
};

/// @return the command that is tested.
std::string program();

std::string readText(const std::filesystem::path& path);
/// @return the rows of a .csv, each by the names of its columns.
std::vector<std::map<std::string, std::string>> rowsOfCsv(const std::string& text);

void writeText(const std::filesystem::path& path, const std::string& text);
bool mentions(const std::string& text, const std::string& part);

/// A program that has been started, and can be sent a signal before it is waited for.
class Running {
public:
    /// @param prepare  runs in the new process just before the program
    Running(const std::vector<std::string>& line, const std::filesystem::path& folder,
        const std::string& input = "/dev/null", const std::function<void()>& prepare = {});

    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    ~Running(); // a test that fails half way leaves nothing running

    void send(int signal) { kill(mProcess, signal); }
    pid_t process() const { return mProcess; }

    /// @return whether @a text has come on stderr, waiting for it half a minute at most.
    bool waitForError(const std::string& text);

    /// @return whether the program has stopped (SIGSTOP) by itself, waiting for it half a minute at
    ///         most. All of it stands still until it is sent SIGCONT.
    bool waitUntilStopped();

    /// Waits five minutes at most, so that a command that hangs fails its test and no more.
    Result wait();

private:
    std::filesystem::path mFolder;
    pid_t mProcess = -1;
};

/// Words separated by blanks.
std::vector<std::string> split(const std::string& line);

class CommandTest : public testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;

    std::filesystem::path path(const std::string& name) const { return mWork / name; }
    bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }

    /// The names of all files in the folder the command runs in, hidden ones too.
    std::vector<std::string> files() const;

    Running start(const std::vector<std::string>& arguments, const std::string& input = "/dev/null",
        const std::function<void()>& prepare = {}) const;

    Result run(const std::string& arguments) const { return start(split(arguments)).wait(); }
    Result runWords(const std::vector<std::string>& words) const { return start(words).wait(); }

    /// A line of the shell, in which $VDB_SPHERETREE is the command.
    Result shell(const std::string& line) const;

    static bool isInstalled(const std::string& program);

    /// Values by x, then y, then z, as in the file.
    void writeVol(
        const std::string& name, const openvdb::Coord& size, const std::string& values) const;

    /// A block with a corner missing: 8 x 6 x 5 less 2 x 2 x 2.
    void writeBlock(const std::string& name) const;
    static constexpr int kBlockVoxels = 232;

    void writeGrids(const std::string& name, const Grids& grids) const;

    static openvdb::SharedPtr<openvdb::FloatGrid> sphereGrid(
        const std::string& name, float radius = 6);

    Grids readGrids(const std::string& name) const;

    std::filesystem::path mFolder, mWork;
};

} // namespace command_test
