// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tree/SphereBudget.h>

#include "support/Messages.h"

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>

#include <cmath>
#include <limits>

using namespace openvdb_spheretree;
using spheretree_test::mentions;
using spheretree_test::messageOf;

namespace {

using Counts = std::vector<int64_t>;

SphereBudget budgetOf(const Counts& spheres)
{
    SphereBudget budget;
    budget.spheres = spheres;
    return budget;
}

std::string whyInvalid(const SphereBudget& budget)
{
    return messageOf<openvdb::ValueError>([&] { budget.validate(); });
}

std::string whyNoCounts(const std::string& text)
{
    return messageOf<openvdb::ValueError>([&] { countsFromString(text); });
}

} // namespace

TEST(SphereBudget, NothingAskedForIsLevelsOfPowersOfEightAndAllLeaves)
{
    const SphereBudget budget;
    EXPECT_TRUE(budget.empty());
    EXPECT_FALSE(budget.hasBound());
    EXPECT_NO_THROW(budget.validate());
    EXPECT_EQ(budget.counts(1000), (Counts{1000, 512, 64, 8, 1}));
    EXPECT_EQ(budget.counts(513), (Counts{513, 512, 64, 8, 1}));
    EXPECT_EQ(budget.counts(512), (Counts{512, 64, 8, 1})) << "the leaves are a level once";
    EXPECT_EQ(budget.counts(2), (Counts{2, 1}));
    EXPECT_EQ(budget.counts(1), (Counts{1}));
}

TEST(SphereBudget, ABranchingGivesLevelsOfItsPowersAndAllLeaves)
{
    SphereBudget budget;
    budget.branching = 3;
    EXPECT_FALSE(budget.empty());
    EXPECT_EQ(budget.counts(30), (Counts{30, 27, 9, 3, 1}));
    budget.branching = SphereBudget::kMaxBranching;
    EXPECT_NO_THROW(budget.validate());
    EXPECT_EQ(
        budget.counts(SphereBudget::kMaxSpheres), (Counts{SphereBudget::kMaxSpheres, 1 << 20, 1}));
}

TEST(SphereBudget, CountsComeFinestFirstEachOnceAndNoneAboveTheLeaves)
{
    EXPECT_EQ(budgetOf({8, 512, 64}).counts(10000), (Counts{512, 64, 8}));
    EXPECT_EQ(budgetOf({64, 8, 64}).counts(10000), (Counts{64, 8}));
    EXPECT_EQ(budgetOf({8, 64, 512}).counts(50), (Counts{50, 8}));
    EXPECT_EQ(budgetOf({100, 200}).counts(50), (Counts{50}));
    EXPECT_EQ(budgetOf({SphereBudget::kMaxSpheres}).counts(7), (Counts{7}));
}

TEST(SphereBudget, ACountOutOfRangeIsAnErrorThatNamesItAndTheRange)
{
    for (const int64_t count :
        {int64_t(0), int64_t(-1), SphereBudget::kMaxSpheres + 1, INT64_MIN, INT64_MAX}) {
        const std::string why = whyInvalid(budgetOf({8, count}));
        EXPECT_TRUE(mentions(why, "spheres=" + std::to_string(count)));
        EXPECT_TRUE(mentions(why, "1 to 2147483647"));
    }
    EXPECT_NO_THROW(budgetOf({1, SphereBudget::kMaxSpheres}).validate());
}

TEST(SphereBudget, ABranchingOutOfRangeIsAnErrorThatNamesItAndTheRange)
{
    for (const int branching : {1, -1, -8, SphereBudget::kMaxBranching + 1}) {
        SphereBudget budget;
        budget.branching = branching;
        const std::string why = whyInvalid(budget);
        EXPECT_TRUE(mentions(why, "branching=" + std::to_string(branching)));
        EXPECT_TRUE(mentions(why, "2 to 1048576"));
    }
}

TEST(SphereBudget, ABoundThatIsNegativeOrNoNumberIsAnError)
{
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double value : {-1.0, -1e-9, infinity, -infinity, std::nan("")}) {
        SphereBudget byError, byDistance;
        byError.error = value;
        byDistance.distance = value;
        EXPECT_TRUE(mentions(whyInvalid(byError), "error="));
        EXPECT_TRUE(mentions(whyInvalid(byError), "percent"));
        EXPECT_TRUE(mentions(whyInvalid(byDistance), "distance="));
        EXPECT_TRUE(mentions(whyInvalid(byDistance), "world units"));
    }
    SphereBudget exact;
    exact.error = exact.distance = 0;
    EXPECT_NO_THROW(exact.validate());
    EXPECT_TRUE(exact.hasBound());
    EXPECT_FALSE(exact.empty());
}

