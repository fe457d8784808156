// SPDX-License-Identifier: Apache-2.0
#include "VoxelRule.h"

#include <openvdb_spheretree/base/Parallel.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::BoolTree;
using openvdb::Coord;
using openvdb::CoordBBox;

/// Calls f(cube) for the cubes of a lattice that meet both boxes, in the order of their
/// coordinates.
/// @param side  of the cubes: a power of two
template <typename F>
void forEachCube(CoordBBox box, const CoordBBox& bounds, int side, const F& f)
{
    box.intersect(bounds);
    const Coord first = box.min() & ~(side - 1), &last = box.max();
    for (int x = first[0]; x <= last[0]; x += side) {
        for (int y = first[1]; y <= last[1]; y += side) {
            for (int z = first[2]; z <= last[2]; z += side) {
                f(CoordBBox::createCube(Coord(x, y, z), side));
            }
        }
    }
}

/// @return the voxels of the leaf at @a origin that lie in the box.
LeafMask voxelsInBox(const Coord& origin, const CoordBBox& box)
{
    const auto isIn = [&](int axis, int i) {
        return origin[axis] + i >= box.min()[axis] && origin[axis] + i <= box.max()[axis];
    };
    uint64_t row = 0, plane = 0;
    for (int z = 0; z < kLeafDim; ++z) row |= uint64_t(isIn(2, z)) << z;
    for (int y = 0; y < kLeafDim; ++y) plane |= (isIn(1, y) ? row : 0) << (8 * y);
    LeafMask mask;
    for (int x = 0; x < kLeafDim; ++x) mask[x] = isIn(0, x) ? plane : 0;
    return mask;
}

/// @return the origins of the nodes to be painted; full ones have become tiles of @a tree. Their
/// levels are as OpenVDB counts them: 3 is a tile of 4096^3 voxels, 2 of 128^3, 1 of 8^3.
std::vector<Coord> tilesAndParts(
    const VoxelRule& shape, BoolTree& tree, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<Coord> parts;
    const CoordBBox box = shape.box();
    forEachCube(box, box, BoolUpperNode::DIM, [&](const CoordBBox& upper) {
        checkInterrupt(interrupter);
        const Filling inUpper = shape.filling(upper);
        if (inUpper == Filling::All) tree.addTile(3, upper.min(), true, true);
        if (inUpper != Filling::Part) return;
        forEachCube(upper, box, BoolLowerNode::DIM, [&](const CoordBBox& lower) {
            const Filling inLower = shape.filling(lower);
            if (inLower == Filling::All) tree.addTile(2, lower.min(), true, true);
            if (inLower == Filling::Part) parts.push_back(lower.min());
        });
    });
    return parts;
}

} // namespace

Filling VoxelRule::filling(const CoordBBox&) const { return Filling::Part; }

void LeafwiseRule::paint(BoolLowerNode& node) const
{
    const CoordBBox bounds = box();
    const CoordBBox cube = CoordBBox::createCube(node.origin(), BoolLowerNode::DIM);
    forEachCube(cube, bounds, kLeafDim, [&](const CoordBBox& voxels) {
        const Coord& origin = voxels.min();
        const Filling inLeaf = filling(voxels);
        if (inLeaf == Filling::All) node.addTile(1, origin, true, true);
        if (inLeaf == Filling::Part) {
            addLeaf(node, origin, leaf(origin) & voxelsInBox(origin, bounds));
        }
    });
}

void addLeaf(BoolLowerNode& node, const Coord& origin, const LeafMask& mask)
{
    if (mask.none()) return;
    auto leaf = std::make_unique<BoolTree::LeafNodeType>(origin, false);
    std::copy(mask.begin(), mask.end(), leaf->buffer().data()); // values are bits as well
    mask.copyTo(leaf->getValueMask());
    node.addLeaf(leaf.release());
}

BoolTree::Ptr treeOf(const VoxelRule& shape, openvdb::util::NullInterrupter* interrupter)
{
    const auto tree = std::make_shared<BoolTree>(false);
    const std::vector<Coord> origins = tilesAndParts(shape, *tree, interrupter);
    std::vector<std::unique_ptr<BoolLowerNode>> nodes(origins.size()); // null where empty
    parallelFor(origins.size(), interrupter, [&](std::size_t i) {
        auto node = std::make_unique<BoolLowerNode>(origins[i], false);
        shape.paint(*node);
        if (!node->isInactive()) nodes[i] = std::move(node);
    });
    for (auto& node : nodes) {
        if (!node) continue;
        auto* upper = tree->probeNode<BoolUpperNode>(node->origin());
        if (!upper) {
            upper = new BoolUpperNode(node->origin(), false);
            tree->root().addChild(upper);
        }
        upper->addChild(node.release());
    }
    return tree;
}

} // namespace openvdb_spheretree::detail
