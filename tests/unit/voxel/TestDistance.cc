// SPDX-License-Identifier: Apache-2.0
/// @file TestDistance.cc
/// @brief Distances against cheapest ways on a lattice and against plain search; their names.

#include <openvdb_spheretree/voxel/Distance.h>

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>

#include <cmath>
#include <map>
#include <queue>
#include <random>
#include <tuple>
#include <vector>

namespace {

using openvdb_spheretree::Distance;
using openvdb_spheretree::distanceFromString;

std::vector<Distance> norms()
{
    return {Distance::l1(), Distance::linf(), Distance::chamfer(3, 4, 5),
        Distance::chamfer(16, 21, 26), Distance::chamfer(2, 3, 3),
        Distance::chamfer(255, 255, 255)};
}

/// Costs of the cheapest ways from the origin to all voxels of a box, by Dijkstra's algorithm.
std::map<std::tuple<int, int, int>, int> cheapestWays(const Distance& d, int reach)
{
    const int cost[4] = {0, d.face(), d.edge(), d.corner()};
    std::map<std::tuple<int, int, int>, int> known;
    using Entry = std::pair<int, std::tuple<int, int, int>>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    open.push({0, {0, 0, 0}});
    while (!open.empty()) {
        const auto [so, at] = open.top();
        open.pop();
        if (!known.emplace(at, so).second) continue;
        for (int i = 0; i < 27; ++i) {
            const int dx = i / 9 - 1, dy = i / 3 % 3 - 1, dz = i % 3 - 1;
            const int x = std::get<0>(at) + dx, y = std::get<1>(at) + dy, z = std::get<2>(at) + dz;
            if (std::max({std::abs(x), std::abs(y), std::abs(z)}) > reach || i == 13) continue;
            open.push({so + cost[std::abs(dx) + std::abs(dy) + std::abs(dz)], {x, y, z}});
        }
    }
    return known;
}

TEST(Distance, ANormIsTheCostOfACheapestWay)
{
    for (const Distance& d : norms()) {
        for (const auto& [at, cost] : cheapestWays(d, 6)) {
            const auto [x, y, z] = at;
            ASSERT_EQ(d.norm(x, y, z), cost) << toString(d) << ' ' << x << ' ' << y << ' ' << z;
            ASSERT_EQ(d.lengthSq(x, y, z), int64_t(cost) * cost);
        }
    }
}

TEST(Distance, ReachIsTheLastCoordinateThatStaysWithinTheLimit)
{
    std::vector<Distance> all = norms();
    all.push_back(Distance());
    std::mt19937 random(1);
    for (const Distance& d : all) {
        std::uniform_int_distribution<int> coordinate(-20, 20), limit(0, 60 * d.unit());
        for (int i = 0; i < 3000; ++i) {
            const int x = coordinate(random), y = coordinate(random);
            const int64_t root = limit(random), limitSq = root * root + (i % 3 - 1) * (root > 0);
            int64_t expected = -1;
            for (int64_t z = 0; d.lengthSq(x, y, z) <= limitSq; ++z) expected = z;
            ASSERT_EQ(d.reach(x, y, limitSq), expected)
                << toString(d) << ' ' << x << ' ' << y << ' ' << limitSq;
        }
    }
}

TEST(Distance, TheClosedBallHoldsTheSameVoxelsAndIsTheSmallestForWholeCosts)
{
    for (const Distance& d : norms()) {
        std::vector<int64_t> costs; // of ways within the box
        for (const auto& entry : cheapestWays(d, 8)) costs.push_back(entry.second);
        for (int64_t radius = 1; radius <= 8 * d.face(); ++radius) {
            int64_t last = 0;
            for (const int64_t cost : costs) {
                if (cost < radius) last = std::max(last, cost);
            }
            ASSERT_EQ(d.closedSq(radius * radius), last * last) << toString(d) << ' ' << radius;
        }
    }
    EXPECT_EQ(Distance().closedSq(10), 9);
}

TEST(Distance, LengthsBeyondSixtyThreeBitsAreInfinite)
{
    const int64_t far = Distance::kFar;
    EXPECT_EQ(Distance().lengthSq(far, 0, 0), far * far);
    EXPECT_EQ(Distance().lengthSq(far, 1, 0), far * far + 1);
    EXPECT_EQ(Distance().lengthSq(far, far, 0), INT64_MAX);
    EXPECT_EQ(Distance().lengthSq(far, far, far), INT64_MAX);
    EXPECT_EQ(Distance().lengthSq(0, -far - 1, 0), INT64_MAX);
    EXPECT_EQ(Distance::linf().lengthSq(far, far, far), far * far);
    EXPECT_EQ(Distance::l1().lengthSq(far, 1, 0), INT64_MAX);
}

TEST(Distance, NamesReadBack)
{
    for (const char* name :
        {"l2", "l1", "linf", "chamfer:3,4,5", "chamfer:16,21,26", "chamfer:3,4", "chamfer:5,7"}) {
        EXPECT_EQ(toString(distanceFromString(name)), name);
    }
    EXPECT_EQ(toString(distanceFromString("chamfer:1,2,3")), "l1");
    EXPECT_TRUE(distanceFromString("l2").isEuclidean());
}

TEST(Distance, OfAPlaneIsThatOfSpaceWithoutCorners)
{
    const Distance flat = distanceFromString("chamfer:3,4"), space = Distance::chamfer(3, 4, 5);
    EXPECT_TRUE(flat.isFlat());
    EXPECT_NE(flat, space);
    for (int x = -9; x <= 9; ++x) {
        for (int y = -9; y <= 9; ++y) EXPECT_EQ(flat.norm(x, y, 0), space.norm(x, y, 0));
    }
    // The smallest closed radius: costs are 3 i + 4 j. A corner would make 5 of one step.
    EXPECT_EQ(flat.closedSq(6 * 6), 4 * 4);
    EXPECT_EQ(space.closedSq(6 * 6), 5 * 5);
    EXPECT_EQ(flat.closedSq(12 * 12), 11 * 11);
    EXPECT_EQ(distanceFromString("chamfer:1,2"), Distance::l1());
    EXPECT_EQ(distanceFromString("chamfer:1,1"), Distance::linf());
}

TEST(Distance, UnknownNamesAndWeightsThatAreNoNormAreRefusedByName)
{
    for (const char* name : {"", "l3", "L2", "chamfer", "chamfer:", "chamfer:3", "chamfer:3,7",
             "chamfer:4,3", "chamfer:3,", "chamfer:200,300", "chamfer:3,4,", "chamfer:3,4,5,6",
             "chamfer:3;4;5", "chamfer:a,b,c", "chamfer:3,4,5x", "chamfer:-3,4,5", "chamfer:0,0,0",
             "chamfer:3,7,8", "chamfer:3,4,6", "chamfer:3,5,4", "chamfer:4,3,5",
             "chamfer:300,400,500", "chamfer:99999999999,1,1"}) {
        try {
            distanceFromString(name);
            ADD_FAILURE() << name << " was taken";
        } catch (const openvdb::ValueError& error) {
            EXPECT_NE(std::string(error.what()).find("dist="), std::string::npos) << error.what();
        }
    }
}

} // namespace
