// SPDX-License-Identifier: Apache-2.0
/// @file TestChildProcess.cc
/// @brief What work in a child process returns, throws, and cannot do to this one.

#include <openvdb_spheretree/base/ChildProcess.h>

#include <openvdb_spheretree/base/Interrupted.h>

#include "support/Messages.h"
#include "support/Sanitizers.h"

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using namespace openvdb_spheretree::detail;
using openvdb_spheretree::Interrupted;
using spheretree_test::mentions;
using spheretree_test::messageOf;

constexpr uint64_t kMemory = uint64_t(64) << 20;
constexpr ChildLimits kLimits = {kMemory, /*seconds=*/60};

std::string whyNot(const std::function<std::string()>& work, const ChildLimits& limits = kLimits)
{
    return messageOf<openvdb::IoError>([&] { resultOfChild(work, limits); });
}

/// Work that takes so much processor time.
std::function<std::string()> working(double seconds)
{
    return [seconds] {
        while (double(std::clock()) < seconds * CLOCKS_PER_SEC) {} // of the child
        return std::string("x");
    };
}

TEST(ChildProcess, ReturnsWhatItsWorkReturns)
{
    EXPECT_EQ(resultOfChild([] { return std::string(); }, kLimits), "");
    const std::string large(10000000, 'x'); // more than a pipe holds
    EXPECT_EQ(resultOfChild([&] { return large + '\0' + "y"; }, kLimits), large + '\0' + "y");
}

TEST(ChildProcess, ChangesNothingHere)
{
    int number = 1;
    resultOfChild([&] { return std::string(size_t(number = 2), 'x'); }, kLimits);
    EXPECT_EQ(number, 1);
}

TEST(ChildProcess, ThrowsWhatItsWorkThrows)
{
    EXPECT_EQ(whyNot([]() -> std::string { throw openvdb::IoError("no such thing"); }),
        "IoError: no such thing");
    EXPECT_THROW(
        resultOfChild([]() -> std::string { throw std::bad_alloc(); }, kLimits), std::bad_alloc);
}

TEST(ChildProcess, ItsEndIsAnError)
{
    for (const int signal : {SIGSEGV, SIGABRT, SIGKILL}) {
        EXPECT_TRUE(mentions(whyNot([signal]() -> std::string {
            raise(signal);
            return "x";
        }),
            "crashed"))
            << signal;
    }
    EXPECT_TRUE(mentions(whyNot([]() -> std::string { _exit(3); }), "crashed"));
}

TEST(ChildProcess, HasSoMuchMemoryMoreAndNoMore)
{
    if (spheretree_test::kSanitized) GTEST_SKIP() << "its allocator ends the process";
    const auto take = [](uint64_t bytes) {
        return [bytes] { return std::string(bytes, 'x').substr(0, 1); };
    };
    EXPECT_EQ(resultOfChild(take(kMemory / 4), kLimits), "x");
    EXPECT_THROW(resultOfChild(take(2 * kMemory), kLimits), std::bad_alloc);
    const auto takeMore = [&] {
        allowMore({4 * kMemory, 0});
        return take(2 * kMemory)();
    };
    EXPECT_EQ(resultOfChild(takeMore, kLimits), "x");
}

/// They may say that it is this process which ends, and remove what it would leave.
TEST(ChildProcess, HandlersOfThisProcessAreNotItsOwn)
{
    if (spheretree_test::kSanitized) GTEST_SKIP() << "its allocator ends the process";
    const auto end = [] { _exit(0); };
    const auto newHandler = std::set_new_handler(end);
    const auto terminate = std::set_terminate(end);
    const auto takeTooMuch = [] { return std::string(2 * kMemory, 'x').substr(0, 1); };
    EXPECT_THROW(resultOfChild(takeTooMuch, kLimits), std::bad_alloc);
    EXPECT_TRUE(mentions(whyNot([]() -> std::string { std::terminate(); }), strsignal(SIGABRT)));
    std::set_new_handler(newHandler);
    std::set_terminate(terminate);
}

