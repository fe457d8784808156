// SPDX-License-Identifier: Apache-2.0
/// @file TestCostWindow.cc
/// @brief Counts of what costs, by rows (BallRows.h) and by runs (CostRuns.h), sample by sample
/// and with every target of Highway.

#include <openvdb_spheretree/tight/fit/CostWindow.h>

#include "support/FineBalls.h"

#include <openvdb_spheretree/tight/fit/BallRows.h>
#include <openvdb_spheretree/tight/fit/CostRuns.h>

#include <cmath>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// The samples of a window that cost, from its origin.
struct Samples {
    CoordBBox box; ///< others are not looked at
    std::vector<Coord> cost;

    Samples(const CostWindow& window, const Voxels& object, const Coord& size)
        : box(Coord(0, 0, 0), size)
    {
        const ExactSphere origin = window.centerOf(LocalBall());
        const int64_t step = int64_t(1) << window.level();
        for (const Coord& at : voxelsOfBox(box)) {
            Coord voxel;
            for (int a = 0; a < 3; ++a) voxel[a] = int32_t(origin.center[a] / 16 + at[a] * step);
            if (!contains(object, voxel)) cost.push_back(at);
        }
    }
    static double distanceSq(const Coord& at, const LocalBall& ball)
    {
        const double x = 16 * at[0] - ball.x, y = 16 * at[1] - ball.y, z = 16 * at[2] - ball.z;
        return x * x + y * y + z * z;
    }
    void cover(const LocalBall& ball)
    {
        cost.erase(std::remove_if(cost.begin(), cost.end(),
                       [&](const Coord& at) { return distanceSq(at, ball) <= ball.radiusSq; }),
            cost.end());
    }
    int64_t count(const LocalBall& ball) const
    {
        return std::count_if(cost.begin(), cost.end(),
            [&](const Coord& at) { return distanceSq(at, ball) <= ball.radiusSq; });
    }
};

/// May reach out on any side.
LocalBall moved(LocalBall ball, Random& random)
{
    for (float* const c : {&ball.x, &ball.y, &ball.z}) *c += float(random.between(-150, 150));
    return ball;
}

/// Whole in a window of @a size samples.
LocalBall localBall(Random& random, const Coord& size)
{
    const int radius = random.between(0, 7 * std::min({size[0], size[1], size[2]}));
    LocalBall ball;
    float* const center[3] = {&ball.x, &ball.y, &ball.z};
    for (int a = 0; a < 3; ++a) {
        *center[a] = float(random.between(radius + 1, 16 * size[a] - radius - 1));
    }
    ball.radiusSq = float(radius * radius - random.between(0, radius));
    return ball;
}

struct Case {
    Voxels object;
    FineBox box;
    int level;
    Coord size; ///< samples, at least
};

Case randomCase(Random& random)
{
    Case c;
    c.level = random.between(0, 3);
    const int step = 1 << c.level;
    const Coord corner = random.coord(-40, 40);
    c.size = random.coord(3, 13);
    if (random.chance(0.2)) c.size[2] = 70; // more than a word
    for (int a = 0; a < 3; ++a) {
        c.box.lo[a] = 16 * int64_t(corner[a]);
        c.box.hi[a] = 16 * int64_t(corner[a] + step * c.size[a]);
    }
    for (int i = 0; i < 400; ++i) {
        Coord v = corner + random.coord(-9, step * 12);
        if (i % 2) v[2] += step * (c.size[2] - 9); // in the last word, too
        c.object.emplace_back(v[0] & -step, v[1] & -step, v[2] & -step);
    }
    sortVoxels(c.object);
    return c;
}

