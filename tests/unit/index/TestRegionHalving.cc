// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/index/RegionHalving.h>

#include "support/RandomObjects.h"

#include <gtest/gtest.h>

namespace {

using namespace openvdb_spheretree::detail;
using namespace spheretree_test;

const Coord& originOf(const Coord& at) { return at; }

CoordBBox boxOf(const Coord* begin, const Coord* end)
{
    CoordBBox box;
    for (; begin != end; ++begin) box.expand(*begin);
    return box;
}

TEST(RegionHalving, DividesAcrossTheLongestSide)
{
    Random random(1);
    for (int turn = 0; turn < 300; ++turn) {
        Voxels items(std::size_t(random.between(2, 40)));
        for (Coord& item : items) item = random.coord(-9, 9);
        const int longest = turn % 3;
        items.front()[longest] = -(1 << 30); // farther apart than an int32_t can tell
        items.back()[longest] = (1 << 30) + 5;
        Voxels halved(items);
        Coord *const begin = halved.data(), *const end = begin + halved.size();
        const Coord* const middle = halve(begin, end, boxOf(begin, end), originOf);
        ASSERT_EQ(middle - begin, std::ptrdiff_t(items.size() / 2));
        for (const Coord* a = begin; a != middle; ++a) {
            for (const Coord* b = middle; b != end; ++b) ASSERT_LE((*a)[longest], (*b)[longest]);
        }
        sortVoxels(halved);
        sortVoxels(items);
        ASSERT_EQ(halved, items);
    }
}

struct Range {
    int64_t begin, end;
};

/// Numbers of a range, and how often it was divided.
struct Count {
    int64_t sum = 0, divided = 0;
};

TEST(RegionHalving, TakesEveryRegionToItsEndOnce)
{
    for (const int64_t size : {1, 2, 255, 256, 257, 5000}) {
        const auto divide = [](const Range& range, Count& count) -> std::vector<Range> {
            if (range.end - range.begin == 1) {
                count.sum += range.begin;
                return {};
            }
            ++count.divided;
            const int64_t middle = (range.begin + range.end) / 2;
            return {{range.begin, middle}, {middle, range.end}};
        };
        Count total;
        for (const Count& some : divideRegions(Range{0, size}, Count(), divide, nullptr)) {
            total.sum += some.sum;
            total.divided += some.divided;
        }
        EXPECT_EQ(total.sum, size * (size - 1) / 2);
        EXPECT_EQ(total.divided, size - 1);
    }
}

TEST(RegionHalving, LeavesOutWhatIsDone)
{
    const auto none = [](const Range&, Count& count) -> std::vector<Range> {
        ++count.divided;
        return {};
    };
    const auto sums = divideRegions(Range{0, 9}, Count{3, 0}, none, nullptr);
    ASSERT_EQ(sums.size(), 1u);
    EXPECT_EQ(sums.front().sum, 3);
    EXPECT_EQ(sums.front().divided, 1);
}

} // namespace
