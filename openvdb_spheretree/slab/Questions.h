// SPDX-License-Identifier: Apache-2.0
/// @file slab/Questions.h
/// @brief The voxels whose labels are asked for, on their way there.
///
/// A voxel first waits in the list of its leaf. When the leaf's steps along x are known, it moves
/// to where they lead, and waits in the list of that slab for the other two. Lists are chains of
/// numbers: a question is in one at a time.
///
/// Cost: 4 bytes a leaf, if anything is asked, and 4 a question.

#pragma once

#include "../LeafLayout.h"
#include "../PowerMap.h"
#include "SlabLabels.h"

#include <atomic>
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
    Questions(const LeafLayout& layout, std::vector<PowerMap::Voxel>* asked)
        : mLayout(layout), mAsked(asked)
    {
        if (!asked || asked->empty()) return;
        assert(asked->size() < kEnd);
        mOfLeaf.assign(layout.leafCount(), kEnd);
        mOfSlab = std::vector<std::atomic<uint32_t>>(layout.slabCount());
        for (auto& first : mOfSlab) first = kEnd;
        mNext.resize(asked->size());
        for (uint32_t i = 0; i < mNext.size(); ++i) {
            const uint32_t leaf = (*asked)[i].leaf;
            if (leaf != kNoLeaf) mNext[i] = std::exchange(mOfLeaf[leaf], i);
        }
    }

    /// @param steps  along x, 512 of the leaf
    /// @note Thread-safe for different leaves.
    template <typename Step>
    void moveAlongX(uint32_t leaf, const Step* steps)
    {
        if (mOfLeaf.empty()) return;
        for (uint32_t i = mOfLeaf[leaf], next; i != kEnd; i = next) {
            next = mNext[i];
            PowerMap::Voxel& voxel = (*mAsked)[i];
            voxel = PowerMap::moved(mLayout, Axis::X, voxel, steps[voxel.offset]);
            mNext[i] = mOfSlab[mLayout.slabOf(voxel.leaf)].exchange(i);
        }
    }

    /// Moves on the voxels that have come to a slab, after all have that will.
    /// @note Thread-safe for different slabs.
    template <typename Power>
    void moveToCenters(uint32_t slab, const SlabLabels<Power>& labels)
    {
        if (mOfSlab.empty()) return;
        for (uint32_t i = mOfSlab[slab]; i != kEnd; i = mNext[i]) {
            PowerMap::Voxel& voxel = (*mAsked)[i];
            voxel = labels.center(mLayout, voxel);
        }
    }

private:
    static constexpr uint32_t kEnd = UINT32_MAX; ///< of a list

    const LeafLayout& mLayout;
    std::vector<PowerMap::Voxel>* mAsked;
    std::vector<uint32_t> mOfLeaf;              ///< the first one
    std::vector<std::atomic<uint32_t>> mOfSlab; ///< the same
    std::vector<uint32_t> mNext;                ///< in the list that a question is in
};

} // namespace slab
} // namespace openvdb_spheretree