void expectRuns(const CostWindow& window, const Samples& samples, const LocalBall& place)
{
    std::vector<CostRun> runs;
    window.collect(place, runs);
    int64_t found = 0;
    Coord before(-1, -1, -1);
    for (const CostRun& run : runs) {
        ASSERT_LE(run.first, run.last);
        double nearestSq = 1e9;
        for (int z = run.first; z <= run.last; ++z) {
            const Coord at(int(run.x) / 16, int(run.y) / 16, z);
            ASSERT_LT(before, at);
            before = at;
            nearestSq = std::min(nearestSq, Samples::distanceSq(at, place));
            ASSERT_LE(Samples::distanceSq(at, place), place.radiusSq);
            found += samples.box.isInside(at);
        }
        ASSERT_LE(run.distanceSq, nearestSq);
        before = before.offsetBy(0, 0, 1); // or it would be one run
    }
    ASSERT_EQ(found, samples.count(place));
}

void expectBounds(const CostRuns& runs, const Samples& samples, const LocalBall& ball)
{
    const int64_t count = samples.count(ball);
    ASSERT_EQ(runs.count(ball), count);
    for (const int64_t bound : {int64_t(0), count / 2, count - 1, count, count + 5}) {
        const int64_t bounded = runs.count(ball, bound);
        if (count > bound) {
            ASSERT_GT(bounded, bound);
        } else ASSERT_EQ(bounded, count);
    }
}

void expectCounts(Random& random)
{
    const Case c = randomCase(random);
    const SampledObject object = sampled(c.object);
    CostWindow window;
    window.reset(object, c.box, c.level);
    Samples samples(window, c.object, c.size.offsetBy(1, 1, 8)); // all there are along x and y
    CostRuns runs;                                               // of one place after the other
    for (int turn = 0; turn < 8; ++turn) {
        const LocalBall ball = localBall(random, c.size);
        ASSERT_EQ(window.count(ball), samples.count(ball));
        ASSERT_NO_FATAL_FAILURE(expectRuns(window, samples, ball));
        runs.collect(window, ball);
        for (int i = 0; i < 30; ++i) {
            LocalBall inner = localBall(random, c.size);
            inner.radiusSq = std::floor(inner.radiusSq / float(1 + i));
            if (!runs.fits(inner)) continue;
            ASSERT_NO_FATAL_FAILURE(expectBounds(runs, samples, inner));
        }
        ASSERT_NO_FATAL_FAILURE(expectRuns(window, samples, moved(ball, random)));
        LocalBall covered = localBall(random, c.size);
        if (turn % 2) covered = moved(covered, random);
        window.cover(covered);
        samples.cover(covered);
    }
}

TEST(CostWindow, CountsSampleBySampleWithEveryTarget)
{
    forEachTarget([] {
        Random random(1);
        for (int i = 0; i < 45; ++i) ASSERT_NO_FATAL_FAILURE(expectCounts(random));
    });
}

/// Rounding may put the end of a ball, and the last sample in it, into different shells.
TEST(CostWindow, CountsTheSampleWhereTheBallEnds)
{
    Random random(3);
    const Coord middle(20, 20, 20);
    for (int i = 0; i < 100; ++i) {
        const Coord half = random.coord(-5, 5), only = middle + half + half;
        Voxels object = voxelsOfBox(CoordBBox(Coord(0, 0, 0), Coord(40, 40, 40)));
        object.erase(std::remove(object.begin(), object.end(), only), object.end());
        FineBox box;
        box.expand(voxelBall(middle), 16 * 18);
        CostWindow window;
        window.reset(sampled(object), box, 0);
        LocalBall ball = window.toLocal(voxelBall(middle + half));
        ball.radiusSq = float(256 * squaredDistance(half, Coord(0, 0, 0)));
        LocalBall place = window.toLocal(voxelBall(middle));
        for (int shells = 1; shells < 64 && ball.radiusSq > 0; ++shells) {
            place.radiusSq = 4 * ball.radiusSq * 64 / float(shells); // the ball ends where one does
            CostRuns runs;
            runs.collect(window, place);
            if (!runs.fits(ball)) continue;
            ASSERT_EQ(runs.count(ball), 1) << half << ", " << shells;
        }
    }
}

