// SPDX-License-Identifier: Apache-2.0
/// @file MaskDifference.cc
/// @brief Leaf masks against leaf masks, tiles against whatever is there. The lower internal nodes
/// of the first mask come first; its tiles are few, and come last.

#include "MaskDifference.h"

#include "Masks.h"
#include <openvdb_spheretree/base/Parallel.h>

#include <openvdb/tools/Count.h>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Coord;
using openvdb::MaskTree;

/// The voxels of a lower node's n-th leaf, or of the tile in its place.
LeafMask leafVoxels(const LowerNode& node, openvdb::Index n)
{
    if (node.isChildMaskOn(n)) return LeafMask::from(node.getTable()[n].getChild()->getValueMask());
    return node.isValueMaskOn(n) ? LeafMask::full() : LeafMask{};
}

void append(const Coord& origin, const LeafMask& mask, std::vector<VoxelCube>& result)
{
    if (!mask.none()) result.push_back({origin, kLeafDim, mask});
}

/// A lower node minus what the other mask has there.
void subtractFromNode(const LowerNode& a, const MaskTree& b, std::vector<VoxelCube>& result)
{
    const LowerNode* other = b.probeConstNode<LowerNode>(a.origin());
    if (!other && b.isValueOn(a.origin())) return; // a tile over all of it
    for (openvdb::Index n = 0; n < LowerNode::NUM_VALUES; ++n) {
        if (!a.isChildMaskOn(n) && !a.isValueMaskOn(n)) continue;
        LeafMask mask = leafVoxels(a, n);
        if (other) mask -= leafVoxels(*other, n);
        append(a.offsetToGlobalCoord(n), mask, result);
    }
}

/// A tile of 128^3 or 4096^3 minus what the other mask has there.
void subtractFromTile(
    const Coord& origin, int32_t size, const MaskTree& b, std::vector<VoxelCube>& result)
{
    const bool isLarge = size == int32_t(UpperNode::DIM);
    if (const auto* upper = isLarge ? b.probeConstNode<UpperNode>(origin) : nullptr) {
        for (openvdb::Index n = 0; n < UpperNode::NUM_VALUES; ++n) {
            subtractFromTile(upper->offsetToGlobalCoord(n), LowerNode::DIM, b, result);
        }
    } else if (const auto* lower = isLarge ? nullptr : b.probeConstNode<LowerNode>(origin)) {
        for (openvdb::Index n = 0; n < LowerNode::NUM_VALUES; ++n) {
            append(lower->offsetToGlobalCoord(n), LeafMask::full() - leafVoxels(*lower, n), result);
        }
    } else if (!b.isValueOn(origin)) {
        result.push_back(VoxelCube::full(origin, size));
    }
}

} // namespace

int64_t VoxelCube::voxels() const
{
    if (size > kLeafDim) return int64_t(size) * size * size;
    return mask.all() ? kLeafVoxels : mask.count();
}

Coord VoxelCube::first() const
{
    for (int x = 0; x < kLeafDim && size == kLeafDim; ++x) {
        if (!mask[x]) continue;
        const int bit = int(openvdb::util::FindLowestOn(openvdb::Index64(mask[x])));
        return origin.offsetBy(x, bit >> 3, bit & 7);
    }
    return origin;
}

MaskMinus::MaskMinus(const MaskTree& a, const MaskTree& b) : mA(a), mB(b)
{
    constexpr int32_t kSize = LowerNode::DIM;
    for (auto upper = a.root().cbeginChildOn(); upper; ++upper) {
        for (auto lower = upper->cbeginChildOn(); lower; ++lower) {
            mNodes.push_back({lower->origin(), kSize, false});
        }
    }
    for (auto upper = a.root().cbeginChildOn(); upper; ++upper) {
        for (auto tile = upper->cbeginValueOn(); tile; ++tile) {
            mNodes.push_back({tile.getCoord(), kSize, true});
        }
    }
    for (auto tile = a.root().cbeginValueOn(); tile; ++tile) {
        mNodes.push_back({tile.getCoord(), int32_t(UpperNode::DIM), true});
    }
}

void MaskMinus::cubes(std::size_t index, std::vector<VoxelCube>& result) const
{
    result.clear();
    const Node& node = mNodes[index];
    if (node.tile) subtractFromTile(node.origin, node.size, mB, result);
    else subtractFromNode(*mA.probeConstNode<LowerNode>(node.origin), mB, result);
}

MaskDifference maskDifference(
    const MaskTree& a, const MaskTree& b, openvdb::util::NullInterrupter* interrupter)
{
    const MaskMinus minus(a, b);
    std::vector<std::vector<VoxelCube>> parts(minus.nodeCount());
    parallelFor(
        parts.size(), interrupter, [&](std::size_t node) { minus.cubes(node, parts[node]); });
    std::size_t count = 0;
    for (const auto& part : parts) count += part.size();
    MaskDifference result;
    result.cubes.reserve(count);
    for (auto& part : parts) {
        for (const VoxelCube& cube : part) result.voxels += cube.voxels();
        result.cubes.insert(result.cubes.end(), part.begin(), part.end());
        part = {};
    }
    return result;
}

MaskTree maskOf(const openvdb::BoolTree& tree)
{
    return MaskTree(tree, false, true, openvdb::TopologyCopy());
}

int64_t countVoxels(const MaskTree& tree)
{
    return int64_t(openvdb::tools::countActiveVoxels(tree));
}

} // namespace openvdb_spheretree::detail
