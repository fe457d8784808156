// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/region/BallsInBox.h>

#include <openvdb_spheretree/tight/fit/BallReach.h>
#include <openvdb_spheretree/tight/fit/CoveringFit.h>

#include "support/FineBalls.h"

#include <algorithm>
#include <numeric>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

using Balls = std::vector<ExactSphere>;
using Ids = std::vector<int32_t>;

int64_t powerOf(const ExactSphere& ball, const Coord& v)
{
    return ball.radiusSq - radiusSqToHold(ball, voxelBall(v));
}

/// @return the corners of a box: a difference of powers, which is linear, is smallest at one of them.
Voxels cornersOf(const CoordBBox& box)
{
    Voxels corners;
    for (int i = 0; i < 8; ++i) {
        Coord& v = corners.emplace_back();
        for (int a = 0; a < 3; ++a) v[a] = (i >> a & 1) ? box.max()[a] : box.min()[a];
    }
    return corners;
}

bool isStrongerInAll(const ExactSphere& a, const ExactSphere& b, const CoordBBox& box)
{
    const Voxels corners = cornersOf(box);
    return std::all_of(corners.begin(), corners.end(),
        [&](const Coord& v) { return powerOf(a, v) > powerOf(b, v); });
}

/// A box around a place, and balls near it; a list of these balls in some order.
struct RandomBalls {
    RandomBalls(uint32_t seed, const Coord& at, int reach, int largest)
    {
        Random random(seed);
        box = CoordBBox(at + random.coord(-6, 0), at + random.coord(1, 8));
        for (int i = random.between(1, 60); i-- > 0;) {
            ExactSphere ball = randomBall(random, -reach, reach, largest);
            for (int a = 0; a < 3; ++a) ball.center[a] += 16 * int64_t(at[a]);
            balls.push_back(ball);
        }
        for (int32_t i = 0; i < int32_t(balls.size()); ++i) {
            if (random.chance(0.8)) ids.push_back(i);
        }
        std::reverse(ids.begin(), ids.end());
    }

    CoordBBox box;
    Balls balls;
    Ids ids;
};

/// What is left out holds nothing that one before it in the list does not hold.
void expectAllThatMatter(const RandomBalls& some, const Ids& listed, int& leftOut)
{
    auto next = listed.begin();
    for (auto id = some.ids.begin(); id != some.ids.end(); ++id) {
        if (next != listed.end() && *next == *id) {
            ++next;
            continue;
        }
        const ExactSphere& ball = some.balls[*id];
        if (!BoxReach(ball, some.box).meets(ball)) continue;
        ASSERT_TRUE(std::any_of(some.ids.begin(), id, [&](int32_t other) {
            return isStrongerInAll(some.balls[other], ball, some.box);
        })) << *id;
        ++leftOut;
    }
    ASSERT_EQ(next, listed.end()); // in order
}

void expectAllThatMatter(int turns, const Coord& at, int reach, int largest, int leastLeftOut)
{
    int leftOut = 0;
    for (uint32_t seed = 0; seed < uint32_t(turns); ++seed) {
        const RandomBalls some(seed, at, reach, largest);
        const BallsInBox inBox(some.balls);
        StrongestBall strongest;
        Ids listed;
        inBox.list(some.box, some.ids, false, strongest, listed);
        ASSERT_NO_FATAL_FAILURE(expectAllThatMatter(some, listed, leftOut)) << seed;
    }
    EXPECT_GT(leftOut, leastLeftOut);
}

TEST(BallsInBox, LeavesOutWhatHoldsNoMoreThanOneBeforeItWithEveryTarget)
{
    forEachTarget([] { expectAllThatMatter(1000, Coord(0), 12, 14, 1000); });
}

TEST(BallsInBox, LeavesOutNoMoreBesideTheEndsOfCoordinates)
{
    for (const int largest : {3000, 30000}) {
        expectAllThatMatter(500, Coord(2147483000, 1 << 30, -77), largest + 5, largest, 500);
        expectAllThatMatter(500, Coord(-2147483000, 0, -77), largest + 5, largest, 500);
    }
}