TEST(ChildProcess, WithoutAnEndIsStopped)
{
    const ChildLimits second = {kMemory, 1};
    const auto before = std::signal(SIGXCPU, SIG_IGN); // of this process, not of the child
    const std::string why = whyNot(working(20), second);
    std::signal(SIGXCPU, before);
    EXPECT_TRUE(mentions(why, "damaged"));
    EXPECT_TRUE(mentions(why, "its reader does not end"));
    EXPECT_EQ(resultOfChild(working(0.1), second), "x");
    const auto workMore = [] {
        allowMore({0, 2});
        return working(1.5)();
    };
    EXPECT_EQ(resultOfChild(workMore, second), "x");
}

/// ulimit -t
TEST(ChildProcess, WithoutAnEndBelowAHardLimitIsStopped)
{
    const auto sayWhy = [] {
        const rlimit hard = {2, 2};
        setrlimit(RLIMIT_CPU, &hard);
        _exit(mentions(whyNot(working(20)), "its reader does not end") ? 0 : 1);
    };
    EXPECT_EXIT(sayWhy(), testing::ExitedWithCode(0), ""); // in a process of its own
}

TEST(ChildProcess, HasNoLimitWhereNoneIsGiven)
{
    EXPECT_EQ(resultOfChild(working(1.5), {kMemory, 0}), "x");
    const auto take = [] { return std::string(2 * kMemory, 'x').substr(0, 1); };
    EXPECT_EQ(resultOfChild(take, {0, 60}), "x");
}

/// A terminal sends Ctrl-C to both; what it means to this process is its own affair.
TEST(ChildProcess, IsNotEndedBySignalsThatAskForAnEnd)
{
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
        const auto raiseIt = [signal] {
            raise(signal);
            return std::string("x");
        };
        EXPECT_EQ(resultOfChild(raiseIt, kLimits), "x") << signal;
    }
}

/// Says yes to "interrupted?" from the @a after-th question on.
class StopAfter : public openvdb::util::NullInterrupter {
public:
    explicit StopAfter(int after) : mLeft(after) {}
    bool wasInterrupted(int = -1) override { return mLeft-- <= 0; }

private:
    int mLeft;
};

TEST(ChildProcess, IsStoppedByAnInterrupter)
{
    const auto wait = [] {
        sleep(20);
        return std::string();
    };
    const auto writeMuch = [] { return std::string(kMemory / 4, 'x'); };
    for (const int after : {0, 1, 5}) {
        StopAfter whileWaiting(after), whileReading(after);
        EXPECT_THROW(resultOfChild(wait, kLimits, &whileWaiting), Interrupted);
        EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "the child is still there";
        EXPECT_THROW(resultOfChild(writeMuch, kLimits, &whileReading), Interrupted);
    }
    StopAfter never(1 << 30);
    EXPECT_EQ(resultOfChild(writeMuch, kLimits, &never).size(), kMemory / 4);
}

TEST(ChildProcess, ThatIsEndedWithThisProcessIsNoDamage)
{
    const auto end = []() -> std::string {
        raise(SIGKILL);
        return "x";
    };
    StopAfter afterwards(1);
    EXPECT_THROW(resultOfChild(end, kLimits, &afterwards), Interrupted);
    StopAfter never(1 << 30);
    EXPECT_TRUE(mentions(
        messageOf<openvdb::IoError>([&] { resultOfChild(end, kLimits, &never); }), "crashed"));
}

TEST(ChildProcess, WorksFromManyThreads)
{
    std::vector<std::thread> threads;
    std::vector<std::string> results(8);
    for (std::string& result : results) {
        threads.emplace_back([&result] {
            for (int i = 0; i < 20; ++i) {
                result += resultOfChild([i] { return std::to_string(i % 10); }, kLimits);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::string& result : results) EXPECT_EQ(result, "01234567890123456789");
}

} // namespace
