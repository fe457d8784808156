// SPDX-License-Identifier: Apache-2.0
/// @file SphereNodes.h
/// @brief Which spheres reach into which upper internal node of OpenVDB's, of 4096^3 voxels, and in
/// there into which lower one of 128^3. Exact. Cost: some hundred bytes a sphere, and four for each
/// pair of a sphere and a node.

#pragma once

#include "ClippedSphere.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/voxel/MaskTree.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

constexpr int kUpperLog2 = 12; ///< of an upper node's side

/// The object that drawing is confined to: nodes where it has nothing are left out.
class ClipMask {
public:
    /// @param tree  kept; if null, nothing is left out
    explicit ClipMask(const openvdb::MaskTree* tree);

    bool everywhere() const { return !mTree; }
    /// @return the origins of the upper nodes, and of tiles as large, that the object has, in
    ///         order.
    const std::vector<openvdb::Coord>& upperNodes() const { return mUpperNodes; }
    bool hasUpperNode(const openvdb::Coord& origin) const;
    /// @return whether the object has anything in the lower node at @a origin.
    bool hasLowerNode(const openvdb::Coord& origin) const
    {
        return !mTree || mTree->probeConstNode<LowerNode>(origin) || mTree->isValueOn(origin);
    }
    using Leaves = LowerNode::NodeMaskType; ///< a bit for each leaf of a lower node
    /// @return the leaves, and tiles as large, where the object has anything.
    Leaves leavesOf(const openvdb::Coord& lowerNode) const;

private:
    const openvdb::MaskTree* mTree;
    std::vector<openvdb::Coord> mUpperNodes;
};

/// Spheres with the boxes of their voxels.
struct ClippedSpheres {
    LargeArray<ClippedSphere> balls; ///< a ball each; undefined where a box is empty
    /// All others: larger balls first, largest to smallest, since what they fill is not drawn
    /// again. The small ones (NodeCanvas::isSmall) are in the order of spheres, which is mostly
    /// that of their centers, and so kind to caches.
    std::vector<int32_t> order;
};

/// The spheres that reach into a node.
struct NodeSpheres {
    openvdb::Coord origin;
    bool full = false;          ///< a sphere holds all of the node
    std::vector<int32_t> balls; ///< by index, unless the node is full
};

struct SphereNodes {
    std::vector<openvdb::Coord> fullUpperNodes; ///< origins
    std::vector<NodeSpheres> lowerNodes; ///< of all other upper nodes, one upper node's together
};

/// Parallel. Spheres without a voxel in @a clip are not in the order.
ClippedSpheres clipSpheres(const std::vector<ExactSphere>& spheres, const SphereMetric& metric,
    const openvdb::CoordBBox& clip, openvdb::util::NullInterrupter* interrupter);

/// Parallel; the result does not depend on threads.
SphereNodes sortIntoNodes(const ClippedSpheres& spheres, const ClipMask& clipMask,
    openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
