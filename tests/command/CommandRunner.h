// SPDX-License-Identifier: Apache-2.0
/// @file CommandRunner.h
/// @brief For tests of the command: a folder of their own, small inputs, and the program run as a
/// user runs it, with what it printed and how it ended.

#pragma once

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace command_test {

struct Result {
    int exitCode = -1; ///< -1: killed by a signal
    std::string out, err;
};

inline std::string readText(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

inline void writeText(const std::filesystem::path& path, const std::string& text)
{
    std::ofstream(path, std::ios::binary) << text;
}

/// A program that has been started, and can be sent a signal before it is waited for.
class Running {
public:
    /// @param prepare  runs in the new process just before the program
    Running(const std::vector<std::string>& line, const std::filesystem::path& folder,
        const std::string& input = "/dev/null", const std::function<void()>& prepare = {})
        : mFolder(folder)
    {
        std::vector<char*> argv;
        for (const std::string& word : line) argv.push_back(const_cast<char*>(word.c_str()));
        argv.push_back(nullptr);
        const std::string out = (folder / "stdout.txt").string();
        const std::string err = (folder / "stderr.txt").string();
        std::filesystem::remove(out);
        std::filesystem::remove(err);
        mProcess = fork();
        if (mProcess != 0) return;
        // O_RDWR, so that opening a named pipe does not wait for the other end.
        dup2(open(input.c_str(), O_RDWR | O_CLOEXEC), 0);
        dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600), 1);
        dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600), 2);
        if (chdir(folder.c_str()) != 0) _exit(126);
        if (prepare) prepare();
        execvp(argv[0], argv.data());
        _exit(127);
    }

    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;
    ~Running() // a test that fails half way leaves nothing running
    {
        if (mProcess <= 0) return;
        kill(mProcess, SIGKILL);
        waitpid(mProcess, nullptr, 0);
    }

    void send(int signal) { kill(mProcess, signal); }
    pid_t process() const { return mProcess; }

    /// @return whether @a text has come on stderr, waiting for it half a minute at most.
    bool waitForError(const std::string& text)
    {
        for (int i = 0; i < 3000; ++i) {
            if (readText(mFolder / "stderr.txt").find(text) != std::string::npos) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }

    /// Waits five minutes at most, so that a command that hangs fails its test and no more.
    Result wait()
    {
        int status = 0;
        bool ended = false;
        for (int i = 0; i < 300000 && !ended; ++i) {
            ended = waitpid(mProcess, &status, WNOHANG) == mProcess;
            if (!ended) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        if (!ended) {
            ADD_FAILURE() << "the command hangs";
            kill(mProcess, SIGKILL);
            waitpid(mProcess, &status, 0);
        }
        mProcess = -1;
        Result result;
        if (WIFEXITED(status)) result.exitCode = WEXITSTATUS(status);
        result.out = readText(mFolder / "stdout.txt");
        result.err = readText(mFolder / "stderr.txt");
        return result;
    }

private:
    std::filesystem::path mFolder;
    pid_t mProcess = -1;
};

/// Words separated by blanks.
inline std::vector<std::string> split(const std::string& line)
{
    std::istringstream in(line);
    return {std::istream_iterator<std::string>(in), {}};
}

class CommandTest : public testing::Test {
protected:
    void SetUp() override
    {
        openvdb::initialize();
        std::string name = (std::filesystem::temp_directory_path() / "spheretree.XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        mFolder = name;
        std::filesystem::create_directory(mFolder / "work");
        mWork = mFolder / "work";
    }
    void TearDown() override
    {
        std::error_code ignored;
        std::filesystem::remove_all(mFolder, ignored);
    }

    std::filesystem::path path(const std::string& name) const { return mWork / name; }
    bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }

    /// The names of all files in the folder the command runs in, hidden ones too.
    std::vector<std::string> files() const
    {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(mWork)) {
            const std::string name = entry.path().filename().string();
            if (name != "stdout.txt" && name != "stderr.txt") names.push_back(name);
        }
        std::sort(names.begin(), names.end());
        return names;
    }

    Running start(const std::vector<std::string>& arguments, const std::string& input = "/dev/null",
        const std::function<void()>& prepare = {}) const
    {
        std::vector<std::string> line = {VDB_SPHERETREE_COMMAND};
        line.insert(line.end(), arguments.begin(), arguments.end());
        return Running(line, mWork, input, prepare);
    }

    Result run(const std::string& arguments) const { return start(split(arguments)).wait(); }
    Result runWords(const std::vector<std::string>& words) const { return start(words).wait(); }

    /// A line of the shell, in which $VDB_SPHERETREE is the command.
    Result shell(const std::string& line) const
    {
        setenv("VDB_SPHERETREE", VDB_SPHERETREE_COMMAND, 1);
        return Running({"/bin/sh", "-c", line}, mWork).wait();
    }

    static bool isInstalled(const std::string& program)
    {
        return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
    }

    /// Values by x, then y, then z, as in the file.
    void writeVol(
        const std::string& name, const openvdb::Coord& size, const std::string& values) const
    {
        std::ostringstream text;
        text << "Version: 2\nX: " << size[0] << "\nY: " << size[1] << "\nZ: " << size[2]
             << "\nVoxel-Size: 1\nVoxel-Endian: 0\nInt-Endian: 0123\nAlpha-Color: 0\n.\n";
        writeText(path(name), text.str() + values);
    }

    /// A block with a corner missing: 8 x 6 x 5 less 2 x 2 x 2.
    void writeBlock(const std::string& name) const
    {
        const openvdb::Coord size(8, 6, 5);
        std::string values;
        for (int z = 0; z < 5; ++z) {
            for (int y = 0; y < 6; ++y) {
                for (int x = 0; x < 8; ++x) values += x < 2 && y < 2 && z < 2 ? '\0' : '\1';
            }
        }
        writeVol(name, size, values);
    }
    static constexpr int kBlockVoxels = 232;

    void writeGrids(const std::string& name, const openvdb::GridPtrVec& grids) const
    {
        openvdb::io::File(path(name).string()).write(grids);
    }

    static openvdb::FloatGrid::Ptr sphereGrid(const std::string& name, float radius = 6)
    {
        auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
            radius, openvdb::Vec3f(0.5f, 1.f, -2.f), 0.5f);
        grid->setName(name);
        return grid;
    }

    openvdb::GridPtrVec readGrids(const std::string& name) const
    {
        openvdb::io::File file(path(name).string());
        file.open(/*delayLoad=*/false);
        return *file.getGrids();
    }

    std::filesystem::path mFolder, mWork;
};

} // namespace command_test
