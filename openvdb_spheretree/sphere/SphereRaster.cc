// SPDX-License-Identifier: Apache-2.0
/// @file SphereRaster.cc
/// @brief Spheres to a sparse mask: sorted into nodes, then drawn on leaf masks.
///
/// 1. clipSpheres: the spheres' boxes, clipped; empty ones dropped
/// 2. sortIntoNodes: which spheres reach into which upper node (4096^3), and which lower one
///    (128^3)
/// 3. drawSlab, in parallel over quarters of lower nodes:
///    - balls smaller than a leaf are drawn at once, as stamps or row by row;
///    - the others are sorted into groups of 32^3, and from there into leaves. A group or leaf
///      inside one of them is full. In others, balls that add nothing are left out (PowerCull.h);
///    - what is left is drawn leaf by leaf, on mask words.
///
/// A node wholly inside a single sphere and the clip becomes a tile; a full leaf does too. Exact:
/// integers throughout. OR does not depend on the order of spheres, so the result does not depend
/// on threads.

#include "SphereRaster.h"

#include "BallLists.h"
#include "NodeCanvas.h"
#include "PowerCull.h"
#include "SphereNodes.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <atomic>
#include <memory>
#include <vector>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Coord;
using openvdb::MaskTree;

/// Draws balls into a slab of a lower internal node. Memory of one thread, for one slab after the
/// other.
class NodePainter {
public:
    /// The slab must have been begun on the canvas.
    void draw(const ClippedSphere* balls, const std::vector<int32_t>& ofNode)
    {
        mLarge.clear();
        for (const int32_t i : ofNode) {
            if (!canvas.touches(balls[i])) continue;
            if (NodeCanvas::isSmall(balls[i])) canvas.drawSmall(balls[i]);
            else mLarge.push_back(i);
        }
        if (mLarge.empty()) return;
        mGroups.build(balls, mLarge.data(), mLarge.data() + mLarge.size(), canvas.origin(),
            NodeCanvas::kLog2, NodeCanvas::kGroupLog2, {canvas.slab(), canvas.slab()});
        const int end = int(mGroups.endReached()); // all of them are of the slab
        for (int group = int(mGroups.firstReached()); group < end; ++group) {
            drawGroup(balls, group);
        }
    }

    NodeCanvas canvas;

private:
    void drawGroup(const ClippedSphere* balls, int group)
    {
        if (mGroups.full(group)) {
            canvas.fillGroup(group);
            return;
        }
        mOfGroup.assign(mGroups.begin(group), mGroups.end(group));
        if (mOfGroup.empty() || canvas.isFull(group)) return;
        const Coord origin = mGroups.childOrigin(group);
        mCull.cull(balls, origin.data(), 1 << NodeCanvas::kGroupLog2, mOfGroup);
        mLeaves.build(balls, mOfGroup.data(), mOfGroup.data() + mOfGroup.size(), origin,
            NodeCanvas::kGroupLog2, NodeCanvas::kLeafLog2);
        const int end = int(mLeaves.endReached());
        for (int leaf = int(mLeaves.firstReached()); leaf < end; ++leaf) {
            drawLeaf(balls, group, leaf);
        }
    }

    void drawLeaf(const ClippedSphere* balls, int group, int leaf)
    {
        if (mLeaves.full(leaf)) {
            canvas.fillLeaf(group, leaf);
            return;
        }
        mOfLeaf.assign(mLeaves.begin(leaf), mLeaves.end(leaf));
        if (mOfLeaf.empty() || canvas.isFull(group, leaf)) return;
        const Coord origin = mLeaves.childOrigin(leaf);
        mCull.cull(balls, origin.data(), 1 << NodeCanvas::kLeafLog2, mOfLeaf);
        for (const int32_t i : mOfLeaf) canvas.drawLeaf(balls[i], group, leaf, origin);
    }

    BallLists mGroups, mLeaves;
    PowerCull mCull;
    std::vector<int32_t> mLarge, mOfGroup, mOfLeaf;
};

/// The voxels of lower nodes; null for those that are full.
using DrawnNodes = std::vector<std::unique_ptr<LowerNode>>;

