// SPDX-License-Identifier: Apache-2.0
// memory= changes no byte of the result, is refused before the work where it is too little, and
// leaves no temporary file behind, whatever happens.

#include "CommandRunner.h"

#include <sys/resource.h>

namespace {

using command_test::CommandTest;
using command_test::readText;
using command_test::Result;
using command_test::Running;
using command_test::split;

class CommandMemory : public CommandTest {
protected:
    void SetUp() override
    {
        CommandTest::SetUp();
        mTemporary = mFolder / "temporary";
        std::filesystem::create_directory(mTemporary);
    }

    /// With TMPDIR set, and files of so many bytes at most.
    Running startWith(const std::string& line, const std::string& folder, rlim_t fileSize) const
    {
        return start(split(line), "/dev/null", [=] {
            setenv("TMPDIR", folder.c_str(), 1);
            const rlimit limit{fileSize, RLIM_INFINITY};
            setrlimit(RLIMIT_FSIZE, &limit);
        });
    }

    bool temporaryIsEmpty() const { return std::filesystem::is_empty(mTemporary); }

    std::filesystem::path mTemporary;
};

/// A ball of radius 40, whose labels need 3 MiB in memory, and 1 MiB packed.
const std::string kSmallBall =
    "-threads 2 -generate shape=ball voxels=270000 -spheretree errors=0 ";
/// The same with 300 MB and 60 MB.
const std::string kLargeBall =
    "-threads 2 -generate shape=ball voxels=3e7 -spheretree tree=extended errors=0 topology=0 "
    "memory=70MB -write t.csv";

TEST_F(CommandMemory, ChangesNoByteOfTheResult)
{
    for (const std::string tree : {"tree=tight", "tree=extended", "tree=reversible dag=1"}) {
        const Result usual = run(kSmallBall + tree + " -write a.csv a.json");
        const Result little = run(kSmallBall + tree + " memory=2500000 -write b.csv b.json");
        EXPECT_EQ(usual.exitCode, 0) << usual.err;
        EXPECT_EQ(little.exitCode, 0) << little.err;
        EXPECT_EQ(readText(path("a.csv")), readText(path("b.csv"))) << tree;
        EXPECT_EQ(readText(path("a.json")), readText(path("b.json"))) << tree;
        EXPECT_EQ(readText(path("a.json")).find("\"memory\""), std::string::npos);
    }
}

TEST_F(CommandMemory, IsToldByVerboseAndStats)
{
    const Result packed = run("-verbose " + kSmallBall + "tree=extended memory=2MiB -stats json=-");
    EXPECT_NE(packed.err.find("memory: 2 MiB allowed"), std::string::npos) << packed.err;
    EXPECT_NE(packed.err.find("labels compressed"), std::string::npos) << packed.err;
    EXPECT_NE(packed.out.find("\"memory\": \"2MiB\""), std::string::npos) << packed.out;
    const Result usual = run("-verbose " + kSmallBall + "tree=extended -stats json=-");
    EXPECT_NE(usual.err.find("11 of 11 slabs at a time\n"), std::string::npos) << usual.err;
    EXPECT_NE(usual.out.find("\"memory\": \"75%\""), std::string::npos) << usual.out;
}

TEST_F(CommandMemory, TooLittleIsRefused)
{
    const auto before = files();
    for (const std::string tree : {"tree=tight", "tree=extended", "tree=extended dist=l1"}) {
        const Result result = run(kSmallBall + tree + " memory=500kB -write t.csv");
        EXPECT_EQ(result.exitCode, 3) << result.err;
        const bool isTight = tree == "tree=tight";
        const std::string what = isTight ? "a tight tree of this object needs about " : "";
        const std::string allowed = isTight
            ? " MiB, and memory= allows 488.2 KiB"
            : "MiB for their power labels, and memory= allows 488.2 KiB";
        EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
        EXPECT_NE(result.err.find(allowed), std::string::npos) << result.err;
        EXPECT_EQ(files(), before);
    }
}

TEST_F(CommandMemory, ADiskThatIsFullIsAnErrorThatLeavesNothing)
{
    const auto before = files();
    const Result result = startWith(kLargeBall, mTemporary.string(), 5000000).wait();
    EXPECT_EQ(result.exitCode, 4) << result.err;
    EXPECT_NE(result.err.find("the temporary file in '" + mTemporary.string() + "' does not take "),
        std::string::npos)
        << result.err;
    EXPECT_NE(result.err.find("set TMPDIR to a folder that has room"), std::string::npos);
    EXPECT_EQ(files(), before);
    EXPECT_TRUE(temporaryIsEmpty());
}

TEST_F(CommandMemory, AFolderThatIsNoneIsAnError)
{
    const std::string nowhere = (mFolder / "nowhere").string();
    const Result result = startWith(kLargeBall, nowhere, RLIM_INFINITY).wait();
    EXPECT_EQ(result.exitCode, 4) << result.err;
    EXPECT_NE(result.err.find("'" + nowhere + "' cannot be made: No such file"), std::string::npos)
        << result.err;
}

/// @return whether a process has a file open in a folder, waiting for it half a minute at most.
bool waitForOpenFile(pid_t process, const std::string& folder)
{
    const std::string files = "/proc/" + std::to_string(process) + "/fd";
    for (int i = 0; i < 3000; ++i) {
        std::error_code gone;
        for (const auto& file : std::filesystem::directory_iterator(files, gone)) {
            const auto target = std::filesystem::read_symlink(file.path(), gone);
            // The thread sanitizer makes a file of its own there.
            if (target.filename().string().compare(0, 5, "tsan.") == 0) continue;
            if (target.string().compare(0, folder.size(), folder) == 0) return true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

TEST_F(CommandMemory, AnInterruptLeavesNothing)
{
    const auto before = files();
    for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
        Running command = startWith(kLargeBall, mTemporary.string(), RLIM_INFINITY);
        ASSERT_TRUE(waitForOpenFile(command.process(), mTemporary.string()));
        EXPECT_TRUE(temporaryIsEmpty()) << "the file has a name";
        command.send(signal);
        EXPECT_EQ(command.wait().exitCode, signal == SIGKILL ? -1 : 5);
        EXPECT_EQ(files(), before);
        EXPECT_TRUE(temporaryIsEmpty());
    }
}

} // namespace
