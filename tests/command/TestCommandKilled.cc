// SPDX-License-Identifier: Apache-2.0
// Signals at moments spread over a whole run, and between the renames of several targets: a request
// to stop leaves nothing; a kill leaves one file at most, which the next run removes. And several
// runs that write one file.

#include "FaultyCommand.h"

#include "support/Sanitizers.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <string>
#include <thread>

#include <sys/wait.h>

namespace {

using namespace command_test;

const std::string kWork = "-threads 1 -read a.vol -spheretree tree=extended dag=1 ";
const std::string kTight = "-threads 1 -read a.vol -spheretree quality=fast spheres=8,2 ";
const std::string kMesh = "-threads 1 -read b.obj -mesh2ls dim=12 cover=1 -spheretree "
                          "quality=fast spheres=4 ";
const std::string kWrite = "-write t.vdb t.json t.png width=64 height=48";
const std::vector<std::string> kTargets = {"t.json", "t.png", "t.vdb"};

class CommandKilled : public FaultyCommandTest {
protected:
    void SetUp() override
    {
        FaultyCommandTest::SetUp();
        if (IsSkipped()) return;
        writeText(path("b.obj"),
            "v 0 0 0\nv 8 0 0\nv 0 8 0\nv 0 0 8\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
        expectOf(kWork);
    }

    /// Notes what targets are when a run is done.
    void expectOf(const std::string& work)
    {
        ASSERT_EQ(run(work + kWrite).exitCode, 0);
        for (const std::string& name : kTargets) mWhole[name] = readText(path(name));
        writeOld(kTargets);
    }

    /// @return how many targets are not the old ones; each of them has to be whole.
    long newTargets() const
    {
        return std::count_if(kTargets.begin(), kTargets.end(), [this](const std::string& name) {
            if (isOld(name)) return false;
            EXPECT_TRUE(readText(path(name)) == mWhole.at(name)) << name << " is not whole";
            return true;
        });
    }

    void expectOldOrWhole() const { newTargets(); }

    void expectWhole(const std::string& name) const
    {
        EXPECT_EQ(run("-read " + name + " -print").exitCode, 0) << name << " is not whole";
    }

private:
    std::map<std::string, std::string> mWhole; ///< the targets as a run leaves them
};

struct SignalledWork {
    const char* name;
    int signal;
    std::string work;
};

void PrintTo(const SignalledWork& work, std::ostream* out) { *out << work.name; }

class CommandSignalled : public CommandKilled, public testing::WithParamInterface<SignalledWork> {};

/// Memory is asked for in every part of a run, so requests count moments better than a clock does.
TEST_P(CommandSignalled, AtThirtyMoments)
{
    if (spheretree_test::kSanitized) GTEST_SKIP() << "sanitizers have a malloc of their own";
    const int signal = GetParam().signal;
    const std::string line = GetParam().work + kWrite;
    expectOf(GetParam().work);
    const long beforeWork = callsOf("-version")["malloc"];
    // The number differs from run to run, the more the busier the machine, so the last moment is some before the end.
    const long fewest =
        std::min({callsOf(line)["malloc"], callsOf(line)["malloc"], callsOf(line)["malloc"]});
    const long work = fewest * 95 / 100 - beforeWork;
    ASSERT_GT(work, 1000);
    int stopped = 0;
    for (const long moment : spread(work, 30)) {
        SCOPED_TRACE(moment);
        writeOld(kTargets);
        const Result result = runWith(line, signalled("malloc", beforeWork + moment, signal));
        if (signal == SIGKILL) {
            EXPECT_EQ(result.signal, SIGKILL);
            expectOldOrWhole();
            EXPECT_LE(leftovers().size(), 1u);
            for (const std::string& name : leftovers()) std::filesystem::remove(path(name));
        } else {
            // After the last look for a signal the run has done its work.
            EXPECT_EQ(result.exitCode, newTargets() == 3 ? 0 : 5) << result.err;
            EXPECT_TRUE(newTargets() == 0 || newTargets() == 3);
            stopped += result.exitCode == 5;
        }
        EXPECT_EQ(files(), mBefore);
    }
    EXPECT_TRUE(signal == SIGKILL || stopped >= 25) << stopped;
}

INSTANTIATE_TEST_SUITE_P(Signals, CommandSignalled,
    testing::Values(SignalledWork{"INT", SIGINT, kWork}, SignalledWork{"TERM", SIGTERM, kWork},
        SignalledWork{"HUP", SIGHUP, kWork}, SignalledWork{"KILL", SIGKILL, kWork},
        SignalledWork{"TightTERM", SIGTERM, kTight}, SignalledWork{"TightKILL", SIGKILL, kTight},
        SignalledWork{"MeshTERM", SIGTERM, kMesh}, SignalledWork{"MeshKILL", SIGKILL, kMesh}),
    [](const auto& info) { return std::string(info.param.name); });

TEST_F(CommandKilled, AStopBeforeTheFirstRenameLeavesAllFilesAndALaterOneNone)
{
    for (long k = 1; k <= 3; ++k) {
        writeOld(kTargets);
        const Result stopped = runWith(kWork + kWrite, signalled("fsync", k, SIGINT));
        expectFailure(stopped, 5, {"interrupted"}, kTargets);
        const Result late = runWith(kWork + kWrite, signalled("rename", k, SIGINT));
        EXPECT_EQ(late.exitCode, 0) << late.err;
        EXPECT_EQ(newTargets(), 3) << "some are new and some are old";
        writeOld(kTargets);
        const Result before = runWith(kWork + kWrite + " -print", signalled("rename", k, SIGINT));
        EXPECT_EQ(before.exitCode, 5) << "the next action does not begin";
        EXPECT_EQ(newTargets(), 3);
        EXPECT_EQ(files(), mBefore);
    }
}

TEST_F(CommandKilled, ARenameThatFailsSaysWhichFilesAreNew)
{
    const Result result = runWith(kWork + kWrite, failing("rename", 2, EIO));
    EXPECT_EQ(result.exitCode, 4);
    EXPECT_NE(
        result.err.find("written: t.vdb; not written: cannot write t.json"), std::string::npos)
        << result.err;
    EXPECT_FALSE(isOld("t.vdb"));
    EXPECT_TRUE(isOld("t.json") && isOld("t.png"));
    EXPECT_EQ(files(), mBefore);
}

TEST_F(CommandKilled, BetweenRenamesLeavesOneFileWhichTheNextRunRemoves)
{
    for (long k = 1; k <= 3; ++k) {
        SCOPED_TRACE(k);
        writeOld(kTargets);
        EXPECT_EQ(runWith(kWork + kWrite, signalled("link", k, SIGKILL)).signal, SIGKILL);
        EXPECT_EQ(files(), mBefore) << "a file without a name is none";
        EXPECT_EQ(newTargets(), k - 1);
        writeOld(kTargets);
        EXPECT_EQ(runWith(kWork + kWrite, signalled("rename", k, SIGKILL)).signal, SIGKILL);
        EXPECT_EQ(newTargets(), k - 1);
        ASSERT_EQ(leftovers().size(), 1u);
        const std::string target =
            std::vector<std::string>{"t.vdb", "t.json", "t.png"}[size_t(k - 1)];
        EXPECT_EQ(leftovers()[0].rfind("." + target + ".vdb_spheretree-tmp.", 0), 0u);
        EXPECT_EQ(run("-read a.vol -spheretree -write other.vdb").exitCode, 0);
        EXPECT_EQ(leftovers().size(), 1u) << "it belongs to another target";
        std::filesystem::remove(path("other.vdb"));
        EXPECT_EQ(run(kWork + kWrite).exitCode, 0);
        EXPECT_EQ(files(), mBefore);
        EXPECT_EQ(newTargets(), 3);
    }
}

TEST_F(CommandKilled, NamedFilesAreRemovedByTheNextRunToo)
{
    for (const std::string call : {"write", "fsync", "rename"}) {
        writeOld(kTargets);
        const Result result =
            runWith(kWork + kWrite, namedFilesOnly() + ";" + signalled(call, 1, SIGKILL));
        EXPECT_EQ(result.signal, SIGKILL);
        EXPECT_FALSE(leftovers().empty());
        EXPECT_LE(leftovers().size(), 3u) << "one a target";
        EXPECT_EQ(newTargets(), 0);
        EXPECT_EQ(runWith(kWork + kWrite, namedFilesOnly()).exitCode, 0);
        EXPECT_EQ(files(), mBefore);
    }
}

TEST_F(CommandKilled, NamesOfAnyLengthHaveATemporaryFile)
{
    std::string letters = "x";
    for (int i = 0; i < 124; ++i) letters += "\xc3\xa9"; // e with an accent; cut between two
    const std::string line = "-read tree.vdb -write " + letters + ".vdb";
    EXPECT_EQ(runWith(line, signalled("rename", 1, SIGKILL)).signal, SIGKILL);
    ASSERT_EQ(leftovers().size(), 1u);
    EXPECT_EQ(leftovers()[0].substr(0, 201), "." + letters.substr(0, 199) + ".");
    EXPECT_EQ(run(line).exitCode, 0);
    EXPECT_EQ(leftovers().size(), 0u);
}

/// Whatever the program is at, a second is what it gets.
TEST_F(CommandKilled, WhatHangsIsLeftBehindASecondAfterARequestToStop)
{
    writeOld(kTargets);
    for (const std::string& kind : {std::string(), namedFilesOnly() + ";"}) {
        for (const std::string call : {"read", "fsync"}) {
            SCOPED_TRACE(kind + call);
            const auto start = std::chrono::steady_clock::now();
            const Result result = runWith(
                kWork + kWrite, kind + signalled(call, 1, SIGTERM) + ";" + hanging(call, 1, 60));
            EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
            expectFailure(result, 5, {"vdb_spheretree: interrupted"}, kTargets);
        }
    }
}

/// @return whether a process has a handler for SIGTERM already; before, a signal is its end.
bool handlesTermination(pid_t process)
{
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);) {
        if (line.rfind("SigCgt:", 0) != 0) continue;
        return (std::stoull(line.substr(7), nullptr, 16) >> (SIGTERM - 1) & 1) != 0;
    }
    return false;
}

