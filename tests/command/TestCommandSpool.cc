// SPDX-License-Identifier: Apache-2.0
// Standard input that readers have as a file first: a disk that is full, limits on the size of files and
// kills in the middle of it leave nothing in the folder of temporary files.

#include "FaultyCommand.h"

#include "support/TemporaryFolder.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace {

using namespace command_test;

const std::string kLine = "-quiet -read stdin.obj -mesh2ls dim=8 -write t.vdb";
/// The input goes to the file by a mebibyte at a time.
constexpr long kWrites = 3;

class CommandSpool : public FaultyCommandTest {
protected:
    void SetUp() override
    {
        FaultyCommandTest::SetUp();
        if (IsSkipped()) return;
        mInput = (mFolder / "a.obj").string();
        const std::string mesh =
            "v 0 0 0\nv 8 0 0\nv 0 8 0\nv 0 0 8\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
        const std::string face = "f 1 3 2" + std::string(91, ' ') + "\n"; // there already
        std::string text = mesh;
        while (text.size() < (kWrites - 1) * (1 << 20) + 5000) text += face;
        writeText(mInput, text);
        writeOld({"t.vdb"});
        mTemporary.emplace();
    }

    Result runWith(const std::string& faults) const
    {
        return startWith(kLine, faults, mInput).wait();
    }

    /// With files that never have a name, and with such that have one for a moment.
    static std::vector<std::string> kindsOfFiles() { return {"", namedFilesOnly() + ";"}; }

    void expectNoRoom(const Result& result, int error) const
    {
        expectFailure(result, 4,
            {"stdin.obj: the temporary file in " + mTemporary->path() + ": " + std::strerror(error)
                + "; set TMPDIR to a folder that has room"},
            {"t.vdb"});
        EXPECT_EQ(mTemporary->files(), 0);
    }

    /// With these faults, all of the mesh is read.
    void expectWholeInput(const std::string& faults) const
    {
        const std::string line = "-quiet -read stdin.obj -print";
        const Result whole = startWith(line, "", mInput).wait();
        const Result faulty = startWith(line, faults, mInput).wait();
        EXPECT_EQ(faulty.exitCode, 0) << faulty.err;
        EXPECT_EQ(faulty.out, whole.out);
        EXPECT_TRUE(mentions(whole.out, " triangles")) << whole.out;
    }

    /// @return whether the folder of temporary files has files that never have a name.
    bool hasNamelessFiles() const
    {
        const int fd = open(mTemporary->path().c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
        if (fd < 0) return false;
        close(fd);
        return true;
    }

    std::optional<spheretree_test::TemporaryFolder> mTemporary;
    std::string mInput;
};

TEST_F(CommandSpool, ADiskThatRunsFullIsAnErrorThatLeavesNothing)
{
    for (const std::string& kind : kindsOfFiles()) {
        for (long n = 1; n <= kWrites; ++n) {
            SCOPED_TRACE(kind + std::to_string(n));
            expectNoRoom(runWith(kind + failing("write", n, ENOSPC)), ENOSPC);
        }
    }
    const Result whole = runWith("");
    EXPECT_EQ(whole.exitCode, 0) << whole.err;
    EXPECT_FALSE(isOld("t.vdb"));
}

TEST_F(CommandSpool, AWriteOfAPartGoesOnWithTheRest) { expectWholeInput(halved(2)); }

TEST_F(CommandSpool, AWriteThatASignalInterruptsIsMadeAgain)
{
    expectWholeInput(failingOnce("write", 2, EINTR));
}

TEST_F(CommandSpool, ALimitOnTheSizeOfFilesIsAnErrorThatLeavesNothing)
{
    const Result result = start(split(kLine), mInput, [] {
        const rlimit small = {3 << 19, 3 << 19};
        setrlimit(RLIMIT_FSIZE, &small);
    }).wait();
    expectNoRoom(result, EFBIG);
}

TEST_F(CommandSpool, AFolderWithoutRoomForAFileIsAnError)
{
    std::filesystem::remove(mTemporary->path());
    const Result result = runWith("");
    expectFailure(result, 4,
        {"no temporary file can be made in " + mTemporary->path() + ": No such file"}, {"t.vdb"});
}

TEST_F(CommandSpool, AKillLeavesNothing)
{
    for (const std::string& kind : kindsOfFiles()) {
        for (long n = 1; n <= kWrites; ++n) {
            EXPECT_EQ(runWith(kind + signalled("write", n, SIGKILL)).signal, SIGKILL);
            EXPECT_EQ(mTemporary->files(), 0) << kind << n;
        }
    }
}

TEST_F(CommandSpool, TheFileHasNoNameThatAKillCouldLeave)
{
    if (!hasNamelessFiles()) GTEST_SKIP() << "no O_TMPFILE in " << mTemporary->path();
    const Result result = runWith(signalled("unlink", 1, SIGKILL));
    EXPECT_EQ(result.signal, 0) << "a name was to be removed";
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(mTemporary->files(), 0);
}

} // namespace
