// SPDX-License-Identifier: Apache-2.0
/// @file SphereBlocks.h
/// @brief A tree of spheres laid out for vectors: the children of a node side by side in a block.
///
/// Coordinates are floats relative to an origin in doubles (QueryData.h). Every lane's sphere holds
/// the sphere that it stands for, whatever rounding did: radii are rounded up by as much as the
/// center moved. Blocks are the same on every machine; kernels work on as many lanes at a time as
/// the processor has.

#pragma once

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

constexpr int kBlockWidth = 8;

struct FloatSphere {
    float x, y, z, r;
};

/// The children of a node. Lanes in use come first.
struct alignas(4 * kBlockWidth) SphereBlock {
    float x[kBlockWidth], y[kBlockWidth], z[kBlockWidth], r[kBlockWidth];
    /// Of a lane: the block of its children; or ~leaf of a leaf, which is negative.
    int32_t child[kBlockWidth];

    FloatSphere sphere(int lane) const { return {x[lane], y[lane], z[lane], r[lane]}; }
    void set(int lane, const FloatSphere& s)
    {
        x[lane] = s.x;
        y[lane] = s.y;
        z[lane] = s.z;
        r[lane] = s.r;
    }
};

/// Lanes without a child are spheres of radius 0 so far away that nothing meets them; their squared
/// distances are still floats. All other numbers of a tree are smaller by kMostExtent.
constexpr float kEmptyLane = 1e15f;
/// The root's radius is between these, in world units.
constexpr double kMostExtent = 1e12, kLeastExtent = 1e-12;

inline bool isEmptyLane(const SphereBlock& block, int lane) { return block.x[lane] == kEmptyLane; }

/// Blocks from the root to a leaf, at most: those of the levels of a tree (64), and those that
/// a wide node is divided into (SphereForest.h).
constexpr int kMostDepth = 104;

struct SphereBlocks {
    std::vector<SphereBlock> blocks; ///< the root's children first; a block before those below it
    std::vector<int32_t> leafPlace;  ///< of each leaf: kBlockWidth * block + lane
    FloatSphere root = {};           ///< holds the spheres of blocks[0]
    /// The largest leaf below each lane of blocks[0], and of all: where bodies meet deeply these do, too.
    SphereBlock largestLeaves = {};
    int32_t largestLeaf = 0;
    int depth = 0; ///< blocks on the longest way from the root to a leaf
    /// No point of any sphere, empty lanes aside, is farther from the origin: what rounding errors are
    /// bounded by.
    float extent = 0;

    int32_t leafCount() const { return int32_t(leafPlace.size()); }
    FloatSphere leaf(int32_t i) const
    {
        return blocks[std::size_t(leafPlace[i] / kBlockWidth)].sphere(leafPlace[i] % kBlockWidth);
    }
};

} // namespace openvdb_spheretree::detail
