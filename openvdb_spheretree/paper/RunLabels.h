// SPDX-License-Identifier: Apache-2.0
/// @file RunLabels.h
/// @brief The power labels of a run of leaves along x, as ranks of balls (BallIndex.h), 64 voxels
/// at a time.
///
/// Neighbours along x whose offsets along x lead to the same voxel have one label: it is looked up
/// once. Exact for any voxels, and however the labels are kept.

#pragma once

#include <openvdb_spheretree/kernel/LaneBits.h>
#include <openvdb_spheretree/medial/BallIndex.h>
#include <openvdb_spheretree/medial/PowerMap.h>

#include <array>
#include <cstdint>

namespace openvdb_spheretree::detail {

class RunLabels {
public:
    /// @param balls  those of the labels' level; both are kept by reference
    RunLabels(const PowerMap& labels, const BallIndex& balls, const LeafLayout::Run& run)
        : mLabels(labels), mBalls(balls), mRun(run)
    {}

    /// Moves to leaf @a i of the run; leaves come one after the other from i = 0.
    void enterLeaf(uint32_t i);

    /// Moves to word @a x of the leaf; words come one after the other.
    /// @return the voxels that are on and may have another ball than those before them along x
    uint64_t enterWord(uint32_t x)
    {
        const uint64_t on = layout().mask(leaf())[x];
        const uint64_t fresh = on & ~(mOn & mRepeats[x]);
        if (fresh) findRanks(x, fresh);
        mOn = on;
        return fresh;
    }

    const LeafLayout& layout() const { return mLabels.layout(); }
    uint32_t leaf() const { return mRun.leaves[mPlace]; }
    /// The voxels of the word that are on.
    uint64_t on() const { return mOn; }
    /// Those that have the ball of the voxel before them along y, or z, which is on.
    LikeBefore likeBefore() const
    {
        const LikeBefore like = detail::likeBefore(mRanks.data() + kLaneMargin);
        return {like.alongY & mOn & mOn << 8, like.alongZ & mOn & mOn << 1};
    }
    /// The rank of the ball that labels the voxel at bit @a lane of the word, which is on.
    int32_t rank(uint32_t lane) const { return mRanks[kLaneMargin + lane]; }

    /// The rank of the label of the voxel at bit @a lane of word @a x of the leaf, looked up.
    int32_t rankAt(uint32_t x, uint32_t lane) const
    {
        if (!mOffsets) return mBalls.rankAt(mLabels.label({leaf(), 64 * x + lane}));
        const int onLine = kLeafDim * int(mPlace) + int(x) + mOffsets[64 * x + lane];
        const VoxelRef onX{mRun.leaves[onLine >> 3], uint32_t(onLine & 7) << 6 | lane};
        const VoxelRef onY = narrowTarget(Axis::Y, onX);
        return mBalls.rankAt(mLabels.usesZ() ? narrowTarget(Axis::Z, onY) : onY);
    }

private:
    void findRanks(uint32_t x, uint64_t bits);
    void prefetch(uint32_t i) const;
    /// PowerMap::target() without a branch: whether it lies in another leaf is hard to predict.
    VoxelRef narrowTarget(Axis axis, VoxelRef voxel) const
    {
        const int8_t* offsets = mLabels.narrowOffsets(axis, voxel.leaf);
        const Target target = targetOf(axis, voxel.index, offsets[voxel.index]);
        return {layout().neighbour(voxel.leaf, axis, target.leaves), target.index};
    }

    const PowerMap& mLabels;
    const BallIndex& mBalls;
    const LeafLayout::Run mRun;
    uint32_t mPlace = 0;              ///< of the leaf in the run
    const int8_t* mOffsets = nullptr; ///< of the leaf, along x; null where they are wider, or none
    LeafMask mRepeats{};              ///< of the target of the voxel before; undefined where off
    uint64_t mOn = 0;                 ///< of the word
    std::array<int32_t, kLaneMargin + 64> mRanks{};
};

} // namespace openvdb_spheretree::detail
