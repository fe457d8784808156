// SPDX-License-Identifier: Apache-2.0
/// @file TestStreamPlan.cc
/// @brief How many slabs enter at a time, and how packed ones are cut into groups.

#include <openvdb_spheretree/slab/StreamPlan.h>

#include "support/CoreStages.h"
#include "support/Messages.h"
#include "support/RandomObjects.h"

#include <algorithm>
#include <set>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using slab::LeafGroup;
using slab::LeafGroups;
using slab::planWithin;
using slab::StreamMemory;
using slab::StreamPlan;

/// A hundred slabs of a leaf each.
LeafLayout hundredSlabs()
{
    Voxels line;
    for (int x = 0; x < 800; ++x) line.push_back(Coord(x, 3, 5));
    return LeafLayout(*maskOf(line));
}

TEST(StreamPlan, IsTheLargestWindowThatFits)
{
    const LeafLayout layout = hundredSlabs();
    const StreamMemory memory{700, 300, 1, 10, 5, 3};
    // Beside those that enter: two and two for the reach of a ball within a voxel of them.
    EXPECT_EQ(slab::windowBytes(layout, memory, 1, 1), 50);
    EXPECT_EQ(slab::windowBytes(layout, memory, 64, 1), 70);
    EXPECT_EQ(slab::windowBytes(layout, memory, 1, 1000), 1000);
    const auto windowIn = [&](int64_t bytes) {
        const StreamPlan plan = planWithin(layout, memory, 1, bytes, 4);
        EXPECT_FALSE(plan.packed) << bytes;
        EXPECT_LE(plan.bytes, bytes);
        return plan.slabs;
    };
    EXPECT_EQ(windowIn(2004), 100u); // 1000, 4 x 1 of threads and 100 x 10
    EXPECT_EQ(windowIn(2003), 50u);
    EXPECT_EQ(windowIn(1051), 1u); // a single thread
}

/// Half as many, a quarter, ... with a thread for each of the first four: by hand, of slabs of one
/// leaf, where a window opens four slabs more than enter.
TEST(StreamPlan, HalvesTheWindowUntilItFits)
{
    const LeafLayout layout = hundredSlabs();
    const StreamMemory memory{700, 300, 1, 10, 5, 3};
    for (int bytes = 1051; bytes <= 2050; ++bytes) {
        int window = 0, needed = 0;
        for (const int slabs : {1, 3, 6, 12, 25, 50, 100}) {
            const int threads = std::min(4, slabs), open = std::min(100, slabs + 4);
            if (1000 + threads * 1 + open * 10 > bytes) break;
            window = slabs;
            needed = 1000 + threads * 1 + open * 10;
        }
        const StreamPlan plan = planWithin(layout, memory, 1, bytes, 4);
        ASSERT_FALSE(plan.packed) << bytes;
        ASSERT_EQ(plan.slabs, uint32_t(window)) << bytes;
        ASSERT_EQ(plan.threads, uint32_t(std::min(4, window))) << bytes;
        ASSERT_EQ(plan.bytes, needed) << bytes;
    }
}

TEST(StreamPlan, PacksWhatHasNoWindow)
{
    const LeafLayout layout = hundredSlabs();
    const StreamMemory memory{700, 300, 10, 30, 2, 5}; // 50 a thread, 200 for the run's keys
    constexpr uint32_t kReach = 1000 * 1000;           // so all slabs are open at once
    EXPECT_FALSE(planWithin(layout, memory, kReach, 4010, 1).packed);
    const StreamPlan all = planWithin(layout, memory, kReach, 4009, 4);
    EXPECT_TRUE(all.packed);
    EXPECT_EQ(all.slabs, 4u);
    EXPECT_EQ(all.storedBytes, 4009 - 1000 - 4 * 50 - 4009 / 16);
    EXPECT_EQ(all.packedBytes, 500);
    EXPECT_EQ(all.bandBytes, 300 + 3 * 40);
    const StreamPlan two = planWithin(layout, memory, kReach, 1107, 4);
    EXPECT_EQ(two.slabs, 2u);
    EXPECT_EQ(two.storedBytes, 0);
    const StreamPlan one = planWithin(layout, memory, kReach, 1050, 4);
    EXPECT_EQ(one.slabs, 1u);
    EXPECT_EQ(one.storedBytes, 0);
    const std::string why =
        messageOf<openvdb::ValueError>([&] { planWithin(layout, memory, kReach, 1049, 4); });
    EXPECT_TRUE(mentions(why, "the object's 100 leaf nodes"));
    EXPECT_TRUE(mentions(why, "memory="));
}

