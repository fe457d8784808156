// SPDX-License-Identifier: Apache-2.0
/// @file VoxelRule.h
/// @brief A shape given by a rule, and the tree of its voxels. Nodes that are full become tiles.
///
/// 1. `tilesAndParts`: full nodes of 4096^3 and of 128^3 voxels become tiles; nodes of 128^3 that
///    may hold a part of the shape are listed.
/// 2. VoxelRule::paint() fills these in parallel.
/// 3. Those that are not empty go into the tree, in their order.
///
/// Cost: a call of filling() for every node of the box, and one of leaf() for every leaf that may
/// be neither full nor empty. Memory: the tree, and 20 bytes for each node of 128^3.

#pragma once

#include <openvdb_spheretree/voxel/LeafMask.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>

namespace openvdb_spheretree::detail {

/// How much of a cube is on.
enum class Filling {
    None,
    Part, ///< or not known
    All
};

/// A shape. Many threads call it at once. All coordinates are voxels.
class VoxelRule {
public:
    virtual ~VoxelRule() = default;

    /// @return a box that holds the whole shape; inclusive.
    virtual openvdb::CoordBBox box() const = 0;

    /// @param cube  the voxels of a node (4096^3, 128^3 or 8^3); it may reach beyond box()
    virtual Filling filling(const openvdb::CoordBBox& cube) const;

    /// Adds the shape's leaves and tiles to @a node, which is empty.
    virtual void paint(BoolLowerNode& node) const = 0;
};

/// A shape whose leaves do not depend on each other.
class LeafwiseRule : public VoxelRule {
public:
    /// @return the voxels of the leaf at @a origin; those beyond box() do not count.
    virtual LeafMask leaf(const openvdb::Coord& origin) const = 0;

    void paint(BoolLowerNode& node) const final;
};

/// Adds a leaf of these voxels, unless there are none.
void addLeaf(BoolLowerNode& node, const openvdb::Coord& origin, const LeafMask& mask);

/// @return the tree of the shape's voxels: on and true; the background is off and false.
/// @throw Interrupted if the interrupter (may be null) said so
openvdb::BoolTree::Ptr treeOf(const VoxelRule& shape, openvdb::util::NullInterrupter* interrupter);

/// @brief Of the boxes at the origin whose sides differ by one at most, the one that holds nearest to
/// a number of a shape's voxels.
/// @param voxels  1 or more
/// @param count   count(sides): how many voxels the shape has in the box of these sides; never
///                less in a larger box, and without bound
/// @return the voxels of the box
template <typename Count>
openvdb::CoordBBox nearCubeOf(int64_t voxels, const Count& count)
{
    // The sides grow by one in turn: n n n, n+1 n n, n+1 n+1 n, ...
    const auto sides = [](int n) { return openvdb::Coord((n + 2) / 3, (n + 1) / 3, n / 3); };
    int low = 0, high = 3; // count(low) < voxels <= count(high), once found
    while (count(sides(high)) < voxels) low = high, high *= 2;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        (count(sides(middle)) < voxels ? low : high) = middle;
    }
    const int64_t missing = voxels - count(sides(low));
    const bool lowIsNearer = missing < count(sides(high)) - voxels;
    return {openvdb::Coord(0), sides(lowIsNearer ? low : high).offsetBy(-1)};
}

} // namespace openvdb_spheretree::detail
