// SPDX-License-Identifier: Apache-2.0
/// @file UncoveredVoxels.h
/// @brief The voxels of an object that no ball of a growing set holds yet, and how many of them a
/// further ball would cover.
///
/// A medial ball lies inside the object, so the leaves it reaches into are there and hang together:
/// from the leaf of its center they are found along x, then along y, then along z, where they stand
/// next to one another in the layout. No tree is searched. A leaf wholly inside the ball counts as
/// a number; the others as eight mask words (LeafBall.h).
///
/// Exact. Cost: linear in the leaves that a ball reaches into; 70 bytes a leaf. Tests:
/// TestInnerTree.cc.

#pragma once

#include <openvdb_spheretree/medial/MedialAxis.h>
#include <openvdb_spheretree/sphere/LeafVoxels.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

/// Counting is thread-safe while nobody covers.
class UncoveredVoxels {
public:
    /// @param layout  of the object; has to live longer
    /// @param dim     2: balls are discs across z
    UncoveredVoxels(const LeafLayout& layout, int dim);

    /// @return how many voxels are left.
    int64_t left() const { return mLeft; }
    /// @return how many of them @a ball holds, which must lie inside the object.
    int64_t countIn(const MedialBall& ball) const;
    /// Takes away those that @a ball holds, at time @a now, which never falls.
    void cover(const MedialBall& ball, uint32_t now);
    /// @return false only if no voxel of @a ball was taken away after @a then.
    bool mayHaveChanged(const MedialBall& ball, uint32_t then) const;

private:
    /// Calls visit(leaf, whether all of it is inside) until that is false.
    template <typename Visit>
    void visitLeaves(const MedialBall& ball, const Visit& visit) const;
    LeafMask partInside(const MedialBall& ball, uint32_t leaf) const
    {
        const int64_t closedSq = int64_t(ball.radiusSq) - 1; // in voxels
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

} // namespace detail
} // namespace openvdb_spheretree
