// SPDX-License-Identifier: Apache-2.0
/// @file CoreStages.h
/// @brief The core stages of one level, run one after the other, and how tests build their input
/// and compare the outcome with a reference.

#pragma once

#include "LineReference.h"
#include "NaiveReference.h"

#include <openvdb_spheretree/medial/DistanceMap.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/medial/PowerMap.h>
#include <openvdb_spheretree/voxel/Distance.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/Masks.h>
#include <openvdb_spheretree/voxel/MedialBall.h>

#include <gtest/gtest.h>
#include <openvdb/util/NullInterrupter.h>

#include <atomic>
#include <cstdint>
#include <set>
#include <vector>

namespace spheretree_test {

openvdb::MaskTree::Ptr maskOf(const Voxels& voxels);

/// A box as tiles, as large as they fit.
openvdb::MaskTree::Ptr maskOf(const CoordBBox& box);

openvdb::SharedPtr<openvdb::BoolGrid> gridOf(const openvdb::MaskTree& mask);

openvdb::SharedPtr<openvdb::BoolGrid> gridOf(const Voxels& voxels);

Voxels voxelsOf(const openvdb::MaskTree& tree);

/// Calls f(leaf, offset, ijk) for every object voxel.
template <typename F>
void forEachVoxel(const openvdb_spheretree::LeafLayout& layout, const F& f)
{
    for (uint32_t leaf = 0; leaf < layout.leafCount(); ++leaf) {
        for (uint32_t k = 0; k < openvdb_spheretree::kLeafVoxels; ++k) {
            if (layout.mask(leaf).isOn(k)) f(leaf, k, layout.voxel(leaf, k));
        }
    }
}

/// Says yes to "interrupted?" from the @a after-th question on.
class StopAfter : public openvdb::util::NullInterrupter {
public:
    explicit StopAfter(int after = 0) : mLeft(after) {}
    bool wasInterrupted(int = -1) override { return mLeft-- <= 0; }

private:
    std::atomic<int> mLeft;
};

struct CoreStages {
    explicit CoreStages(const openvdb::MaskTree& level, int dim = 3,
        const openvdb_spheretree::Distance& distance = {});
    CoreStages(const CoreStages&) = delete; // members refer to others

    /// @return the distance (squared if Euclidean) at any voxel, 0 outside the leaves.
    uint32_t distSq(const Coord& ijk) const;

    const openvdb_spheretree::MedialLevel medial;
    const openvdb_spheretree::LeafLayout& layout;
    const openvdb_spheretree::DistanceMap distances;
    const openvdb_spheretree::PowerMap& labels;
    /// A copy: loops over the balls of a temporary need one.
    const std::vector<openvdb_spheretree::MedialBall> balls;
};

/// Distance and label of every voxel of the reference, which may be one object among others.
testing::AssertionResult agreeOnVoxels(
    const NaiveReference& naive, const CoreStages& stages, const Coord& shift = Coord(0, 0, 0));

testing::AssertionResult agreeOnBalls(const std::vector<NaiveReference::Ball>& expected,
    const std::vector<openvdb_spheretree::MedialBall>& balls);

/// Distances, labels and medial balls are those of the reference, and nothing else is on.
testing::AssertionResult agree(const NaiveReference& naive, const CoreStages& stages);

/// Label of every object voxel of a plane; @a sites, if given, collects them.
testing::AssertionResult agreeOnPlane(const LineReference& reference, const CoreStages& stages,
    int z, std::set<Coord>* sites = nullptr);

/// Distances, labels and medial balls are those of the reference.
testing::AssertionResult agree(const LineReference& reference, const CoreStages& stages);

} // namespace spheretree_test
