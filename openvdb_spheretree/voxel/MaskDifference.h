// SPDX-License-Identifier: Apache-2.0
/// @file MaskDifference.h
/// @brief The voxels of one mask that another has not, node by node.

#pragma once

#include "Masks.h"

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

/// A cube of 8, 128 or 4096 voxels a side with voxels in it: of 8, those of the words (word x, bit
/// 8 y + z); of more, all.
struct VoxelCell {
    openvdb::Coord origin;
    int32_t size = 8;
    uint64_t words[8] = {};

    int64_t voxels() const;
    /// @return the first voxel, x slowest.
    openvdb::Coord first() const;
};

/// What one mask has and another has not, node by node of the first: nodes of 128 and larger tiles.
/// Nothing of it is in memory; a node's cells are made when they are asked for.
class MaskMinus {
public:
    /// Both are kept by reference.
    MaskMinus(const openvdb::MaskTree& a, const openvdb::MaskTree& b);

    std::size_t nodeCount() const { return mNodes.size(); }
    /// @param result  becomes the cells of a node, each with voxels in it, those of a block of 128
    ///                together. Tiles are compared as tiles: one is descended only where the other
    ///                mask has nodes.
    void cells(std::size_t node, std::vector<VoxelCell>& result) const;

private:
    /// A node of 128, or a tile.
    struct Node {
        openvdb::Coord origin;
        int32_t size;
        bool tile;
    };

    const openvdb::MaskTree &mA, &mB;
    std::vector<Node> mNodes;
};

struct MaskDifference {
    int64_t voxels = 0;
    std::vector<VoxelCell> cells; ///< in node order of the first mask
};

/// @return a \ b, as it comes from MaskMinus.
MaskDifference maskDifference(const openvdb::MaskTree& a, const openvdb::MaskTree& b,
    openvdb::util::NullInterrupter* interrupter);

/// @return the topology of @a tree as a mask.
openvdb::MaskTree maskOf(const openvdb::BoolTree& tree);

/// @return the number of active voxels.
int64_t countVoxels(const openvdb::MaskTree& tree);

} // namespace detail
} // namespace openvdb_spheretree