/// A huge ball misses a corner of the box by so little that its power there is lost in a double, and a small one
/// holds the corner.
TEST(BallsInBox, ComparesHugeBallsWithRoomForRounding)
{
    Random random(8);
    const CoordBBox box(Coord(0), Coord(7));
    for (int turn = 0; turn < 20000; ++turn) {
        const Coord corner = cornersOf(box)[std::size_t(random.between(0, 7))];
        Balls balls(2);
        for (int a = 0; a < 3; ++a) {
            balls[0].center[a] = random.between(-(1 << 29), 1 << 29);
            balls[1].center[a] = 16 * int64_t(corner[a]) + random.between(-60, 60);
        }
        balls[0].radiusSq = radiusSqToHold(balls[0], voxelBall(corner)) - random.between(1, 3);
        balls[1].radiusSq = radiusSqToHold(balls[1], voxelBall(corner)) + random.between(0, 20);
        const BallsInBox inBox(balls);
        StrongestBall strongest;
        Ids first, again;
        inBox.list(box, {0, 1}, false, strongest, first);
        inBox.list(box, {0, 1}, false, strongest, again);
        ASSERT_TRUE(std::count(again.begin(), again.end(), 1)) << turn;
    }
}

TEST(BallsInBox, ComparesAllWithTheStrongestWhenListedAgain)
{
    int leftOut = 0;
    for (uint32_t seed = 0; seed < 2000; ++seed) {
        const RandomBalls some(seed, Coord(0), 12, 14);
        const BallsInBox inBox(some.balls);
        StrongestBall strongest;
        Ids first, again, expected;
        inBox.list(some.box, some.ids, false, strongest, first);
        inBox.list(some.box, first, false, strongest, again);
        for (const int32_t id : first) {
            const bool isWeaker =
                isStrongerInAll(some.balls[strongest.ball], some.balls[id], some.box);
            if (!isWeaker) expected.push_back(id);
        }
        ASSERT_EQ(again, expected) << seed;
        leftOut += int(first.size() - again.size());
    }
    EXPECT_GT(leftOut, 500);
}

TEST(BallsInBox, TheStrongestHasTheMostPowerInTheMiddle)
{
    for (uint32_t seed = 0; seed < 500; ++seed) {
        RandomBalls some(seed, Coord(40, -30, 7), 12, 14);
        some.box.max() = some.box.min() + Coord(4, 2, 6); // its middle is a voxel
        if (some.ids.empty()) continue;
        const Coord middle = some.box.min() + Coord(2, 1, 3);
        StrongestBall strongest;
        Ids listed;
        BallsInBox(some.balls).list(some.box, some.ids, false, strongest, listed);
        int64_t most = INT64_MIN;
        for (const int32_t id : some.ids) most = std::max(most, powerOf(some.balls[id], middle));
        ASSERT_EQ(double(most), strongest.power) << seed;
        ASSERT_EQ(most, powerOf(some.balls[strongest.ball], middle)) << seed;
    }
}

void expectToEndSoonAfter(std::size_t place)
{
    constexpr std::size_t kVector = 8; // balls at a time, at most
    const CoordBBox box(Coord(0), Coord(7));
    // Balls beside the box, none of them stronger in all of it than another one.
    Balls balls(60, ExactSphere{{-16, 56, 56}, 10000});
    Ids ids(balls.size());
    std::iota(ids.begin(), ids.end(), 0);
    for (const int64_t more : {1, -1}) {
        balls[place] = {{56, 56, 56}, 3 * 56 * 56 + more}; // to the corners
        const BallsInBox inBox(balls);
        StrongestBall some, others;
        Ids until, all;
        inBox.list(box, ids, true, some, until);
        inBox.list(box, ids, false, others, all);
        ASSERT_EQ(all.size(), ids.size());
        if (more > 0) {
            ASSERT_GT(until.size(), place);
            ASSERT_LE(until.size(), place + kVector);
        } else {
            ASSERT_EQ(until, all);
        }
    }
}

TEST(BallsInBox, EndsSoonAfterABallThatHoldsAllOfTheBoxWithEveryTarget)
{
    forEachTarget([] {
        for (std::size_t place = 0; place < 40; ++place) {
            ASSERT_NO_FATAL_FAILURE(expectToEndSoonAfter(place)) << place;
        }
    });
}

TEST(BallsInBox, AppendsToAListWithEveryTarget)
{
    forEachTarget([] {
        const BallsInBox balls({{{0, 0, 0}, 400}, {{800, 0, 0}, 400}});
        const CoordBBox box(Coord(0), Coord(7));
        StrongestBall strongest;
        Ids listed{7};
        balls.list(box, {1, 0}, false, strongest, listed);
        EXPECT_EQ(listed, (Ids{7, 0}));
        EXPECT_EQ(strongest.ball, 0);
        balls.list(box, {}, false, strongest, listed);
        EXPECT_EQ(listed, (Ids{7, 0}));
    });
}

} // namespace
