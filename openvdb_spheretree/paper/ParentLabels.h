// SPDX-License-Identifier: Apache-2.0
/// @file ParentLabels.h
/// @brief The labels of the parents of a run of voxels, 64 voxels at a time.
///
/// The coarser level has a factor^dim-th of the voxels. So all of its labels are found first, and
/// where they change (VoxelBalls). Then, for each word of a run of the finer level, the bits of up
/// to 64 parents are spread over their children (RunParents).

#pragma once

#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/medial/BallIndex.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/pyramid/PyramidModel.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace openvdb_spheretree::detail {

class RunLabels;

/// The ball that labels each voxel of a level, by rank (BallIndex.h), 4 bytes a voxel.
class VoxelBalls {
public:
    /// @param level  kept by reference
    VoxelBalls(const MedialLevel& level, openvdb::util::NullInterrupter* interrupter);

    const LeafLayout& layout() const { return mLayout; }
    const BallIndex& index() const { return mIndex; }
    /// The 512 ranks of a leaf; -1 where a voxel is off.
    const int32_t* ranks(uint32_t leaf) const
    {
        return mRanks.get() + std::size_t(leaf) * kLeafVoxels;
    }
    /// Voxels whose ball is not known to be that of the voxel before along x.
    const LeafMask& changed(uint32_t leaf) const { return mChanged[leaf]; }
    /// Voxels whose ball is known to be that of the voxel before along y, or z.
    const LeafMask& likeBeforeY(uint32_t leaf) const { return mLikeBeforeY[leaf]; }
    const LeafMask& likeBeforeZ(uint32_t leaf) const { return mLikeBeforeZ[leaf]; }

private:
    void fillLeaf(RunLabels& labels, const int32_t* before);

    const LeafLayout& mLayout;
    const BallIndex mIndex;
    LargeArray<int32_t> mRanks;
    std::vector<LeafMask> mChanged, mLikeBeforeY, mLikeBeforeZ;
};

/// The parents, along one axis, of the eight coordinates in a leaf.
struct AxisParents {
    AxisParents(const PyramidStep& step, const openvdb::Coord& origin, int axis);

    /// 0 or 1: eight neighbours lie in two leaves at most.
    int leafOf(int place) const { return (parent[place] >> 3) - (parent[0] >> 3); }

    int count = 0;
    std::array<int32_t, 8> parent{};  ///< coordinates on the coarser level, ascending
    std::array<uint8_t, 8> placeOf{}; ///< where in `parent` that of each coordinate is
};

class RunParents {
public:
    /// @param first  origin of the run's first leaf; the others have the same y and z
    RunParents(const VoxelBalls& balls, const PyramidStep& step, const openvdb::Coord& first);

    /// Moves to the parents of coordinate @a x.
    void moveTo(int32_t x);

    /// Voxels of the word whose parents are on.
    uint64_t on() const { return mOn; }
    /// Voxels whose parents may have another ball than those of the voxels before along x.
    uint64_t changed() const { return mChanged; }
    /// Voxels whose parents have the ball of the parent of the voxel before along y, or z.
    uint64_t likeBeforeY() const { return mLikeBeforeY; }
    uint64_t likeBeforeZ() const { return mLikeBeforeZ; }
    /// The rank of the ball that labels the parent of the voxel at bit @a lane, where that is on.
    int32_t rank(uint32_t lane) const
    {
        return mBalls.ranks(*mLeaves[mLeafOf[lane]])[64 * uint32_t(*mX & 7) + mIndexOf[lane]];
    }

private:
    template <typename MaskOf>
    uint64_t spread(const MaskOf& maskOf) const;

    const VoxelBalls& mBalls;
    const AxisParents mAlongY, mAlongZ;
    std::array<uint64_t, 8> mRows{};     ///< per parent along y: bit 8 y of its children
    std::array<uint8_t, 256> mColumns{}; ///< bits of parents along z to bits of their children
    uint64_t mInnerY = 0,
             mInnerZ = 0; ///< voxels that share the parent of the one before along y, z
    std::array<uint8_t, 64> mLeafOf{};   ///< of mLeaves, for each voxel's parent
    std::array<uint16_t, 64> mIndexOf{}; ///< there, from the first voxel of equal x
    /// The leaves that lie side by side along y and z, where there are any.
    std::array<std::optional<uint32_t>, 4> mLeaves;
    std::optional<int32_t> mX;
    uint64_t mOn = 0, mChanged = 0, mLikeBeforeY = 0, mLikeBeforeZ = 0;
};

} // namespace openvdb_spheretree::detail
