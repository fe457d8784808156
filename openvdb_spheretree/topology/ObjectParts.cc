// SPDX-License-Identifier: Apache-2.0
#include "ObjectParts.h"

#include "PartSets.h"
#include <openvdb_spheretree/voxel/BoxSides.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>
#include <openvdb_spheretree/voxel/TopologyCopy.h>

#include <openvdb/tools/Prune.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace openvdb_spheretree {

namespace {

using detail::LeafCut;
using detail::LevelParts;
using detail::LowerNode;
using detail::PartSets;
using detail::UnionFind;
using detail::UpperNode;
using openvdb::Coord;
using openvdb::MaskTree;

/// The object's voxels; nodes without any would be taken for something.
MaskTree::Ptr prunedMask(const MaskTree& object, openvdb::util::NullInterrupter* interrupter)
{
    const MaskTree::Ptr mask = detail::copyTopology<MaskTree>(object, interrupter);
    openvdb::tools::pruneInactive(*mask);
    return mask;
}

/// The object's voxels, and which of them and of its background belong together.
struct JoinedObject {
    JoinedObject(const MaskTree& object, openvdb::util::NullInterrupter* interrupter)
        : mask(prunedMask(object, interrupter)), layout(*mask), parts(layout, interrupter),
          sets(layout, parts)
    {
        sets.joinAll(interrupter, [](std::size_t, const detail::LeafWalk&) {});
    }

    const MaskTree::Ptr mask; ///< changed to the result
    const LeafLayout layout;  ///< of the object as it was
    const LevelParts parts;
    PartSets sets;
};

/// @return choose() of the object's voxels as a grid like it.
template <typename Choose>
openvdb::BoolGrid::Ptr chosenOf(const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter, const Choose& choose)
{
    using detail::copyTopology;
    const auto chosen = choose(*copyTopology<MaskTree>(object.tree(), interrupter), interrupter);
    const auto result =
        openvdb::BoolGrid::create(copyTopology<openvdb::BoolTree>(*chosen, interrupter));
    result->insertMeta(object);
    result->setTransform(object.transform().copy());
    return result;
}

/// Calls visit(part, voxels) for each part of the object in a leaf.
template <typename Visit>
void forEachPart(const LevelParts& parts, uint32_t leaf, const LeafMask& mask, const Visit& visit)
{
    const LeafCut& cut = parts[leaf];
    if (cut.objectParts == 1) return visit(cut.object, mask);
    std::vector<LeafMask> masks(cut.objectParts, LeafMask{});
    mask.visitOn([&](uint32_t voxel) { masks[parts.label(leaf, voxel)].setOn(voxel); });
    for (uint32_t part = 0; part < masks.size(); ++part) visit(cut.object + part, masks[part]);
}

/// @return the root of the largest part.
uint32_t largestOf(JoinedObject& joined, openvdb::util::NullInterrupter* interrupter)
{
    struct Part {
        int64_t voxels = 0;
        Coord first = Coord::max();
    };
    UnionFind& sets = joined.sets.object();
    std::vector<Part> parts(joined.parts.objectNodes());
    for (uint32_t leaf = 0; leaf < joined.layout.leafCount(); ++leaf) {
        if (leaf % 4096 == 0) detail::checkInterrupt(interrupter);
        const LeafMask& mask = joined.layout.mask(leaf);
        forEachPart(joined.parts, leaf, mask, [&](uint32_t node, const LeafMask& voxels) {
            Part& part = parts[sets.find(node)];
            part.voxels += voxels.count();
            // In a leaf, voxels are in the order of their coordinates.
            bool isFirst = true;
            voxels.visitOn([&](uint32_t voxel) {
                if (isFirst) part.first = std::min(part.first, joined.layout.voxel(leaf, voxel));
                isFirst = false;
            });
        });
    }
    uint32_t best = 0;
    for (uint32_t node = 1; node < parts.size(); ++node) {
        const Part &part = parts[node], &most = parts[best];
        const bool isTie = part.voxels == most.voxels && part.first < most.first;
        if (part.voxels > most.voxels || isTie) best = node;
    }
    return best;
}

/// The parts of the background that are not outside.
class Cavities {
public:
    Cavities(JoinedObject& joined, openvdb::util::NullInterrupter* interrupter)
        : mSets(joined.sets.background()), mOutside(mSets.find(LevelParts::kOutside)),
          mPlace(joined.parts.backgroundNodes(), kNone)
    {
        for (uint32_t leaf = 0; leaf < joined.layout.leafCount(); ++leaf) {
            if (leaf % 4096 == 0) detail::checkInterrupt(interrupter);
            const LeafCut& cut = joined.parts[leaf];
            for (uint32_t part = 0; part < cut.backgroundParts; ++part) {
                if (isNew(cut.background + part)) add(voxelOf(joined, leaf, part));
            }
            if (joined.parts.hasGapBehind(leaf) && isNew(joined.parts.gapBehind(leaf))) {
                add(joined.layout.origin(leaf).offsetBy(0, 0, kLeafDim));
            }
        }
    }

