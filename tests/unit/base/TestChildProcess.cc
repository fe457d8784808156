// SPDX-License-Identifier: Apache-2.0
/// @file TestChildProcess.cc
/// @brief What work in a child process returns, throws, and cannot do to this one.

#include <openvdb_spheretree/base/ChildProcess.h>

#include "support/Messages.h"
#include "support/Sanitizers.h"

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>

#include <csignal>
#include <cstdlib>
#include <new>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

namespace {

using namespace openvdb_spheretree::detail;
using spheretree_test::mentions;
using spheretree_test::messageOf;

constexpr uint64_t kMemory = uint64_t(64) << 20;

std::string whyNot(const std::function<std::string()>& work)
{
    return messageOf<openvdb::IoError>([&] { resultOfChild(work, kMemory); });
}

TEST(ChildProcess, ReturnsWhatItsWorkReturns)
{
    EXPECT_EQ(resultOfChild([] { return std::string(); }, kMemory), "");
    const std::string large(10000000, 'x'); // more than a pipe holds
    EXPECT_EQ(resultOfChild([&] { return large + '\0' + "y"; }, kMemory), large + '\0' + "y");
}

TEST(ChildProcess, ChangesNothingHere)
{
    int number = 1;
    resultOfChild([&] { return std::string(size_t(number = 2), 'x'); }, kMemory);
    EXPECT_EQ(number, 1);
}

TEST(ChildProcess, ThrowsWhatItsWorkThrows)
{
    EXPECT_EQ(whyNot([]() -> std::string { throw openvdb::IoError("no such thing"); }),
        "IoError: no such thing");
    EXPECT_THROW(
        resultOfChild([]() -> std::string { throw std::bad_alloc(); }, kMemory), std::bad_alloc);
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
    EXPECT_EQ(resultOfChild(take(kMemory / 4), kMemory), "x");
    EXPECT_THROW(resultOfChild(take(2 * kMemory), kMemory), std::bad_alloc);
    const auto takeMore = [&] {
        allowMoreMemory(4 * kMemory);
        return take(2 * kMemory)();
    };
    EXPECT_EQ(resultOfChild(takeMore, kMemory), "x");
}

TEST(ChildProcess, WorksFromManyThreads)
{
    std::vector<std::thread> threads;
    std::vector<std::string> results(8);
    for (std::string& result : results) {
        threads.emplace_back([&result] {
            for (int i = 0; i < 20; ++i) {
                result += resultOfChild([i] { return std::to_string(i % 10); }, kMemory);
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::string& result : results) EXPECT_EQ(result, "01234567890123456789");
}

} // namespace
