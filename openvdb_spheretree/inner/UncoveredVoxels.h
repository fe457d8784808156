// SPDX-License-Identifier: Apache-2.0
/// @file UncoveredVoxels.h
/// @brief The voxels of an object that no ball of a growing set holds yet, and how many of them a
/// further ball would cover.
///
/// A medial ball lies inside the object, so all leaves that it reaches into exist and touch. They are
/// found from the leaf of its center, along x, then along y, then along z, where they follow one
/// another in the layout. No tree is searched. For a leaf wholly inside the ball there is a count, for
/// others a mask (LeafBall.h).
///
/// Exact. Cost: linear in the leaves that a ball reaches into; 70 bytes a leaf. Tests:
/// TestInnerTree.cc.

#pragma once

#include <openvdb_spheretree/sphere/LeafVoxels.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/MedialBall.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// Counting is thread-safe while nobody covers.
class UncoveredVoxels {
public:
    /// @param layout  of the object; has to live longer
    /// @param dim     2: balls are discs across z
    UncoveredVoxels(const LeafLayout& layout, int dim);

    /// @return how many voxels no ball holds yet.
    int64_t left() const { return mLeft; }
    /// @return how many of them @a ball holds, which must lie inside the object.
    int64_t countIn(const MedialBall& ball) const;
    /// Removes those that @a ball holds, at time @a now, which never falls.
    void cover(const MedialBall& ball, uint32_t now);
    /// @return false only if no voxel of @a ball was removed after @a then.
    bool mayHaveChanged(const MedialBall& ball, uint32_t then) const;

private:
    /// Calls visit(leaf, whether all of it is inside) for the leaves of a ball until it returns false.
    template <typename Visit>
    void visitLeaves(const MedialBall& ball, const Visit& visit) const;
    LeafMask partInside(const MedialBall& ball, uint32_t leaf) const
    {
        const int64_t closedSq = int64_t(ball.radiusSq) - 1; // voxels
        return voxelsOf(
            ExactSphere::around(ball.center, 4 * closedSq), /*shift=*/1, mLayout.origin(leaf));
    }

    const LeafLayout& mLayout;
    int mDim;
    int64_t mLeft;
    std::vector<LeafMask> mMasks;
    std::vector<uint16_t> mCounts;    ///< of bits in them
    std::vector<uint32_t> mChangedAt; ///< by leaf; 0: never
};

} // namespace openvdb_spheretree::detail
