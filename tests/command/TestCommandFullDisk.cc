// SPDX-License-Identifier: Apache-2.0
// Disks that are full or broken, and limits on the size of files, in the middle of each kind of
// output: exit code 4, the reason, the old file untouched, nothing left behind.

#include "FaultyCommand.h"

#include "support/TemporaryFolder.h"

#include <openvdb_spheretree/export/ExportFormat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>

namespace {

using namespace command_test;

struct Output {
    std::string name, arguments;
    std::vector<std::string> targets;
};

void PrintTo(const Output& output, std::ostream* out) { *out << output.name; }

// Each writes several times what the stream's buffer holds, so that there is a middle.
const std::vector<Output> kOwnOutputs = {
    {"Tree", "-read tree.vdb -write out.vdb codec=none", {"out.vdb"}},
    {"Table", "-read tree.vdb -write out.csv", {"out.csv", "out_dag.csv"}},
    {"Json", "-read tree.vdb -write out.json", {"out.json"}},
    {"Page", "-read tree.vdb -write out.html", {"out.html"}},
    {"Picture", "-read tree.vdb -write out.png width=300 height=200", {"out.png"}},
    {"LevelSet", "-read tree.vdb -spheres2ls -write out.vdb codec=none", {"out.vdb"}},
    {"Mask", "-read a.vol -mask -write out.vdb codec=none", {"out.vdb"}},
    {"Volume", "-read a.vol -write out.vol", {"out.vol"}},
    {"NanoVdbMask", "-read a.vol -write out.nvdb", {"out.nvdb"}},
    {"Photo", "-read tree.vdb -write out.jpg width=300 height=200", {"out.jpg"}},
    {"Curve", "-read tree.vdb -write out.svg", {"out.svg"}},
    {"CurveTable", "-read tree.vdb -write out.csv format=curve", {"out.csv"}},
    {"Stats", "-read tree.vdb -stats json=out.json", {"out.json"}},
    {"StatsTable", "-read tree.vdb -stats csv=out.csv", {"out.csv"}},
    {"Answers", "-read tree.vdb tree.vdb -distance json=out.json", {"out.json"}},
    {"AnswerTable", "-read tree.vdb tree.vdb -collide csv=out.csv", {"out.csv"}},
    {"Rays", "-read tree.vdb -raycast origin=-9,0,0 direction=1,0,0 json=out.json", {"out.json"}},
    {"RayTable", "-read tree.vdb -raycast origin=-9,0,0 direction=1,0,0 csv=out.csv", {"out.csv"}},
    {"Points", "-read tree.vdb -contains point=1,2,3 json=out.json", {"out.json"}},
    {"PointTable", "-read tree.vdb -contains point=1,2,3 csv=out.csv", {"out.csv"}},
};

/// Those and every file for other tools that this build writes.
std::vector<Output> allOutputs()
{
    std::vector<Output> outputs = kOwnOutputs;
    for (const auto& format : openvdb_spheretree::exportFormats()) {
        if (!format.missing.empty()) continue;
        const std::string& extension = format.extensions.front();
        std::string name = format.name + extension;
        std::replace_if(
            name.begin(), name.end(), [](char c) { return c == '.' || c == '-'; }, '_');
        outputs.push_back({name, "-read tree.vdb -write out" + extension + " format=" + format.name,
            {"out" + extension}});
    }
    return outputs;
}

class CommandFullDisk : public FaultyCommandTest, public testing::WithParamInterface<Output> {
protected:
    void SetUp() override
    {
        FaultyCommandTest::SetUp();
        if (!IsSkipped()) writeOld(GetParam().targets);
    }

