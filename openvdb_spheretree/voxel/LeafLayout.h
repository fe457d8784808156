// SPDX-License-Identifier: Apache-2.0
/// @file LeafLayout.h
/// @brief One level's voxels as flat arrays: its 8x8x8 leaves in order, their masks, and the runs
/// of adjacent leaves along each axis.
///
/// The separable transforms work on lines of voxels. A line is cut wherever the leaves along it
/// have a gap, because a gap is background and no value crosses background (docs/algorithm.md,
/// "Why sparse storage loses nothing"). So the unit of work is a *run*: leaves that touch, one
/// behind the other along an axis. A run holds 64 lines side by side. Nothing is stored outside the
/// leaves of a level, and no tree is searched while a transform runs.
///
/// Leaves of equal x make a *slab*. Lines along y and z lie in one slab, so slabs are independent
/// of each other but for the passes along x.
///
/// Cost: O(leaves log leaves) to build, 100 bytes a leaf. A tile of the tree becomes the leaves it
/// stands for.

#pragma once

#include "LeafMask.h"
#include "Masks.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace openvdb_spheretree {

enum class Axis { X, Y, Z };

class LeafLayout {
public:
    /// Leaves that touch along an axis, first to last.
    struct Run {
        const uint32_t* leaves;
        uint32_t count;
    };

    /// @throw openvdb::ValueError if leaves exceed 2^31, or the memory
    explicit LeafLayout(const openvdb::MaskTree& level);
    /// @throw openvdb::ValueError if that would, before anything is allocated
    static void requireRoom(const openvdb::MaskTree& level);

    uint32_t leafCount() const { return uint32_t(mOrigins.size()); }
    /// @return the memory that it takes.
    int64_t bytes() const { return 100 * int64_t(leafCount()); }
    int64_t voxelCount() const { return mVoxelCount; }

    /// Leaves are numbered in the order of their origins (x first).
    const openvdb::Coord& origin(uint32_t leaf) const { return mOrigins[leaf]; }
    const LeafMask& mask(uint32_t leaf) const { return mMasks[leaf]; }
    const std::vector<LeafMask>& masks() const { return mMasks; }

    /// The leaves of equal x, in the order of their x: [begin, end).
    struct Slab {
        uint32_t begin, end;
        uint32_t size() const { return end - begin; }
    };
    uint32_t slabCount() const { return uint32_t(mSlabBegin.size()) - 1; }
    Slab slab(uint32_t index) const { return {mSlabBegin[index], mSlabBegin[index + 1]}; }
    /// @return the slab that a leaf is in; O(log slabs).
    uint32_t slabOf(uint32_t leaf) const;
    /// @return the runs along y or z that lie in a slab: their leaves are the slab's.
    Slab runsOfSlab(Axis axis, uint32_t index) const
    {
        const std::vector<uint32_t>& begin = mLines[int(axis)].slabBegin;
        return {begin[index], begin[index + 1]};
    }

    uint32_t runCount(Axis axis) const { return uint32_t(mLines[int(axis)].runBegin.size()) - 1; }
    Run run(Axis axis, uint32_t index) const
    {
        const Lines& lines = mLines[int(axis)];
        const uint32_t begin = lines.runBegin[index];
        return {lines.leaves.data() + begin, lines.runBegin[index + 1] - begin};
    }

    /// @return the coordinates of a voxel of a leaf, by leafIndex().
    openvdb::Coord voxel(uint32_t leaf, uint32_t offset) const
    {
        return leafVoxel(mOrigins[leaf], offset);
    }

    /// @return the leaf @a steps leaves further along @a axis; it must be in the same run.
    uint32_t neighbour(uint32_t leaf, Axis axis, int steps) const
    {
        const Lines& lines = mLines[int(axis)];
        return lines.leaves[lines.position[leaf] + steps];
    }

    /// @return the leaf that holds voxel @a ijk, on or off, if there is one; O(log leaves).
    std::optional<uint32_t> findLeaf(const openvdb::Coord& ijk) const;

private:
    /// The leaves in the order of their lines along one axis.
    struct Lines {
        std::vector<uint32_t> leaves;    ///< by line, then along it
        std::vector<uint32_t> position;  ///< of each leaf in `leaves`
        std::vector<uint32_t> runBegin;  ///< where runs start in `leaves`, and its size at the end
        std::vector<uint32_t> slabBegin; ///< where slabs start in `runBegin`, not along x
    };

    void collectLeaves(const openvdb::MaskTree& level);
    void orderAlongX();
    void orderAlongY();
    void cutRuns(Axis axis);

    std::vector<openvdb::Coord> mOrigins;
    std::vector<LeafMask> mMasks;
    std::vector<uint32_t> mSlabBegin;
    std::array<Lines, 3> mLines;
    int64_t mVoxelCount = 0;
};

} // namespace openvdb_spheretree
