// SPDX-License-Identifier: Apache-2.0
/// @file LabelQueries.h
/// @brief The voxels whose labels are asked for, on their way there.
///
/// A voxel first waits in the list of its leaf. When the leaf's steps along x are known, it moves
/// to where they lead, and waits in a list of that leaf for the other two. Both leaves are in one
/// run, so threads that look at different runs have nothing to do with each other. Lists are chains
/// of numbers: a question is in one at a time.
///
/// Cost: 8 bytes a leaf, if anything is asked, and 4 a question.

#pragma once

#include "SlabLabels.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/voxel/VoxelRef.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

namespace openvdb_spheretree {
namespace slab {

/// The leaf of a voxel that is off.
constexpr uint32_t kNoLeaf = UINT32_MAX;

class Questions {
public:
    /// @param layout  kept by reference
    /// @param asked   each becomes its label; those in kNoLeaf stay; may be null
    Questions(const LeafLayout& layout, std::vector<VoxelRef>* asked)
        : mLayout(layout), mAsked(asked)
    {
        if (!asked || asked->empty()) return;
        assert(asked->size() < kEnd);
        mOfLeaf.assign(layout.leafCount(), kEnd);
        mMoved.assign(layout.leafCount(), kEnd);
        detail::resizeLarge(mNext, asked->size());
        for (uint32_t i = 0; i < mNext.size(); ++i) {
            const uint32_t leaf = (*asked)[i].leaf;
            if (leaf != kNoLeaf) mNext[i] = std::exchange(mOfLeaf[leaf], i);
        }
    }

    /// @param steps  along x, 512 of the leaf
    /// @note Thread-safe for leaves of different runs along x.
    template <typename Step>
    void moveAlongX(uint32_t leaf, const Step* steps)
    {
        if (mOfLeaf.empty()) return;
        for (uint32_t i = mOfLeaf[leaf], next; i != kEnd; i = next) {
            next = mNext[i];
            VoxelRef& voxel = (*mAsked)[i];
            voxel = moved(mLayout, Axis::X, voxel, steps[voxel.index]);
            mNext[i] = std::exchange(mMoved[voxel.leaf], i);
        }
    }

    /// Moves on the voxels that have come to a slab, after all have that will.
    /// @note Thread-safe for different slabs.
    template <typename Power>
    void moveToCenters(uint32_t slab, const SlabLabels<Power>& labels)
    {
        if (mMoved.empty()) return;
        const LeafLayout::Slab leaves = mLayout.slab(slab);
        for (uint32_t leaf = leaves.begin; leaf < leaves.end; ++leaf) {
            for (uint32_t i = mMoved[leaf]; i != kEnd; i = mNext[i]) {
                VoxelRef& voxel = (*mAsked)[i];
                voxel = labels.center(mLayout, voxel);
            }
        }
    }

private:
    static constexpr uint32_t kEnd = UINT32_MAX; ///< of a list

    const LeafLayout& mLayout;
    std::vector<VoxelRef>* mAsked;
    std::vector<uint32_t> mOfLeaf; ///< the first one that waits for a leaf's steps along x
    std::vector<uint32_t> mMoved;  ///< the same, for those along y and z
    std::vector<uint32_t> mNext;   ///< in the list that a question is in
};

} // namespace slab
} // namespace openvdb_spheretree
