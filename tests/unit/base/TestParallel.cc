// SPDX-License-Identifier: Apache-2.0
/// @file TestParallel.cc
/// @brief Loops do every body once, and ask their interrupter often enough; so do sorts.

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/ParallelSort.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <random>
#include <thread>
#include <vector>

namespace {

using namespace openvdb_spheretree;

/// Counts questions, and says yes from the @a after-th on.
class Asked : public openvdb::util::NullInterrupter {
public:
    explicit Asked(int after) : mAfter(after) {}
    bool wasInterrupted(int = -1) override { return mCount++ >= mAfter; }
    int count() const { return mCount; }

private:
    int mAfter;
    std::atomic<int> mCount{0};
};

constexpr int kNever = 1 << 30;
constexpr auto kLong = std::chrono::milliseconds(25); // more than a loop goes without asking

TEST(Parallel, ARangeCallsEveryBodyOnceInOrder)
{
    for (const std::size_t size : {0, 1, 2, 63, 64, 65, 127, 128, 1000}) {
        Asked never(kNever);
        detail::LoopProgress progress(size, &never);
        std::vector<std::size_t> called;
        detail::runRange(7, 7 + size, progress, [&](std::size_t i) { called.push_back(i); });
        ASSERT_EQ(called.size(), size);
        for (std::size_t i = 0; i < size; ++i) EXPECT_EQ(called[i], 7 + i);
    }
}

TEST(Parallel, ARangeOfLongBodiesAsksAfterEveryOne)
{
    Asked never(kNever);
    detail::LoopProgress progress(6, &never);
    const auto wait = [](std::size_t) { std::this_thread::sleep_for(kLong); };
    detail::runRange(0, 1, progress, wait);
    detail::runRange(0, 1, progress, wait);
    EXPECT_EQ(never.count(), 2); // before each range
    detail::runRange(0, 4, progress, wait);
    EXPECT_GE(never.count(), 2 + 3); // the second and third body may go together
}

TEST(Parallel, ARangeStopsInItsMiddle)
{
    Asked second(1);
    detail::LoopProgress progress(100, &second);
    int called = 0;
    const auto wait = [&](std::size_t) {
        ++called;
        std::this_thread::sleep_for(kLong);
    };
    EXPECT_THROW(detail::runRange(0, 100, progress, wait), Interrupted);
    EXPECT_EQ(called, 1);
}

TEST(Parallel, ASortAsksAndStops)
{
    std::mt19937 random(1);
    std::vector<uint32_t> values(1000000);
    for (uint32_t& value : values) value = random() % 1000;
    const std::vector<uint32_t> given = values;
    std::vector<uint32_t> sorted = given;
    std::sort(sorted.begin(), sorted.end());

    detail::parallelSort(values.begin(), values.end(), nullptr);
    EXPECT_EQ(values, sorted);
    Asked never(kNever);
    values = given;
    detail::parallelSort(values.begin(), values.end(), &never, std::greater<>());
    EXPECT_TRUE(std::equal(values.begin(), values.end(), sorted.rbegin()));
    EXPECT_GT(never.count(), 20);
    Asked tenth(9);
    values = given;
    EXPECT_THROW(detail::parallelSort(values.begin(), values.end(), &tenth), Interrupted);
}

} // namespace