    void choose(const CavityChoice& choice) { mChosen = choice(mVoxels); }
    /// @return whether a part of the background is in a cavity that is filled. Threads may ask together.
    bool isFilled(uint32_t node)
    {
        const uint32_t root = mSets.find(node);
        return root != mOutside && mChosen[mPlace[root]];
    }

private:
    static constexpr uint32_t kNone = UINT32_MAX;

    bool isNew(uint32_t node)
    {
        const uint32_t root = mSets.find(node);
        if (root == mOutside || mPlace[root] != kNone) return false;
        mPlace[root] = uint32_t(mVoxels.size());
        return true;
    }
    void add(const Coord& voxel) { mVoxels.push_back(voxel); }

    static Coord voxelOf(const JoinedObject& joined, uint32_t leaf, uint32_t part)
    {
        std::optional<uint32_t> first;
        (LeafMask::full() - joined.layout.mask(leaf)).visitOn([&](uint32_t voxel) {
            if (!first && joined.parts.label(leaf, voxel) == part) first = voxel;
        });
        return joined.layout.voxel(leaf, *first);
    }

    UnionFind& mSets;
    uint32_t mOutside;
    std::vector<uint32_t> mPlace; ///< of roots, in mVoxels
    std::vector<Coord> mVoxels;   ///< one of each cavity
    std::vector<bool> mChosen;
};

/// Makes tiles of the places without leaf nodes between a leaf and the next behind it, all of which
/// are in one cavity. A node of the object without anything in it is one of the cavity, and becomes a
/// tile when the first of its columns comes by.
void fillGap(const MaskTree& object, const Coord& leaf, int end, MaskTree& filled)
{
    Coord place = leaf.offsetBy(0, 0, kLeafDim);
    const auto isCorner = [&](int side) { return ((place[0] | place[1]) & (side - 1)) == 0; };
    const auto reaches = [&](int side) {
        return (place[2] & (side - 1)) == 0 && int64_t(place[2]) + side <= end;
    };
    while (place[2] < end) {
        const bool isOn = object.isValueOn(place);
        int side = kLeafDim;
        if (reaches(UpperNode::DIM) && !isOn && !object.probeConstNode<UpperNode>(place)) {
            side = UpperNode::DIM;
        } else if (reaches(LowerNode::DIM) && !isOn && !object.probeConstNode<LowerNode>(place)) {
            side = LowerNode::DIM;
        }
        const openvdb::Index level = side == kLeafDim ? 1 : side == int(LowerNode::DIM) ? 2 : 3;
        if (side == kLeafDim || isCorner(side)) filled.addTile(level, place, true, true);
        place[2] += side;
    }
}

} // namespace

