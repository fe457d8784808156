// SPDX-License-Identifier: Apache-2.0
/// @file LabelQueries.h
/// @brief The voxels whose labels are queried, and how far each has come on its path to its label.
///
/// 1. A query waits in the list of its voxel's leaf until the offsets along x are known there.
/// 2. It moves along x, and waits in the list of the leaf that it has come to.
/// 3. When the slab of that leaf is finished, it moves along y and z to the center of its ball.
///
/// Step 2 stays in a run along x, so threads that work on different runs do not meet. A list is a
/// chain of numbers of queries; a query is in one list at a time. Cost: 8 bytes a leaf, if there
/// are queries, and 4 a query.

#pragma once

#include "SlabLabels.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/voxel/VoxelRef.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

namespace openvdb_spheretree::slab {

/// The leaf of a voxel that is off.
constexpr uint32_t kNoLeaf = UINT32_MAX;

class LabelQueries {
public:
    /// @param layout  kept by reference
    /// @param voxels  each becomes its label; those in kNoLeaf stay; may be null
    LabelQueries(const LeafLayout& layout, std::vector<VoxelRef>* voxels)
        : mLayout(layout), mVoxels(voxels)
    {
        if (!voxels || voxels->empty()) return;
        assert(voxels->size() < kEnd);
        mOfLeaf.assign(layout.leafCount(), kEnd);
        mMoved.assign(layout.leafCount(), kEnd);
        detail::resizeLarge(mNext, voxels->size());
        for (uint32_t i = 0; i < mNext.size(); ++i) {
            const uint32_t leaf = (*voxels)[i].leaf;
            if (leaf != kNoLeaf) mNext[i] = std::exchange(mOfLeaf[leaf], i);
        }
    }

    /// @param offsets  along x, 512 of the leaf
    /// @note Thread-safe for leaves of different runs along x.
    template <typename Offset>
    void moveAlongX(uint32_t leaf, const Offset* offsets)
    {
        if (mOfLeaf.empty()) return;
        for (uint32_t i = mOfLeaf[leaf], next; i != kEnd; i = next) {
            next = mNext[i];
            VoxelRef& voxel = (*mVoxels)[i];
            voxel = moved(mLayout, Axis::X, voxel, offsets[voxel.index]);
            mNext[i] = std::exchange(mMoved[voxel.leaf], i);
        }
    }

    /// Moves the queries that have come to a slab to their labels. None comes later.
    /// @note Thread-safe for different slabs.
    template <typename Power>
    void moveToCenters(uint32_t slab, const SlabLabels<Power>& labels)
    {
        if (mMoved.empty()) return;
        const LeafLayout::Slab leaves = mLayout.slab(slab);
        for (uint32_t leaf = leaves.begin; leaf < leaves.end; ++leaf) {
            for (uint32_t i = mMoved[leaf]; i != kEnd; i = mNext[i]) {
                VoxelRef& voxel = (*mVoxels)[i];
                voxel = labels.center(mLayout, voxel);
            }
        }
    }

private:
    static constexpr uint32_t kEnd = UINT32_MAX; ///< of a list

    const LeafLayout& mLayout;
    std::vector<VoxelRef>* mVoxels;
    std::vector<uint32_t> mOfLeaf; ///< the first query that waits for offsets along x
    std::vector<uint32_t> mMoved;  ///< the first one that has come to the leaf along x
    std::vector<uint32_t> mNext;   ///< of each query, in its list
};

} // namespace openvdb_spheretree::slab