/// Every leaf is in one group of its slab, and in the band of its run; a band has one run, or no more leaves
/// than it may.
void expectGroups(const LeafLayout& layout, const LeafGroups& cut, int64_t leavesOfBand)
{
    std::vector<uint32_t> bandOf(layout.leafCount());
    for (std::size_t band = 0; band + 1 < cut.firstRunOfBand.size(); ++band) {
        const uint32_t runs = cut.firstRunOfBand[band + 1] - cut.firstRunOfBand[band];
        int64_t leaves = 0;
        for (uint32_t i = 0; i < runs; ++i) {
            leaves += layout.run(Axis::X, cut.firstRunOfBand[band] + i).count;
        }
        ASSERT_TRUE(runs == 1 || leaves <= leavesOfBand) << leaves << " in band " << band;
        for (uint32_t i = cut.firstRunOfBand[band]; i < cut.firstRunOfBand[band + 1]; ++i) {
            const LeafLayout::Run run = layout.run(Axis::X, i);
            for (uint32_t k = 0; k < run.count; ++k) bandOf[run.leaves[k]] = uint32_t(band);
        }
    }
    ASSERT_EQ(cut.firstRunOfBand.size(), cut.firstOfBand.size());
    ASSERT_EQ(cut.firstRunOfBand.back(), layout.runCount(Axis::X));
    ASSERT_EQ(cut.firstOfBand.back(), cut.groups.size());
    std::set<uint32_t> seen;
    for (std::size_t band = 0; band + 1 < cut.firstOfBand.size(); ++band) {
        for (uint32_t index = cut.firstOfBand[band]; index < cut.firstOfBand[band + 1]; ++index) {
            const LeafGroup& group = cut.groups[index];
            ASSERT_LT(group.begin, group.end);
            ASSERT_LE(group.end - group.begin, slab::kGroupLeaves);
            for (uint32_t leaf = group.begin; leaf < group.end; ++leaf) {
                ASSERT_TRUE(seen.insert(leaf).second);
                ASSERT_EQ(bandOf[leaf], band);
                ASSERT_EQ(layout.slabOf(leaf), group.slab);
            }
        }
    }
    ASSERT_EQ(seen.size(), layout.leafCount());
}

TEST(LeafGroups, ArePartsOfSlabsAndOfBands)
{
    for (uint32_t seed = 0; seed < 60; ++seed) {
        const LeafLayout layout(*maskOf(randomObject(seed).voxels));
        for (const int64_t bytes : {0, 1, 2, 5, 1 << 20}) {
            const LeafGroups cut(layout, 1, bytes);
            SCOPED_TRACE(std::to_string(seed) + ", " + std::to_string(bytes));
            ASSERT_NO_FATAL_FAILURE(expectGroups(layout, cut, bytes));
            const std::size_t bands = cut.firstOfBand.size() - 1;
            EXPECT_TRUE(bytes > 0 || bands == layout.runCount(Axis::X));
            EXPECT_TRUE(bytes < 1000 || bands == 1);
            std::size_t count = 0;
            for (const auto& ofSlab : cut.ofSlab) count += ofSlab.size();
            EXPECT_EQ(count, cut.groups.size());
        }
    }
}

TEST(LeafGroups, LargeSlabsHaveSeveral)
{
    const LeafLayout layout(*maskOf(CoordBBox(Coord(0), Coord(15, 399, 399)))); // 2 x 2500
    const LeafGroups cut(layout, 1, INT64_MAX);
    ASSERT_NO_FATAL_FAILURE(expectGroups(layout, cut, INT64_MAX));
    EXPECT_EQ(cut.groups.size(), 6u);
    EXPECT_EQ(cut.ofSlab[1].size(), 3u);
}

} // namespace