MaskTree::Ptr largestPart(const MaskTree& object, openvdb::util::NullInterrupter* interrupter)
{
    JoinedObject joined(object, interrupter);
    if (joined.layout.leafCount() == 0) return joined.mask;
    const uint32_t largest = largestOf(joined, interrupter);
    const auto isKept = [&](uint32_t node) { return joined.sets.object().find(node) == largest; };

    // Of a tile, all leaves are of one part.
    std::vector<openvdb::CoordBBox> lost;
    detail::forEachTile(*joined.mask, [&](const openvdb::CoordBBox& box) {
        if (!isKept(joined.parts[*joined.layout.findLeaf(box.min())].object)) lost.push_back(box);
    });
    std::vector<detail::LeafNode*> leaves;
    joined.mask->getNodes(leaves);
    detail::parallelFor(leaves.size(), interrupter, [&](std::size_t i) {
        const uint32_t leaf = *joined.layout.findLeaf(leaves[i]->origin());
        LeafMask kept{};
        forEachPart(joined.parts, leaf, joined.layout.mask(leaf),
            [&](uint32_t node, const LeafMask& voxels) {
                if (isKept(node)) kept |= voxels;
            });
        openvdb::util::NodeMask<3> mask;
        kept.copyTo(mask);
        leaves[i]->setValueMask(mask);
    });
    for (const openvdb::CoordBBox& box : lost) {
        const auto side = int(detail::sidesOf(box)[0]);
        const openvdb::Index level = side == kLeafDim ? 1 : side == int(LowerNode::DIM) ? 2 : 3;
        joined.mask->addTile(level, box.min(), false, false);
    }
    openvdb::tools::pruneInactive(*joined.mask);
    return joined.mask;
}

MaskTree::Ptr filledCavities(const MaskTree& object, openvdb::util::NullInterrupter* interrupter)
{
    return filledCavities(
        object, [](const auto& voxels) { return std::vector<bool>(voxels.size(), true); },
        interrupter);
}

MaskTree::Ptr filledCavities(
    const MaskTree& object, const CavityChoice& choose, openvdb::util::NullInterrupter* interrupter)
{
    JoinedObject joined(object, interrupter);
    Cavities cavities(joined, interrupter);
    cavities.choose(choose);
    const MaskTree before(*joined.mask);
    std::vector<detail::LeafNode*> leaves;
    joined.mask->getNodes(leaves);
    detail::parallelFor(leaves.size(), interrupter, [&](std::size_t i) {
        const uint32_t leaf = *joined.layout.findLeaf(leaves[i]->origin());
        LeafMask filled = joined.layout.mask(leaf);
        (LeafMask::full() - filled).visitOn([&](uint32_t voxel) {
            const uint32_t node = joined.parts[leaf].background + joined.parts.label(leaf, voxel);
            if (cavities.isFilled(node)) filled.setOn(voxel);
        });
        openvdb::util::NodeMask<3> mask;
        filled.copyTo(mask);
        leaves[i]->setValueMask(mask);
    });
    for (uint32_t leaf = 0; leaf < joined.layout.leafCount(); ++leaf) {
        if (leaf % 4096 == 0) detail::checkInterrupt(interrupter);
        if (!joined.parts.hasGapBehind(leaf)) continue;
        if (!cavities.isFilled(joined.parts.gapBehind(leaf))) continue;
        fillGap(
            before, joined.layout.origin(leaf), joined.layout.origin(leaf + 1)[2], *joined.mask);
    }
    openvdb::tools::pruneInactive(*joined.mask);
    return joined.mask;
}

openvdb::BoolGrid::Ptr largestPart(
    const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter)
{
    return chosenOf(object, interrupter,
        [](const MaskTree& voxels, auto* asked) { return largestPart(voxels, asked); });
}

openvdb::BoolGrid::Ptr filledCavities(
    const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter)
{
    return chosenOf(object, interrupter,
        [](const MaskTree& voxels, auto* asked) { return filledCavities(voxels, asked); });
}

} // namespace openvdb_spheretree
