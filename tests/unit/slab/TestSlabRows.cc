// SPDX-License-Identifier: Apache-2.0
/// @file TestSlabRows.cc
/// @brief Rows of a slab: zeros around runs that do not overlap.

#include <openvdb_spheretree/slab/SlabRows.h>

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

TEST(SlabRows, KeepZerosAroundRunsThatDoNotOverlap)
{
    for (uint32_t seed = 0; seed < 20; ++seed) {
        const LeafLayout layout(*maskOf(randomObject(seed).voxels));
        slab::SlabRows<int32_t> rows;
        for (uint32_t index = 0; index < layout.slabCount(); ++index) {
            for (const Axis axis : {Axis::Y, Axis::Z}) {
                rows.open(layout, index, axis);
                const LeafLayout::Slab slab = layout.slab(index);
                for (uint32_t leaf = slab.begin; leaf < slab.end; ++leaf) {
                    std::fill_n(rows.ofLeaf(leaf), kLeafVoxels, int32_t(leaf) + 1);
                }
                const LeafLayout::Slab runs = layout.runsOfSlab(axis, index);
                for (uint32_t i = runs.begin; i < runs.end; ++i) {
                    const LeafLayout::Run run = layout.run(axis, i);
                    const int32_t* row = rows.ofRun(i);
                    ASSERT_TRUE(std::all_of(row - 64, row, [](int32_t v) { return v == 0; }));
                    for (uint32_t k = 0; k < run.count; ++k, row += kLeafVoxels) {
                        ASSERT_EQ(row, rows.ofLeaf(run.leaves[k]));
                        ASSERT_EQ(row[0], int32_t(run.leaves[k]) + 1);
                        ASSERT_EQ(row[kLeafVoxels - 1], int32_t(run.leaves[k]) + 1);
                    }
                    ASSERT_TRUE(std::all_of(row, row + 64, [](int32_t v) { return v == 0; }));
                }
            }
        }
    }
}

} // namespace
