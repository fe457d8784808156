// SPDX-License-Identifier: Apache-2.0
/// @file MaskDifference.h
/// @brief The voxels of one mask that another has not, node by node.

#pragma once

#include "LeafMask.h"
#include "Masks.h"

#include <openvdb/util/NullInterrupter.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// A cube of 8, 128 or 4096 voxels a side, and which of its voxels are in a set.
struct VoxelCube {
    openvdb::Coord origin;
    int32_t size = kLeafDim;
    LeafMask mask{}; ///< of a cube of 8; larger cubes have all their voxels

    static VoxelCube full(const openvdb::Coord& origin, int32_t size)
    {
        return {origin, size, LeafMask::full()};
    }
    /// @return an eighth of a cube of 16 or more, 0 to 7 in the order x, y, z.
    VoxelCube eighth(int i) const
    {
        const int32_t half = size / 2;
        return full(origin.offsetBy(i & 4 ? half : 0, i & 2 ? half : 0, i & 1 ? half : 0), half);
    }
    int64_t voxels() const;
    /// @return the first voxel, x slowest.
    openvdb::Coord first() const;
};

/// What one mask has and another has not, by nodes of the first: its lower internal nodes, and its
/// tiles of 128 or more. Nothing is stored; the cubes of a node are made when they are read.
class MaskMinus {
public:
    /// Both are kept by reference.
    MaskMinus(const openvdb::MaskTree& a, const openvdb::MaskTree& b);

    std::size_t nodeCount() const { return mNodes.size(); }
    /// @return the box of a node, all of it.
    openvdb::CoordBBox box(std::size_t node) const
    {
        return openvdb::CoordBBox::createCube(mNodes[node].origin, mNodes[node].size);
    }
    /// @param result  becomes the cubes of a node, none of them empty. A tile is cut up only where
    ///                the other mask has nodes.
    void cubes(std::size_t node, std::vector<VoxelCube>& result) const;

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
    std::vector<VoxelCube> cubes; ///< in node order of the first mask
};

/// @return a \ b, as it comes from MaskMinus.
MaskDifference maskDifference(const openvdb::MaskTree& a, const openvdb::MaskTree& b,
    openvdb::util::NullInterrupter* interrupter);

/// @return the topology of @a tree as a mask.
openvdb::MaskTree maskOf(const openvdb::BoolTree& tree);

/// @return the number of active voxels.
int64_t countVoxels(const openvdb::MaskTree& tree);

} // namespace openvdb_spheretree::detail
