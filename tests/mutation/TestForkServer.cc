// SPDX-License-Identifier: Apache-2.0
/// @file TestForkServer.cc
/// @brief The fork server itself: whatever an input does to its process is found, by its number, and
/// the others are tried all the same.

#include "ForkServer.h"
#include "inputs/MemoryLimit.h"
#include "support/Sanitizers.h"

#include <gtest/gtest.h>

#include <csignal>
#include <new>
#include <stdexcept>
#include <vector>

#include <unistd.h>

namespace {

using namespace spheretree_test;

ForkedRun tryAll(int64_t count, bool (*tryInput)(int64_t), const ForkLimits& limits = {})
{
    return runForked(
        count, [=] { return std::function<bool(int64_t)>(tryInput); }, limits);
}

TEST(ForkServer, CountsWhatIsReadAndWhatIsRefused)
{
    const ForkedRun run = tryAll(101, [](int64_t n) { return n % 4 == 0; });
    EXPECT_EQ(run.read, 26);
    EXPECT_EQ(run.refused, 75);
    EXPECT_TRUE(run.findings.empty());
}

TEST(ForkServer, NamesTheInputOfEveryEnd)
{
    if (spheretree_test::kSanitized) GTEST_SKIP() << "sanitizers have handlers of these signals";
    ForkLimits limits;
    limits.seconds = 1;
    const ForkedRun run = tryAll(
        40,
        [](int64_t n) {
            if (n == 3) raise(SIGSEGV);
            if (n == 4) abort();
            if (n == 12) _exit(0);
            if (n == 17) throw std::logic_error("is wrong");
            if (n == 38) pause();
            return true;
        },
        limits);
    ASSERT_EQ(run.findings.size(), 5u);
    EXPECT_EQ(run.read, 35);
    const std::vector<Finding> expected = {{3, "died: Segmentation fault"}, {4, "died: Aborted"},
        {12, "ended its process"}, {17, "threw: is wrong"}, {38, "no end after 1 s"}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(run.findings[i].input, expected[i].input);
        EXPECT_EQ(run.findings[i].what, expected[i].what);
    }
}

TEST(ForkServer, FindsARequestForTooMuchMemoryEvenIfItIsHandled)
{
    if (spheretree_test::kSanitized) GTEST_SKIP() << "memory is not limited under sanitizers";
    const auto greedy = [](int64_t n) {
        if (n != 5) return true;
        try {
            // A call by name: a compiler may leave out a new-expression that nobody needs.
            ::operator delete(::operator new(std::size_t(3) << 30));
        } catch (const std::bad_alloc&) { // as readers do
        }
        return false;
    };
    const ForkedRun run = tryAll(8, greedy);
    ASSERT_EQ(run.findings.size(), 1u);
    EXPECT_EQ(run.findings[0].input, 5);
}

/// A part of the work may have less than all of it.
TEST(ForkServer, FindsWhatTakesMoreThanItsPartMay)
{
    if (spheretree_test::kSanitized) GTEST_SKIP() << "memory is not limited under sanitizers";
    const auto greedy = [](int64_t n) {
        constexpr uint64_t kMebibyte = uint64_t(1) << 20;
        {
            const MemoryLimit part(bytesOfAddresses() + 64 * kMebibyte);
            ::operator delete(::operator new((n == 2 ? 80 : 40) * kMebibyte));
        }
        ::operator delete(::operator new(80 * kMebibyte));
        return true;
    };
    const ForkedRun run = tryAll(6, greedy);
    EXPECT_EQ(run.read, 5);
    ASSERT_EQ(run.findings.size(), 1u);
    EXPECT_EQ(run.findings[0].input, 2);
    EXPECT_EQ(run.findings[0].what, "asked for more memory than it may");
}

} // namespace
