// SPDX-License-Identifier: Apache-2.0
/// @file TestInterruptSteps.cc
/// @brief Short steps ask an interrupter now and then, and long ones at once.

#include <openvdb_spheretree/base/InterruptSteps.h>

#include <gtest/gtest.h>

#include <cstddef>

namespace {

using namespace openvdb_spheretree;

/// Counts questions, and says yes if told so.
class Asked : public openvdb::util::NullInterrupter {
public:
    bool wasInterrupted(int = -1) override
    {
        ++count;
        return says;
    }
    int count = 0;
    bool says = false;
};

TEST(InterruptSteps, AskNowAndThen)
{
    Asked asked;
    detail::InterruptSteps steps(&asked);
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i) steps.add();
    EXPECT_GE(asked.count, 10);
    EXPECT_LE(asked.count, kSteps / 1000);
    const int before = asked.count;
    steps.add(std::size_t(1) << 40);
    EXPECT_EQ(asked.count, before + 1);
    asked.says = true;
    EXPECT_NO_THROW(steps.add());
    EXPECT_THROW(steps.add(kSteps), Interrupted);
}

TEST(InterruptSteps, NeedNobodyToAsk)
{
    detail::InterruptSteps steps(nullptr);
    EXPECT_NO_THROW(steps.add(std::size_t(1) << 40));
}

} // namespace