    /// Each of some moments, with files that have no name and with such that have.
    void expectFailureOf(const std::string& call, int error, long moments)
    {
        for (const std::string& kind : {std::string(), namedFilesOnly() + ";"}) {
            const long last = callsOf(GetParam().arguments, kind)[call];
            writeOld(GetParam().targets);
            for (const long n : spread(last, moments)) {
                SCOPED_TRACE(call + " " + std::to_string(n) + " of " + std::to_string(last));
                const Result result = runWith(GetParam().arguments, kind + failing(call, n, error));
                const bool isFirst = call != "rename" || n == 1;
                expectFailure(result, 4, {"cannot write out", std::strerror(error)},
                    isFirst ? GetParam().targets : std::vector<std::string>());
                writeOld(GetParam().targets);
            }
        }
    }
};

TEST_P(CommandFullDisk, LeavesTheOldFile) { expectFailureOf("write", ENOSPC, 6); }

TEST_P(CommandFullDisk, IsNoticedWhenTheDiskTellsLate) { expectFailureOf("fsync", EIO, 2); }

TEST_P(CommandFullDisk, ARenameThatFailsLeavesTheOldFile) { expectFailureOf("rename", EACCES, 2); }

TEST_P(CommandFullDisk, ANameThatCannotBeMadeLeavesTheOldFile)
{
    const Result result = runWith(GetParam().arguments, failing("link", 1, ENOSPC));
    expectFailure(result, 4, {"cannot write out", std::strerror(ENOSPC)}, GetParam().targets);
}

TEST_P(CommandFullDisk, ALimitOnTheSizeOfFilesLeavesTheOldFile)
{
    ASSERT_EQ(run(GetParam().arguments).exitCode, 0);
    const auto size = long(std::filesystem::file_size(path(GetParam().targets.back())));
    writeOld(GetParam().targets);
    // Times are in -stats, so that it is some digits longer or shorter each time.
    for (const long limit : spread(size - size / 8 - 1, 4)) {
        SCOPED_TRACE(limit);
        const Result result = start(split("-quiet " + GetParam().arguments), "/dev/null", [=] {
            const rlimit small = {rlim_t(limit), rlim_t(limit)};
            setrlimit(RLIMIT_FSIZE, &small);
        }).wait();
        // stderr is a file as well, so a message may be cut.
        expectFailure(result, 4, {}, GetParam().targets);
    }
}

INSTANTIATE_TEST_SUITE_P(Outputs, CommandFullDisk, testing::ValuesIn(allOutputs()),
    [](const auto& info) { return info.param.name; });

class CommandRealDisk : public FaultyCommandTest {
protected:
    /// A disk of this test's process and its children alone, gone with them.
    bool mountDisk(const std::string& options) const
    {
        std::filesystem::create_directory(path("disk"));
        return unshare(CLONE_NEWNS) == 0 && mount("", "/", nullptr, MS_REC | MS_PRIVATE, "") == 0
            && mount("none", path("disk").c_str(), "tmpfs", 0, options.c_str()) == 0;
    }
};

TEST_F(CommandRealDisk, ASmallDiskThatRunsFull)
{
    if (!mountDisk("size=64k")) GTEST_SKIP() << "no disk can be mounted here";
    writeText(path("disk/out.vdb"), "precious");
    for (const char* arguments :
        {"-read a.vol -spheretree -spheres2ls voxel=0.1 -write disk/out.vdb",
            "-generate noise voxels=3000 -mask -write disk/out.vdb codec=none"}) {
        const Result result = run(arguments);
        EXPECT_EQ(result.exitCode, 4) << result.err;
        EXPECT_NE(result.err.find("disk/out.vdb: No space left"), std::string::npos) << result.err;
        EXPECT_EQ(readText(path("disk/out.vdb")), "precious");
        const std::filesystem::directory_iterator entry(path("disk")), end;
        EXPECT_EQ(std::distance(entry, end), 1);
    }
    EXPECT_EQ(run("-read a.vol -spheretree -write disk/out.vdb").exitCode, 0) << "there is room";
}

TEST_F(CommandRealDisk, ASmallDiskThatStandardInputIsPutOn)
{
    if (!mountDisk("size=64k")) GTEST_SKIP() << "no disk can be mounted here";
    const spheretree_test::TemporaryDirectory variable(path("disk").string());
    writeText(path("a.obj"), "v 0 0 0\n" + std::string(1 << 17, '#') + "\n");
    const Result result = start(split("-read stdin.obj -print"), path("a.obj").string()).wait();
    EXPECT_EQ(result.exitCode, 4) << result.err;
    EXPECT_NE(result.err.find("disk: No space left"), std::string::npos) << result.err;
    EXPECT_TRUE(std::filesystem::is_empty(path("disk")));
}

TEST_F(CommandRealDisk, ADiskThatIsReadOnly)
{
    if (!mountDisk("ro")) GTEST_SKIP() << "no disk can be mounted here";
    const Result result = run("-read a.vol -spheretree -write disk/out.vdb");
    EXPECT_EQ(result.exitCode, 4) << result.err;
    EXPECT_NE(result.err.find("Read-only file system"), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("completed"), std::string::npos) << "work was done: " << result.err;
}

} // namespace
