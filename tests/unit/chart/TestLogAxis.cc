// SPDX-License-Identifier: Apache-2.0

#include <openvdb_spheretree/chart/LogAxis.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using openvdb_spheretree::detail::LogAxis;

std::string labels(double low, double high)
{
    std::string text;
    for (const LogAxis::Tick& tick : LogAxis(low, high).ticks()) {
        text += (text.empty() ? "" : " ") + tick.label;
    }
    return text;
}

TEST(LogAxis, EndsAreTheNextEvenNumbers)
{
    EXPECT_EQ(labels(1, 4), "1 2 5");
    EXPECT_EQ(labels(2, 4), "2 5");
    EXPECT_EQ(labels(1.5, 20), "1 2 5 10 20");
    EXPECT_EQ(labels(0.021, 0.4), "0.02 0.05 0.1 0.2 0.5");
    EXPECT_EQ(labels(8, 8), "5 10");
    EXPECT_EQ(labels(10, 10), "10 20");
}

TEST(LogAxis, LongAxesHavePowersOfTenAlone)
{
    EXPECT_EQ(labels(1, 138157), "1 10 100 1,000 10,000 100,000");
    EXPECT_EQ(labels(3, 5000), "10 100 1,000");
    EXPECT_EQ(labels(0.003, 60), "0.01 0.1 1 10 100");
    EXPECT_EQ(labels(1e-9, 1e12), "1e-9 1e-6 0.001 1 1,000 1,000,000 1e9 1e12");
}

TEST(LogAxis, TicksAreFewAndOnTheAxisWhateverItsEnds)
{
    for (double low = 1e-12; low < 1e12; low *= 3.7) {
        for (double ratio = 1; ratio < 1e15; ratio *= 2.9) {
            const LogAxis axis(low, low * ratio);
            const auto ticks = axis.ticks();
            ASSERT_GE(ticks.size(), 2u) << low << " " << ratio;
            ASSERT_LE(ticks.size(), 9u) << low << " " << ratio;
            for (const LogAxis::Tick& tick : ticks) {
                ASSERT_GE(axis.at(tick.value), -1e-12) << low << " " << ratio;
                ASSERT_LE(axis.at(tick.value), 1 + 1e-12) << low << " " << ratio;
            }
            ASSERT_GE(axis.at(low), -1e-12);
            ASSERT_LE(axis.at(low * ratio), 1 + 1e-12);
        }
    }
}

TEST(LogAxis, EqualRatiosAreEqualDistances)
{
    const LogAxis axis(1, 1000);
    EXPECT_NEAR(axis.at(1), 0, 1e-12);
    EXPECT_NEAR(axis.at(10), 1 / 3.0, 1e-12);
    EXPECT_NEAR(axis.at(1000), 1, 1e-12);
    EXPECT_NEAR(axis.at(8) - axis.at(4), axis.at(600) - axis.at(300), 1e-12);
}

} // namespace
