// SPDX-License-Identifier: Apache-2.0
// Memory and threads that are not to be had: an exit code and a sentence, whenever it happens, and
// no file touched.

#include "FaultyCommand.h"

#include <cerrno>

#include <sys/resource.h>

namespace {

using namespace command_test;

const std::string kWork = "-threads 4 -generate ball voxels=20000 -spheretree "
                          "-write t.vdb t.csv t.png width=64 height=48";

class CommandScarce : public FaultyCommandTest {
protected:
    void SetUp() override
    {
        FaultyCommandTest::SetUp();
        if (!IsSkipped()) writeOld({"t.csv", "t.png", "t.vdb"});
    }

    /// Either all was done, or nothing was and the message says what is missing.
    bool expectAllOrNothing(const Result& result, const std::string& missing)
    {
        const bool done = result.exitCode == 0;
        EXPECT_TRUE(done || result.exitCode == 3 || result.exitCode == 4)
            << result.exitCode << ", signal " << result.signal << "\n"
            << result.err;
        for (const std::string name : {"t.csv", "t.png", "t.vdb"}) EXPECT_NE(isOld(name), done);
        EXPECT_EQ(files(), mBefore);
        EXPECT_TRUE(done || result.err.find(missing) != std::string::npos) << result.err;
        writeOld({"t.csv", "t.png", "t.vdb"});
        return done;
    }
};

TEST_F(CommandScarce, AnyRequestForMemoryMayFail)
{
    const long requests = callsOf(kWork)["malloc"];
    writeOld({"t.csv", "t.png", "t.vdb"});
    for (const long n : spread(requests, 80)) {
        SCOPED_TRACE(n);
        expectAllOrNothing(runWith(kWork, failingOnce("malloc", n, ENOMEM)), "memory");
    }
}

TEST_F(CommandScarce, LimitsOnMemoryInSteps)
{
    const std::string line = "-threads 2 -generate ball voxels=2000000 -spheretree quality=fast "
                             "spheres=64 errors=0 -write t.vdb t.csv t.png width=64 height=48";
    int refused = 0, done = 0;
    for (rlim_t megabytes = 150; megabytes <= 450; megabytes += 20) {
        SCOPED_TRACE(megabytes);
        const Result result = start(split(line), "/dev/null", [=] {
            const rlimit limit = {megabytes << 20, megabytes << 20};
            setrlimit(RLIMIT_AS, &limit);
        }).wait();
        (expectAllOrNothing(result, "memory") ? done : refused) += 1;
    }
    EXPECT_GT(refused, 0);
    EXPECT_GT(done, 0);
}

TEST_F(CommandScarce, NoThreadIsAnErrorOfItsOwn)
{
    int refused = 0;
    const long threads = callsOf(kWork)["thread"];
    writeOld({"t.csv", "t.png", "t.vdb"});
    for (long n = 1; n <= threads; ++n) {
        SCOPED_TRACE(n);
        const Result result = runWith(kWork, failing("thread", n, EAGAIN));
        if (expectAllOrNothing(result, "no thread can be started")) continue;
        EXPECT_EQ(result.exitCode, 3) << result.err;
        ++refused;
    }
    EXPECT_GT(refused, 1);
}

TEST_F(CommandScarce, NoThreadIsSaidByEachActionThatNeedsOne)
{
    const long beforeWork = callsOf("-version")["thread"];
    writeOld({"t.vdb"});
    for (const std::string line : {"-generate ball voxels=50000", "-read a.vol -spheretree",
             "-read tree.vdb -spheres2ls voxel=0.1", "-read tree.vdb -write t.png"}) {
        const Result result =
            runWith("-threads 4 " + line, failing("thread", beforeWork + 1, EAGAIN));
        expectFailure(result, 3, {"no thread can be started"}, {});
        const std::string alone = "-threads 1 " + line;
        EXPECT_EQ(runWith(alone, failing("thread", beforeWork + 1, EAGAIN)).exitCode, 0)
            << "the message promises that";
        std::filesystem::remove(path("t.png"));
    }
}

TEST_F(CommandScarce, NoThreadBeforeTheProgramBegins)
{
    expectFailure(runWith("-version", failing("thread", 1, EAGAIN)), 3,
        {"vdb_spheretree: error: no thread can be started"}, {});
}

} // namespace