TEST(CostWindow, CountsInPlacesThatAreAPoint)
{
    CostWindow window;
    FineBox box;
    box.expand(voxelBall(Coord(5, 5, 5)), 100);
    window.reset(sampled({Coord(1, 2, 3)}), box, 0);
    for (const Coord& at : {Coord(1, 2, 3), Coord(4, 5, 6)}) {
        const LocalBall point = window.toLocal(voxelBall(at));
        CostRuns runs;
        runs.collect(window, point);
        EXPECT_TRUE(runs.fits(point));
        EXPECT_EQ(runs.count(point), at == Coord(1, 2, 3) ? 0 : 1);
    }
}

/// At level 0 a ball is the same in the window and out of it.
TEST(CostWindow, CountsVoxelsOutsideTheObject)
{
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        const RandomObject object = randomObject(uint32_t(i));
        const Coord middle = boxOf(object.voxels).min();
        ExactSphere ball = randomBall(random, 0, 9, 9);
        for (int a = 0; a < 3; ++a) ball.center[a] += 16 * int64_t(middle[a]);
        int64_t expected = 0;
        for (const Coord& v : voxelsOfBox(CoordBBox(middle - Coord(10), middle + Coord(20)))) {
            expected += holds(ball, v) && !contains(object.voxels, v);
        }
        CostWindow window;
        FineBox box;
        box.expand(ball);
        window.reset(sampled(object.voxels), box, 0);
        ASSERT_EQ(window.count(window.toLocal(ball)), expected);
        ExactSphere back = window.centerOf(window.toLocal(ball));
        back.radiusSq = ball.radiusSq;
        ASSERT_TRUE(back == ball);
        window.cover(ball);
        ASSERT_EQ(window.count(window.toLocal(ball)), 0);
    }
}

/// What a disc costs is its area: a ball of the same radius holds the more voxels of other z, the larger it is.
TEST(CostWindow, OfAFlatObjectCountsItsPlaneAlone)
{
    Random random(9);
    for (const int z : {-3, 0, 8, 21}) {
        Voxels voxels;
        for (const Coord& v : shapes::noise(Coord(20, 20, 1), 0.5, random)) {
            voxels.emplace_back(v[0], v[1], z);
        }
        sortVoxels(voxels);
        const SampledObject object(openvdb_spheretree::LeafLayout(*maskOf(voxels)), true);
        const ExactSphere disc{{16 * 9 + 3, 16 * 8 - 5, 16 * z}, 150 * 150};
        int64_t outside = 0;
        for (int x = -10; x < 30; ++x) {
            for (int y = -10; y < 30; ++y) {
                const int64_t dx = 16 * x - disc.center[0], dy = 16 * y - disc.center[1];
                const bool isHeld = dx * dx + dy * dy <= disc.radiusSq;
                outside += isHeld && !contains(voxels, Coord(x, y, z));
            }
        }
        FineBox box;
        box.expand(disc);
        CostWindow window;
        window.reset(object, box, 0);
        EXPECT_EQ(window.count(window.toLocal(disc)), outside) << "z = " << z;
        EXPECT_EQ(window.voxelsPerSample(), 1);
        window.reset(object, box, 1);
        EXPECT_EQ(window.voxelsPerSample(), 4);
        const int64_t samples = window.count(window.toLocal(disc));
        EXPECT_GT(4 * samples, outside / 2);
        EXPECT_LT(4 * samples, 2 * outside);
    }
}

