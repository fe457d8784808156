// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/LevelCounts.h>

#include "support/Messages.h"
#include "support/RandomObjects.h"

#include <openvdb/Exceptions.h>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;
using Counts = std::vector<int64_t>;

/// Errors by count, from 1 on.
ErrorOfCut errorsOf(const std::vector<double>& percent)
{
    return [percent](int64_t count) {
        LevelError error;
        error.hammingPercent = percent.at(std::size_t(count - 1));
        error.hausdorff = error.hammingPercent / 10;
        return error;
    };
}

Counts neverAsked(const SphereBudget& budget, int64_t leaves)
{
    return levelCounts(budget, leaves, 1, [](int64_t) -> LevelError {
        ADD_FAILURE() << "asked for an error";
        return {};
    });
}

TEST(LevelCounts, AreThoseOfTheBudgetWhereThereIsNoBound)
{
    SphereBudget budget;
    EXPECT_EQ(neverAsked(budget, 100), (Counts{100, 64, 8, 1}));
    budget.spheres = {3, 500, 7};
    EXPECT_EQ(neverAsked(budget, 100), (Counts{100, 7, 3}));
}

TEST(LevelCounts, OfOneLeafAreOne)
{
    SphereBudget budget;
    budget.error = 0;
    EXPECT_EQ(neverAsked(budget, 1), Counts{1});
}

TEST(LevelCounts, AreTheFewestWithinABoundWhereErrorsFall)
{
    std::vector<double> percent;
    for (int i = 0; i < 50; ++i) percent.push_back(100 - 2 * i);
    for (int64_t n = 1; n <= 50; ++n) {
        SphereBudget budget;
        budget.error = 102 - 2 * double(n);
        EXPECT_EQ(levelCounts(budget, 51, 1, errorsOf(percent)), Counts{n});
        budget.error.reset();
        budget.distance = (102 - 2 * double(n)) / 20 + 1e-9;
        EXPECT_EQ(levelCounts(budget, 51, 0.5, errorsOf(percent)), Counts{n});
        budget.error = 0;
        EXPECT_EQ(levelCounts(budget, 51, 0.5, errorsOf(percent)), Counts{51}) << "both hold";
    }
}

TEST(LevelCounts, KeepBoundsThatAreJustReached)
{
    SphereBudget budget;
    LevelError error;
    error.hammingPercent = 2.5;
    error.hausdorff = 3;
    EXPECT_TRUE(isWithin(budget, 0.5, error));
    budget.distance = 1.5;
    EXPECT_TRUE(isWithin(budget, 0.5, error));
    EXPECT_FALSE(isWithin(budget, 0.51, error));
    budget.error = 2.5;
    EXPECT_TRUE(isWithin(budget, 0.5, error));
    budget.error = 2.4;
    EXPECT_FALSE(isWithin(budget, 0.5, error));
}

/// Whatever the errors do, the count is within, and the next eight below it are not.
TEST(LevelCounts, KeepTheBoundWhereErrorsRiseAndFall)
{
    Random random(1);
    for (int turn = 0; turn < 300; ++turn) {
        const int leaves = random.between(1, 60);
        std::vector<double> percent;
        for (int i = 1; i < leaves; ++i) percent.push_back(random.between(1, 90));
        SphereBudget budget;
        budget.error = random.between(0, 50);
        const int64_t n = levelCounts(budget, leaves, 1, errorsOf(percent)).at(0);
        const auto within = [&](int64_t count) {
            return count == leaves || percent[std::size_t(count - 1)] <= *budget.error;
        };
        ASSERT_TRUE(within(n));
        for (int64_t fewer = n - 1; fewer > 0 && fewer >= n - 8; --fewer) {
            ASSERT_FALSE(within(fewer)) << n;
        }
    }
}

TEST(LevelCounts, HaveTheLadderBelowABound)
{
    SphereBudget budget;
    budget.error = 50;
    budget.branching = 3;
    std::vector<double> percent(40, 100);
    percent.back() = percent[38] = 50;
    EXPECT_EQ(levelCounts(budget, 41, 1, errorsOf(percent)), (Counts{39, 27, 9, 3, 1}));
    percent[8] = 50;
    EXPECT_EQ(levelCounts(budget, 9, 1, errorsOf(percent)), (Counts{9, 3, 1}));
}

TEST(LevelCounts, SayWhenABoundTakesMoreSpheresThanAllowed)
{
    SphereBudget budget;
    budget.error = 50;
    budget.spheres = {5};
    const std::vector<double> percent{100, 90, 80, 70, 60, 50, 40};
    const std::string message =
        messageOf<openvdb::ValueError>([&] { levelCounts(budget, 8, 1, errorsOf(percent)); });
    EXPECT_TRUE(mentions(message, "error=50 cannot be reached with spheres=5: it takes 6 spheres"));
    budget.spheres = {6};
    EXPECT_EQ(levelCounts(budget, 8, 1, errorsOf(percent)), Counts{6});
}

} // namespace