/// Moves the slab on the canvas to its node. A full leaf is a tile. Slabs of a node have no word of
/// its masks in common, so several threads may do this.
void storeSlab(const NodeCanvas& canvas, const ClipMask::Leaves& clipLeaves, LowerNode& node)
{
    for (int group = canvas.firstGroup(); group < canvas.endGroup(); ++group) {
        for (int l = 0; l < 64; ++l) {
            const bool full = canvas.full(group) >> l & 1, drawn = canvas.drawn(group) >> l & 1;
            if (!full && !drawn) continue;
            const Coord origin = canvas.leafOrigin(group, l);
            const openvdb::Index offset = LowerNode::coordToOffset(origin);
            if (!clipLeaves.isOn(offset)) continue;
            const LeafMask& mask = canvas.mask(group, l);
            if (full || mask.all()) {
                node.addTile(offset, true, true);
                continue;
            }
            if (mask.none()) continue; // a sphere came near, but holds no voxel of it
            auto leaf = std::make_unique<LeafNode>(origin);
            mask.copyTo(leaf->getValueMask());
            node.addLeaf(leaf.release());
        }
    }
}

void drawSlab(const NodeSpheres& spheres, int slab, const ClippedSphere* balls,
    const ClipMask& clipMask, NodePainter& painter, LowerNode& node)
{
    NodeCanvas& canvas = painter.canvas;
    canvas.begin(spheres.origin, slab);
    const ClipMask::Leaves clipLeaves = clipMask.leavesOf(spheres.origin);
    const int first = clipLeaves.isOn() ? canvas.endGroup() : canvas.firstGroup();
    for (int group = first; group < canvas.endGroup(); ++group) {
        for (int leaf = 0; leaf < 64; ++leaf) { // nothing is drawn where the object has no leaf
            const Coord origin = canvas.leafOrigin(group, leaf);
            if (!clipLeaves.isOn(LowerNode::coordToOffset(origin))) canvas.fillLeaf(group, leaf);
        }
    }
    painter.draw(balls, spheres.balls);
    storeSlab(canvas, clipLeaves, node);
    for (int group = canvas.firstGroup(); group < canvas.endGroup(); ++group) canvas.clean(group);
}

/// Lists of balls are given back as they are drawn.
DrawnNodes drawNodes(std::vector<NodeSpheres>& spheres, const ClippedSphere* balls,
    const ClipMask& clipMask, openvdb::util::NullInterrupter* interrupter)
{
    constexpr std::size_t kSlabs = NodeCanvas::kSlabs;
    DrawnNodes nodes(spheres.size());
    parallelFor(spheres.size(), interrupter, [&](std::size_t i) {
        if (spheres[i].full) return;
        nodes[i] = std::make_unique<LowerNode>(spheres[i].origin, false, false);
    });
    std::vector<std::atomic<std::size_t>> slabsLeft(spheres.size()); // there may be many balls
    for (auto& left : slabsLeft) left = kSlabs;
    parallelForWithScratch<NodePainter>(
        kSlabs * spheres.size(), interrupter, [&](std::size_t i, NodePainter& painter) {
            NodeSpheres& ofNode = spheres[i / kSlabs];
            if (ofNode.full) return;
            drawSlab(ofNode, int(i % kSlabs), balls, clipMask, painter, *nodes[i / kSlabs]);
            if (--slabsLeft[i / kSlabs] == 0) std::vector<int32_t>().swap(ofNode.balls);
        });
    return nodes;
}

MaskTree::Ptr assemble(const SphereNodes& sorted, DrawnNodes& nodes)
{
    auto tree = std::make_shared<MaskTree>();
    for (const Coord& origin : sorted.fullUpperNodes) tree->root().addTile(origin, true, true);
    UpperNode* parent = nullptr; // the lower nodes of an upper one stand together
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const NodeSpheres& spheres = sorted.lowerNodes[i];
        if (!spheres.full && nodes[i]->isChildMaskOff() && nodes[i]->isValueMaskOff()) continue;
        const Coord origin = spheres.origin & ~((1 << kUpperLog2) - 1);
        if (!parent || parent->origin() != origin) {
            parent = new UpperNode(origin, false, false);
            tree->root().addChild(parent);
        }
        if (spheres.full) {
            parent->addTile(UpperNode::coordToOffset(spheres.origin), true, true);
        } else {
            parent->addChild(nodes[i].release());
        }
    }
    return tree;
}

} // namespace

MaskTree::Ptr rasterSpheres(const std::vector<ExactSphere>& spheres, const SphereMetric& metric,
    const openvdb::CoordBBox& clip, const MaskTree* within,
    openvdb::util::NullInterrupter* interrupter)
{
    const ClipMask clipMask(within);
    const ClippedSpheres clipped = clipSpheres(spheres, metric, clip, interrupter);
    SphereNodes sorted = sortIntoNodes(clipped, clipMask, interrupter);
    DrawnNodes nodes = drawNodes(sorted.lowerNodes, clipped.balls.get(), clipMask, interrupter);
    return assemble(sorted, nodes);
}

} // namespace openvdb_spheretree::detail
