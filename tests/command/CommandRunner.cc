// SPDX-License-Identifier: Apache-2.0
#include "CommandRunner.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace command_test {

// The one that was built, or another build of it: a mutant, say (scripts/mutate.sh).
std::string program()
{
    const char* other = std::getenv("SPHERETREE_TESTED_PROGRAM");
    return other ? other : VDB_SPHERETREE_COMMAND;
}

std::string readText(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

std::vector<std::map<std::string, std::string>> rowsOfCsv(const std::string& text)
{
    std::istringstream lines(text);
    std::vector<std::string> columns;
    std::vector<std::map<std::string, std::string>> rows;
    for (std::string line; std::getline(lines, line);) {
        std::vector<std::string> cells;
        std::istringstream in(line);
        for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
        if (columns.empty()) {
            columns = cells;
            continue;
        }
        rows.emplace_back();
        for (std::size_t i = 0; i < columns.size(); ++i) rows.back()[columns[i]] = cells.at(i);
    }
    return rows;
}

bool mentions(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

void writeText(const std::filesystem::path& path, const std::string& text)
{
    std::ofstream(path, std::ios::binary) << text;
}

Running::Running(const std::vector<std::string>& line, const std::filesystem::path& folder,
    const std::string& input, const std::function<void()>& prepare)
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
    // As a terminal's children have them, whatever the tests run under.
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) signal(number, SIG_DFL);
    if (prepare) prepare();
    execvp(argv[0], argv.data());
    _exit(127);
}

Running::~Running()
{
    if (mProcess <= 0) return;
    kill(mProcess, SIGKILL);
    waitpid(mProcess, nullptr, 0);
}

bool Running::waitForError(const std::string& text)
{
    for (int i = 0; i < 3000; ++i) {
        if (readText(mFolder / "stderr.txt").find(text) != std::string::npos) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

bool Running::waitUntilStopped()
{
    for (int i = 0; i < 3000; ++i) {
        siginfo_t info = {};
        // WNOWAIT: wait() is to see how it ended.
        waitid(P_PID, id_t(mProcess), &info, WSTOPPED | WEXITED | WNOHANG | WNOWAIT);
        if (info.si_code == CLD_STOPPED) return true;
        if (info.si_pid == mProcess) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

Result Running::wait()
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
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    result.out = readText(mFolder / "stdout.txt");
    result.err = readText(mFolder / "stderr.txt");
    return result;
}

std::vector<std::string> split(const std::string& line)
{
    std::istringstream in(line);
    return {std::istream_iterator<std::string>(in), {}};
}

void CommandTest::SetUp()
{
    openvdb::initialize();
    std::string name = (std::filesystem::temp_directory_path() / "spheretree.XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    mFolder = name;
    std::filesystem::create_directory(mFolder / "work");
    mWork = mFolder / "work";
}

void CommandTest::TearDown()
{
    std::error_code ignored;
    std::filesystem::remove_all(mFolder, ignored);
}

std::vector<std::string> CommandTest::files() const
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(mWork)) {
        const std::string name = entry.path().filename().string();
        if (name != "stdout.txt" && name != "stderr.txt") names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

Running CommandTest::start(const std::vector<std::string>& arguments, const std::string& input,
    const std::function<void()>& prepare) const
{
    std::vector<std::string> line = {program()};
    line.insert(line.end(), arguments.begin(), arguments.end());
    return Running(line, mWork, input, prepare);
}

Result CommandTest::shell(const std::string& line) const
{
    setenv("VDB_SPHERETREE", program().c_str(), 1);
    return Running({"/bin/sh", "-c", line}, mWork).wait();
}

bool CommandTest::isInstalled(const std::string& program)
{
    return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

void CommandTest::writeVol(
    const std::string& name, const openvdb::Coord& size, const std::string& values) const
{
    std::ostringstream text;
    text << "Version: 2\nX: " << size[0] << "\nY: " << size[1] << "\nZ: " << size[2]
         << "\nVoxel-Size: 1\nVoxel-Endian: 0\nInt-Endian: 0123\nAlpha-Color: 0\n.\n";
    writeText(path(name), text.str() + values);
}

void CommandTest::writeBlock(const std::string& name) const
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

void CommandTest::writeGrids(const std::string& name, const Grids& grids) const
{
    openvdb::io::File(path(name).string()).write(grids);
}

openvdb::SharedPtr<openvdb::FloatGrid> CommandTest::sphereGrid(
    const std::string& name, float radius)
{
    auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        radius, openvdb::Vec3f(0.5f, 1.f, -2.f), 0.5f);
    grid->setName(name);
    return grid;
}

Grids CommandTest::readGrids(const std::string& name) const
{
    openvdb::io::File file(path(name).string());
    file.open(/*delayLoad=*/false);
    return *file.getGrids();
}

} // namespace command_test
