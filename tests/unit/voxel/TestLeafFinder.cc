// SPDX-License-Identifier: Apache-2.0
/// @file TestLeafFinder.cc
/// @brief Leaves found by going on from the last one: the same as by a search, in any order.

#include <openvdb_spheretree/voxel/LeafFinder.h>

#include "support/BuiltTrees.h"

#include <random>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

TEST(LeafFinder, FindsWhatTheLayoutDoesInAnyOrder)
{
    for (const RandomObject& object : someObjects(0, 11)) {
        SCOPED_TRACE(object.name);
        const LeafLayout layout(*maskOf(object.voxels));
        Voxels asked = object.voxels;
        for (const Coord& voxel : object.voxels) {
            for (int axis = 0; axis < 3; ++axis) {
                Coord beside = voxel;
                beside[axis] += axis == 1 ? -9 : 9;
                asked.push_back(beside);
            }
        }
        std::mt19937 random(3);
        for (const bool sorted : {true, false}) {
            if (sorted) {
                std::sort(asked.begin(), asked.end());
            } else {
                std::shuffle(asked.begin(), asked.end(), random);
            }
            detail::LeafFinder finder(layout);
            for (const Coord& voxel : asked) {
                ASSERT_EQ(finder.find(voxel), layout.findLeaf(voxel)) << voxel;
            }
        }
    }
}

} // namespace