/// The second signal would start the second anew.
TEST_F(CommandKilled, MoreRequestsDoNotPutTheEndOff)
{
    writeOld(kTargets);
    const auto start = std::chrono::steady_clock::now();
    Running running =
        startWith(kWork + kWrite, signalled("fsync", 1, SIGTERM) + ";" + hanging("fsync", 1, 60));
    const auto patience = std::chrono::seconds(20);
    siginfo_t ended{};
    while (ended.si_pid == 0 && std::chrono::steady_clock::now() - start < patience) {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        if (handlesTermination(running.process())) running.send(SIGTERM);
        waitid(P_PID, id_t(running.process()), &ended, WEXITED | WNOHANG | WNOWAIT);
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, patience);
    expectFailure(running.wait(), 5, {"vdb_spheretree: interrupted"}, kTargets);
}

TEST_F(CommandKilled, FilesThatTakeTheirPlacesHaveTheTimeThatTheyNeed)
{
    writeOld(kTargets);
    const Result result =
        runWith(kWork + kWrite, signalled("rename", 2, SIGTERM) + ";" + hanging("rename", 2, 3));
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(newTargets(), 3);
    EXPECT_EQ(files(), mBefore);
}

class CommandTwoWriters : public CommandKilled, public testing::WithParamInterface<bool> {};

