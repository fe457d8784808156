// SPDX-License-Identifier: Apache-2.0
/// @file SphereBlocks.h
/// @brief Spheres sorted into the cubic cells of OpenVDB's nodes: which ones reach into which cell of
/// 4096^3 voxels, and in there of 128^3. Exact. Cost: some hundred bytes a sphere, and four for each
/// pair of a sphere and a cell; time likewise.

#pragma once

#include "ClippedSphere.h"
#include <openvdb_spheretree/base/LargeArray.h>

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

constexpr int kRootCellLog2 = 12;

/// Where the object that spheres are confined to has anything; everywhere if there is none.
class Wanted {
public:
    /// @param tree  kept; may be null
    explicit Wanted(const openvdb::MaskTree* tree);

    bool everywhere() const { return !mTree; }
    /// @return the origins of the root's cells that have something, in order.
    const std::vector<openvdb::Coord>& rootCells() const { return mRootCells; }
    bool hasRootCell(const openvdb::Coord& origin) const;
    /// @return whether there is anything in the node at @a origin.
    template <typename NodeType>
    bool has(const openvdb::Coord& origin) const
    {
        return !mTree || mTree->probeConstNode<NodeType>(origin) || mTree->isValueOn(origin);
    }

private:
    const openvdb::MaskTree* mTree;
    std::vector<openvdb::Coord> mRootCells;
};

/// Spheres with the boxes of their voxels.
struct ClippedSpheres {
    LargeArray<ClippedSphere> balls; ///< a ball each; undefined where a box is empty
    /// All others: larger balls first, largest to smallest, since what they fill is not drawn again.
    /// The small ones (BlockCanvas::isSmall) are in the order of spheres, which is mostly that of
    /// their centres, and so kind to caches.
    std::vector<int32_t> order;
};

/// A cell of 128^3 voxels.
struct Block {
    openvdb::Coord origin;
    bool full = false;          ///< a sphere holds all of it
    std::vector<int32_t> balls; ///< that reach into it, unless it is full
};

struct SphereBlocks {
    std::vector<openvdb::Coord> fullRootCells; ///< which a sphere holds all of
    std::vector<Block> blocks;                 ///< in all others; root cell by root cell
};

/// Parallel. Spheres without a voxel in @a clip are not in the order.
ClippedSpheres clipSpheres(const std::vector<ExactSphere>& spheres, const SphereMetric& metric,
    const openvdb::CoordBBox& clip, openvdb::util::NullInterrupter* interrupter);

/// Parallel; the result does not depend on threads.
SphereBlocks sortIntoBlocks(const ClippedSpheres& spheres, const Wanted& wanted,
    openvdb::util::NullInterrupter* interrupter);

} // namespace detail
} // namespace openvdb_spheretree