/// Above level 0, centers are rounded to 1/16 sample and squared radii down.
TEST(CostWindow, RoundsBallsToItsSamples)
{
    Random random(3);
    const SampledObject object = sampled({Coord(1, 2, 3)});
    for (int turn = 0; turn < 300; ++turn) {
        const int level = turn % 6;
        const double step = std::ldexp(1.0, level);
        const ExactSphere ball = randomBall(random, -900, 900, 60);
        FineBox box;
        box.expand(ball);
        CostWindow window;
        window.reset(object, box, level);
        const LocalBall local = window.toLocal(ball);
        ASSERT_EQ(local.radiusSq, std::floor(double(ball.radiusSq) / (step * step)));
        const ExactSphere origin = window.centerOf(LocalBall()), back = window.centerOf(local);
        const float at[3] = {local.x, local.y, local.z};
        for (int a = 0; a < 3; ++a) {
            ASSERT_EQ(origin.center[a] % int64_t(16 * step), 0) << "a sample";
            ASSERT_EQ(double(back.center[a]), double(origin.center[a]) + at[a] * step);
            ASSERT_LE(std::abs(double(back.center[a] - ball.center[a])), step / 2);
        }
    }
}

TEST(CostWindow, IsClearedByHugeBallsFromFar)
{
    forEachTarget([] {
        CostWindow window;
        FineBox box;
        box.expand(voxelBall(Coord(5, 5, 5)), 100);
        const SampledObject object = sampled({Coord(1, 2, 3)});
        const LocalBall all{100, 100, 130, 9000};
        for (const int64_t far : {int64_t(1) << 12, int64_t(1) << 20, int64_t(1) << 30}) {
            for (const int64_t at : {-far, far}) {
                window.reset(object, box, 0);
                const int64_t before = window.count(all);
                const int64_t near = far - 5000 * (far >> 20);
                window.cover(ExactSphere{{at, 0, 0}, (near - 400) * (near - 400)});
                ASSERT_EQ(window.count(all), before) << "it ends before the window";
                window.cover(ExactSphere{{at, 0, at}, 2 * (far + 5000) * (far + 5000)});
                ASSERT_EQ(window.count(all), 0);
                ASSERT_GT(before, 0);
            }
        }
    });
}

TEST(CostWindow, HasTheFinestLevelWithFewSamplesInARadius)
{
    EXPECT_EQ(CostWindow::levelFor(0, 16), 0);
    EXPECT_EQ(CostWindow::levelFor(256, 16), 0);
    EXPECT_EQ(CostWindow::levelFor(257, 16), 1);
    EXPECT_EQ(CostWindow::levelFor(16 * 40 * 8, 40), 3);
    EXPECT_EQ(CostWindow::levelFor(16 * 40 * 8 + 1, 40), 4);
}

/// @return what balls around a cube of one leaf at @a corner cost, and balls beside it, at some levels.
std::vector<int64_t> costsAround(const Coord& corner)
{
    openvdb::MaskTree mask(false);
    mask.addTile(1, corner, true, true);
    const SampledObject object{openvdb_spheretree::LeafLayout(mask)};
    std::vector<int64_t> costs;
    for (const int level : {0, 1, 2}) {
        for (int way = 0; way < 9; ++way) { // windows that do not reach the leaf as well
            ExactSphere ball;
            for (int a = 0; a < 3; ++a) ball.center[a] = kFine * (int64_t(corner[a]) + 4);
            ball.center[way % 3] += kFine * 60 * (way / 3 - 1);
            ball.radiusSq = kFine * kFine * 400;
            CostWindow window;
            window.reset(object, FineBox(ball, kFine), level);
            costs.push_back(window.count(window.toLocal(ball)));
        }
    }
    return costs;
}

/// Windows reach beyond the ends, and cost there what they cost elsewhere.
TEST(CostWindow, IsTheSameAtTheEndsOfCoordinates)
{
    const auto expected = costsAround(Coord(0));
    EXPECT_GT(expected[0], expected[3]); // aside, and around the leaf
    EXPECT_EQ(costsAround(Coord(INT32_MIN)), expected);
    EXPECT_EQ(costsAround(Coord(INT32_MAX - 7)), costsAround(Coord(4096 - 8)));
}

} // namespace
