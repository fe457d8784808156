// SPDX-License-Identifier: Apache-2.0
/// @file TestSlabOrder.cc
/// @brief Voxels in the order of a slab are in the order of their coordinates.

#include <openvdb_spheretree/voxel/SlabOrder.h>

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

TEST(BallOrder, IsThatOfCoordinates)
{
    for (uint32_t seed = 0; seed < 20; ++seed) {
        const Voxels voxels = randomObject(seed).voxels;
        const LeafLayout layout(*maskOf(voxels));
        Voxels ordered;
        for (uint32_t index = 0; index < layout.slabCount(); ++index) {
            const LeafLayout::Slab slab = layout.slab(index);
            const LeafMask* marks = &layout.mask(slab.begin);
            const std::size_t before = ordered.size();
            ordered.resize(before + detail::countMarks(marks, slab.size()));
            detail::visitWithPlaces(
                layout, index, marks, [&](uint32_t leaf, uint32_t offset, std::size_t place) {
                    ordered.at(before + place) = layout.voxel(leaf, offset);
                });
        }
        Voxels sorted(voxels);
        std::sort(sorted.begin(), sorted.end());
        sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
        ASSERT_EQ(ordered, sorted) << seed;
    }
}

} // namespace
