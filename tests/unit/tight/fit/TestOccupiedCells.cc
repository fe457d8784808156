// SPDX-License-Identifier: Apache-2.0
/// @file TestOccupiedCells.cc
/// @brief Cells in boxes of every size against a loop over all cells, while cells come and go.

#include <openvdb_spheretree/tight/fit/OccupiedCells.h>

#include "support/RandomObjects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;
using openvdb::Coord;
using openvdb::CoordBBox;

std::vector<Coord> sortedIn(const OccupiedCells& occupied, const CoordBBox& box)
{
    std::vector<Coord> found;
    occupied.forEachIn(box, [&](const Coord& at) { found.push_back(at); });
    std::sort(found.begin(), found.end());
    return found;
}

/// Near and far cells on both sides of the origin.
Coord randomCell(Random& random)
{
    const int reach = random.between(0, 1) ? 20 : 1 << random.between(3, 26);
    return {random.between(-reach, reach), random.between(-reach, reach),
        random.between(-reach, reach)};
}

TEST(OccupiedCells, AreThoseOfALoopInAnyBox)
{
    Random random(3);
    OccupiedCells occupied;
    std::set<Coord> cells;
    std::size_t all = 0;
    for (int i = 0; i < 2000; ++i) {
        const Coord cell = randomCell(random);
        if (cells.insert(cell).second) {
            occupied.add(cell);
        } else {
            cells.erase(cell);
            occupied.remove(cell);
        }
        if (i % 3 == 2) { // any of them
            const auto at = std::next(cells.begin(), random.between(0, int(cells.size()) - 1));
            occupied.remove(*at);
            cells.erase(at);
        }
        const Coord a = randomCell(random), b = randomCell(random);
        const CoordBBox box(Coord::minComponent(a, b), Coord::maxComponent(a, b));
        std::vector<Coord> expected;
        std::copy_if(cells.begin(), cells.end(), std::back_inserter(expected),
            [&](const Coord& at) { return box.isInside(at); });
        ASSERT_EQ(sortedIn(occupied, box), expected) << box;
        all += expected.size();
    }
    EXPECT_GT(all, 10000u);
}

/// 64 bits do not count the cells of this box.
TEST(OccupiedCells, OfTheWidestBoxAreAll)
{
    OccupiedCells occupied;
    const Coord first(-(1 << 29)), last((1 << 29) - 1);
    occupied.add(first);
    occupied.add(last);
    EXPECT_EQ(sortedIn(occupied, CoordBBox(first, last)), (std::vector<Coord>{first, last}));
    EXPECT_TRUE(sortedIn(occupied, CoordBBox()).empty());
}

} // namespace
