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
        const double error = percent.at(std::size_t(count - 1));
        return BoundedError{error, error / 10, ""};
    };
}

/// Unpadded bounds: all leaves are known to have no error.
SphereTreeSettings settingsOf(const SphereBudget& budget, BoundOf bounds = BoundOf::Unpadded)
{
    TightOptions options;
    options.budget = budget;
    options.budget.bounds = bounds;
    return options;
}

Counts countsOf(
    const SphereBudget& budget, int64_t leaves, double voxelSize, const ErrorOfCut& errorOf)
{
    return levelCounts(settingsOf(budget), leaves, voxelSize, errorOf);
}

Counts neverAsked(const SphereBudget& budget, int64_t leaves)
{
    return countsOf(budget, leaves, 1, [](int64_t) -> BoundedError {
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

/// Spheres that are given may reach out of the object.
TEST(LevelCounts, OfGivenLeavesKeepTheBoundToo)
{
    SphereBudget budget;
    budget.error = 5;
    SphereTreeSettings settings = settingsOf(budget);
    settings.tight().leaves = Leaves::Given;
    EXPECT_EQ(levelCounts(settings, 3, 1, errorsOf({30, 20, 4})).front(), 3);
    const auto tooMuch = errorsOf({30, 20, 10});
    EXPECT_THROW(levelCounts(settings, 3, 1, tooMuch), openvdb::ValueError);
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
        EXPECT_EQ(countsOf(budget, 51, 1, errorsOf(percent)), Counts{n});
        budget.error.reset();
        budget.distance = (102 - 2 * double(n)) / 10 + 1e-9;
        EXPECT_EQ(countsOf(budget, 51, 0.5, errorsOf(percent)), Counts{n});
        budget.error = 0;
        EXPECT_EQ(countsOf(budget, 51, 0.5, errorsOf(percent)), Counts{51}) << "both hold";
    }
}

TEST(LevelCounts, KeepBoundsThatAreJustReached)
{
    SphereBudget budget;
    BoundedError error{2.5, 1.5, ""};
    EXPECT_TRUE(isWithin(budget, 0.5, error));
    budget.distance = 1.5;
    EXPECT_TRUE(isWithin(budget, 0.5, error));
    budget.distance = 1.49;
    EXPECT_FALSE(isWithin(budget, 0.5, error));
    budget.distance = 3;
    budget.distanceInVoxels = true;
    EXPECT_TRUE(isWithin(budget, 0.5, error));
    EXPECT_FALSE(isWithin(budget, 0.49, error));
    budget.error = 2.5;
    EXPECT_TRUE(isWithin(budget, 0.5, error));
    budget.error = 2.4;
    EXPECT_FALSE(isWithin(budget, 0.5, error));
    budget.error = 1000;
    error.unknown = "too many rows";
    EXPECT_FALSE(isWithin(budget, 0.5, error)) << "nobody knows";
}

/// Of stored spheres, those of all leaves need not have the smallest error.
TEST(LevelCounts, FindFewSpheresWhereAllLeavesAreNotWithin)
{
    SphereBudget budget;
    budget.error = 5;
    const std::vector<double> percent{4, 30, 20, 10, 6, 6, 6, 6};
    EXPECT_EQ(levelCounts(settingsOf(budget, BoundOf::Stored), 8, 1, errorsOf(percent)), Counts{1});
    budget.error = 6;
    const std::vector<double> other{40, 30, 20, 6, 10, 10, 10, 10};
    EXPECT_EQ(levelCounts(settingsOf(budget, BoundOf::Stored), 8, 1, errorsOf(other)), Counts{4});
}

TEST(LevelCounts, SayWhatWasFoundWhereNoneIsWithin)
{
    SphereBudget budget;
    budget.error = 5;
    budget.distance = 0.5;
    const std::vector<double> percent{40, 30, 20, 6, 10, 10, 10, 12};
    const std::string message = messageOf<openvdb::ValueError>(
        [&] { levelCounts(settingsOf(budget, BoundOf::Stored), 8, 2, errorsOf(percent)); });
    EXPECT_TRUE(mentions(message,
        "error=5 and distance=0.5 cannot be reached: padding=cubes makes "
        "stored radii 1.73205 world units larger"));
    EXPECT_TRUE(mentions(message, "the least error found is 6%, with 4 of 8 spheres"));
    EXPECT_TRUE(mentions(message, "the least reach found is 0.6, with 4 of 8 spheres"));
    EXPECT_TRUE(mentions(message, "padding=voxels"));
}

TEST(LevelCounts, SayWhyNoErrorIsKnown)
{
    SphereBudget budget;
    budget.error = 5;
    const auto unknown = [](int64_t) { return BoundedError{0, 0, "too many rows"}; };
    const std::string message = messageOf<openvdb::ValueError>(
        [&] { levelCounts(settingsOf(budget, BoundOf::Stored), 8, 2, unknown); });
    EXPECT_TRUE(mentions(message, "the error of 8 spheres is not known"));
    EXPECT_TRUE(mentions(message, "too many rows; ask for spheres= instead"));
}

TEST(LevelCounts, ADistanceThatPaddingAloneExceedsIsRefused)
{
    SphereBudget budget;
    const auto refusal = [&] {
        return messageOf<openvdb::ValueError>(
            [&] { requireReachable(settingsOf(budget, BoundOf::Stored), 2); });
    };
    EXPECT_NO_THROW(requireReachable(settingsOf(budget, BoundOf::Stored), 2));
    budget.distance = 0.7;
    EXPECT_TRUE(mentions(refusal(), "distance=0.7 cannot be reached: padding=cubes"));
    EXPECT_TRUE(mentions(refusal(), "alone reaches at least 0.732051"));
    budget.distance = 0.74;
    EXPECT_NO_THROW(requireReachable(settingsOf(budget, BoundOf::Stored), 2));
    budget.distance = 0.36;
    budget.distanceInVoxels = true;
    EXPECT_TRUE(mentions(refusal(), "distance=0.36vox"));
    EXPECT_NO_THROW(requireReachable(settingsOf(budget, BoundOf::Unpadded), 2));
}

/// Whatever the errors do, the count is within, and the next eight below it are not.
TEST(LevelCounts, KeepTheBoundWhereErrorsRiseAndFall)
{
    Random random(1);
    int couldBeFewer = 0;
    for (int turn = 0; turn < 300; ++turn) {
        const int leaves = random.between(1, 60);
        std::vector<double> percent;
        for (int i = 1; i < leaves; ++i) percent.push_back(random.between(1, 90));
        SphereBudget budget;
        budget.error = random.between(0, 50);
        const int64_t n = countsOf(budget, leaves, 1, errorsOf(percent)).at(0);
        const auto within = [&](int64_t count) {
            return count == leaves || percent[std::size_t(count - 1)] <= *budget.error;
        };
        ASSERT_TRUE(within(n));
        bool isFewest = true; // of those just below
        for (int64_t fewer = n - 1; fewer > 0 && fewer >= n - 8; --fewer) {
            isFewest = isFewest && !within(fewer);
        }
        couldBeFewer += !isFewest;
    }
    EXPECT_LT(couldBeFewer, 60);
}

/// Each error may take as long as a tree; and here any odd number of balls is within the bound.
TEST(LevelCounts, AsksForFewErrors)
{
    SphereBudget budget;
    budget.error = 50;
    int asked = 0;
    const auto errorOf = [&](int64_t count) -> BoundedError {
        ++asked;
        const bool isOdd = count % 2 == 1 && count > 10;
        return {count > 600 || isOdd ? 40.0 : 60.0, 0, ""};
    };
    EXPECT_LT(countsOf(budget, 100000, 1, errorOf).front(), 600);
    EXPECT_LT(asked, 40);
}

TEST(LevelCounts, HaveTheLadderBelowABound)
{
    SphereBudget budget;
    budget.error = 50;
    budget.branching = 3;
    std::vector<double> percent(40, 100);
    percent.back() = percent[38] = 50;
    EXPECT_EQ(countsOf(budget, 41, 1, errorsOf(percent)), (Counts{39, 27, 9, 3, 1}));
    percent[8] = 50;
    EXPECT_EQ(countsOf(budget, 9, 1, errorsOf(percent)), (Counts{9, 3, 1}));
}

TEST(LevelCounts, SayWhenABoundTakesMoreSpheresThanAllowed)
{
    SphereBudget budget;
    budget.error = 50;
    budget.spheres = {5};
    const std::vector<double> percent{100, 90, 80, 70, 60, 50, 40};
    const std::string message =
        messageOf<openvdb::ValueError>([&] { countsOf(budget, 8, 1, errorsOf(percent)); });
    EXPECT_TRUE(mentions(message,
        "error=50 cannot be reached with spheres=5; the fewest found within it: 6 spheres have an "
        "error of 50%; 5 spheres have an error of 60%"));
    budget.spheres = {6};
    EXPECT_EQ(countsOf(budget, 8, 1, errorsOf(percent)), Counts{6});
}

} // namespace
