// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/MonotoneLevels.h>

#include <gtest/gtest.h>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;

ExactSphere ballAt(int64_t x) { return {{x, 0, 0}, 256}; }

TightLevel level(const std::vector<int64_t>& balls, std::vector<int32_t> parents)
{
    TightLevel result;
    for (const int64_t x : balls) result.balls.push_back(ballAt(x));
    result.parent = std::move(parents);
    return result;
}

/// Four balls below two below one.
std::vector<TightLevel> threeLevels()
{
    return {level({1, 2, 3, 4}, {0, 0, 1, 1}), level({10, 20}, {0, 0}), level({100}, {})};
}

void expectEqual(const std::vector<TightLevel>& some, const std::vector<TightLevel>& others)
{
    ASSERT_EQ(some.size(), others.size());
    for (std::size_t k = 0; k < some.size(); ++k) {
        EXPECT_EQ(some[k].balls, others[k].balls) << "level " << k;
        EXPECT_EQ(some[k].parent, others[k].parent) << "level " << k;
    }
}

TEST(MonotoneLevels, StayAsTheyAreWhereNoneCoversMoreThanACoarserOne)
{
    expectEqual(monotoneLevels(threeLevels(), {10, 20, 30}), threeLevels());
    expectEqual(monotoneLevels(threeLevels(), {20, 20, 20}), threeLevels());
}

TEST(MonotoneLevels, AMiddleLevelBecomesACopyAndItsChildrenHangBelowTheCopy)
{
    const std::vector<TightLevel> expected{
        level({1, 2, 3, 4}, {0, 0, 0, 0}), level({100}, {0}), level({100}, {})};
    expectEqual(monotoneLevels(threeLevels(), {10, 31, 30}), expected);
}

TEST(MonotoneLevels, ChildrenHangBelowTheCopyOfTheirGrandparent)
{
    const std::vector<TightLevel> levels{
        level({1, 2, 3, 4}, {0, 1, 2, 2}), level({10, 20, 30}, {1, 0, 1}), level({100, 200}, {})};
    const std::vector<TightLevel> expected{
        level({1, 2, 3, 4}, {1, 0, 1, 1}), level({100, 200}, {0, 1}), level({100, 200}, {})};
    expectEqual(monotoneLevels(levels, {1, 9, 8}), expected);
}

TEST(MonotoneLevels, TheFinestLevelBecomesACopyOfTheMiddleOne)
{
    const std::vector<TightLevel> expected{
        level({10, 20}, {0, 1}), level({10, 20}, {0, 0}), level({100}, {})};
    expectEqual(monotoneLevels(threeLevels(), {21, 20, 30}), expected);
}

TEST(MonotoneLevels, AllBecomeTheCoarsestOneWhereThatIsBest)
{
    const std::vector<TightLevel> expected{level({100}, {0}), level({100}, {0}), level({100}, {})};
    expectEqual(monotoneLevels(threeLevels(), {7, 20, 5}), expected);
}

TEST(MonotoneLevels, BallsOfACopyWithoutChildrenAreDropped)
{
    const std::vector<TightLevel> levels{
        level({1}, {0}), level({10, 20}, {0, 2}), level({100, 200, 300}, {})};
    // The copy has the children of what it replaces: ball 10 hung below ball 100.
    const std::vector<TightLevel> expected{level({1}, {0}), level({100}, {0}), level({100}, {})};
    expectEqual(monotoneLevels(levels, {1, 9, 8}), expected);
}

TEST(MonotoneLevels, UnknownLevelsStayUnlessTheyLieBetween)
{
    expectEqual(monotoneLevels(threeLevels(), {40, std::nullopt, std::nullopt}), threeLevels());
    expectEqual(monotoneLevels(threeLevels(), {std::nullopt, 20, 30}), threeLevels());
    const std::vector<TightLevel> expected{level({100}, {0}), level({100}, {0}), level({100}, {})};
    expectEqual(monotoneLevels(threeLevels(), {40, std::nullopt, 30}), expected);
}

} // namespace