/// The first stands still with its file complete, while the second runs from start to end.
TEST_P(CommandTwoWriters, EachTakesItsTurnAndTheLastOneStays)
{
    const std::string kind = GetParam() ? namedFilesOnly() + ";" : "";
    const std::string first = "-read tree.vdb -write t.vdb", second = "-read a.vol -write t.vdb";
    ASSERT_EQ(run("-read tree.vdb -write expected.vdb").exitCode, 0);
    const std::string expected = readText(path("expected.vdb"));
    writeOld({});
    for (const char* call : {"write", "fsync", "rename"}) {
        SCOPED_TRACE(call);
        Running slow = startWith(first, kind + signalled(call, 1, SIGSTOP));
        ASSERT_TRUE(slow.waitUntilStopped());
        const auto ofSlow = leftovers();
        EXPECT_EQ(ofSlow.empty(), !GetParam() && std::string(call) != "rename");
        EXPECT_EQ(runWith(second, kind).exitCode, 0);
        EXPECT_EQ(leftovers(), ofSlow) << "a living writer's file was removed";
        EXPECT_EQ(readGrids("t.vdb").size(), 1u);
        EXPECT_NE(readText(path("t.vdb")), expected);
        slow.send(SIGCONT);
        EXPECT_EQ(slow.wait().exitCode, 0);
        EXPECT_EQ(readText(path("t.vdb")), expected);
        EXPECT_EQ(files(), mBefore);
    }
}

INSTANTIATE_TEST_SUITE_P(Files, CommandTwoWriters, testing::Bool(),
    [](const auto& info) { return info.param ? "Named" : "Nameless"; });

TEST_F(CommandKilled, SixWritersOfOneFileAtOnceLeaveAWholeOne)
{
    const Result result =
        shell("for i in 1 2 3 4 5 6; do "
              "$VDB_SPHERETREE -read tree.vdb -write t.vdb || echo failed & done; "
              "wait");
    EXPECT_EQ(result.out, "") << result.err;
    expectWhole("t.vdb");
    EXPECT_TRUE(leftovers().empty());
}

} // namespace