TEST(SphereBudget, CountsAndABranchingContradictEachOther)
{
    SphereBudget budget = budgetOf({8, 64});
    budget.branching = 4;
    EXPECT_TRUE(mentions(whyInvalid(budget), "spheres=8,64 and branching=4"));
}

TEST(SphereBudget, ABoundTakesOneCountAndNoMore)
{
    SphereBudget budget = budgetOf({8, 64});
    budget.error = 5;
    EXPECT_TRUE(mentions(whyInvalid(budget), "spheres=8,64 with a bound on the error"));
    budget.spheres = {64};
    EXPECT_NO_THROW(budget.validate());
    budget.distance = 2.5;
    EXPECT_NO_THROW(budget.validate());
    budget.spheres.clear();
    budget.branching = 4;
    EXPECT_NO_THROW(budget.validate());
}

TEST(SphereBudget, CountsReadBack)
{
    for (const Counts& counts :
        {Counts{1}, Counts{8, 64, 512}, Counts{512, 8}, Counts{SphereBudget::kMaxSpheres}}) {
        EXPECT_EQ(countsFromString(countsToString(counts)), counts);
    }
    EXPECT_EQ(countsToString({8, 64, 512}), "8,64,512");
    EXPECT_EQ(countsToString({}), "");
}

TEST(SphereBudget, WhatIsNoListOfCountsIsAnErrorThatShowsIt)
{
    for (const char* text : {"", ",", "8,", ",8", "8,,64", "8 ,64", "8, 64", "8;64", "abc", "8a",
             "1.5", "1e3", "+8", "0x10", "99999999999999999999"}) {
        const std::string why = whyNoCounts(text);
        EXPECT_TRUE(mentions(why, "spheres='" + std::string(text) + "'"));
        EXPECT_TRUE(mentions(why, "such as 8,64,512"));
    }
    EXPECT_TRUE(mentions(whyNoCounts("0"), "spheres=0 is out of range"));
    EXPECT_TRUE(mentions(whyNoCounts("8,-1"), "spheres=-1 is out of range"));
    EXPECT_TRUE(mentions(whyNoCounts("2147483648"), "spheres=2147483648 is out of range"));
    for (const char* text : {"99999999999999999999", "8,9223372036854775808"}) {
        EXPECT_TRUE(mentions(whyNoCounts(text), "' is out of range: a level has 1 to "));
    }
    EXPECT_LT(whyNoCounts(std::string(100000, 'x')).size(), 300u);
    EXPECT_LT(whyNoCounts(std::string(100000, '9')).size(), 300u);
}

TEST(SphereBudget, ADistanceIsInWorldUnitsOrInVoxels)
{
    SphereBudget budget;
    setDistanceBound(budget, "0.5");
    EXPECT_EQ(budget.distanceWorld(2), 0.5);
    EXPECT_EQ(distanceBoundToString(budget), "0.5");
    setDistanceBound(budget, "1.5vox");
    EXPECT_EQ(budget.distanceWorld(2), 3);
    EXPECT_EQ(distanceBoundToString(budget), "1.5vox");
    setDistanceBound(budget, "");
    EXPECT_FALSE(budget.hasBound());
    EXPECT_EQ(distanceBoundToString(budget), "");
}

TEST(SphereBudget, AUnitThatAGridDoesNotHaveIsRefusedWithWhatToWrite)
{
    const auto why = [](const std::string& text) {
        SphereBudget budget;
        return messageOf<openvdb::ValueError>([&] { setDistanceBound(budget, text); });
    };
    for (const char* text : {"5mm", "0.5cm", "5m", "5um", "5in"}) {
        EXPECT_TRUE(mentions(why(text), std::string("distance=") + text));
        EXPECT_TRUE(mentions(why(text), "does not say what its unit of length is"));
        EXPECT_TRUE(mentions(why(text), "2vox"));
    }
    EXPECT_TRUE(mentions(why("5mm"), "(5 if these are mm)"));
    for (const char* text : {"vox", "5 vox", "5voxels", "x", "mm", "5%"}) {
        EXPECT_TRUE(mentions(why(text), "is no number"));
    }
    SphereBudget budget;
    setDistanceBound(budget, "-1vox");
    EXPECT_TRUE(mentions(whyInvalid(budget), "distance=-1"));
}
