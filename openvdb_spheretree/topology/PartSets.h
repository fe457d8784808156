// SPDX-License-Identifier: Apache-2.0
/// @file PartSets.h
/// @brief Which voxels of a level belong together (26-connected), and which of its background (6-
/// connected), without a look at empty space.
///
/// 1. `LevelParts`: cut object and background into their parts within each leaf, by flooding mask
///    words (LeafParts.h). Of the background outside the leaves, what lies between two leaves of a
///    column along z is one part, a *gap*. All else is open to infinity along z: one part as well,
///    whatever the bounding box.
/// 2. `PartSets`: join parts that touch across the borders of leaves, in two union-finds. A gap
///    is joined with what lies beside it by walking the four columns around it.
///
/// (Components of the surface between the two would need a node for each of its vertices; here it
/// is one for most leaves.) Cost: linear in leaves. Exact. Tests: TestLevelTopology.cc,
/// TestObjectParts.cc.

#pragma once

#include "LeafParts.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/UnionFind.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/LeafWalk.h>

#include <algorithm>
#include <vector>

namespace openvdb_spheretree::detail {

constexpr uint32_t kPartChunk = 256; // leaves that one task takes on

/// How a leaf is cut into parts, and their nodes in the union-finds.
struct LeafCut {
    static constexpr uint16_t kUnlabelled = 0xffff;

    uint32_t object = 0, background = 0; ///< the first node; a gap behind the leaf has the node
                                         ///< behind those of the leaf's background
    uint16_t objectParts = 0, backgroundParts = 0;
    uint16_t labels = kUnlabelled; ///< index in the chunk's; unlabelled where all labels are 0
};

/// Object and background of a level, in parts.
class LevelParts {
public:
    static constexpr uint32_t kOutside = 0; ///< the node of the background at infinity

    /// @throw openvdb::ValueError if there are more than 2^32 parts
    /// @throw Interrupted if the interrupter (may be null) said so
    LevelParts(const LeafLayout& layout, openvdb::util::NullInterrupter* interrupter);

    std::size_t chunks() const
    {
        return (std::size_t(mLayout.leafCount()) + kPartChunk - 1) / kPartChunk;
    }
    uint32_t objectNodes() const { return mObjectNodes; }
    uint32_t backgroundNodes() const { return mBackgroundNodes; }
    const LeafCut& operator[](uint32_t leaf) const { return mCuts[leaf]; }
    bool isFull(uint32_t leaf) const { return mCuts[leaf].backgroundParts == 0; }

    uint32_t label(uint32_t leaf, uint32_t offset) const
    {
        const uint16_t index = mCuts[leaf].labels;
        return index == LeafCut::kUnlabelled ? 0 : mLabels[leaf / kPartChunk][index][offset];
    }

    /// Whether other leaves follow behind @a leaf in its column along z, but not right behind it.
    bool hasGapBehind(uint32_t leaf) const
    {
        if (leaf + 1 == mLayout.leafCount()) return false;
        const LeafPlace here(mLayout.origin(leaf)), next(mLayout.origin(leaf + 1));
        return next.sameColumn(here) && next.z != here.z + kLeafDim;
    }
    uint32_t gapBehind(uint32_t leaf) const
    {
        return mCuts[leaf].background + mCuts[leaf].backgroundParts;
    }
    /// @return the node of a place without a leaf, given the first leaf behind it.
    uint32_t emptyPlace(const LeafPlace& place, uint32_t behind) const
    {
        const bool between = behind > 0 && behind < mLayout.leafCount()
            && LeafPlace(mLayout.origin(behind)).sameColumn(place)
            && LeafPlace(mLayout.origin(behind - 1)).sameColumn(place);
        return between ? gapBehind(behind - 1) : kOutside;
    }

private:
    void numberNodes();

    const LeafLayout& mLayout;
    std::vector<LeafCut> mCuts;
    std::vector<std::vector<PartLabels>> mLabels; ///< by chunk
    uint32_t mObjectNodes = 0, mBackgroundNodes = 0;
};

/// The parts of object and background, joined where leaves touch.
class PartSets {
public:
    PartSets(const LeafLayout& layout, const LevelParts& parts)
        : mLayout(layout), mParts(parts), mObject(parts.objectNodes()),
          mBackground(parts.backgroundNodes())
    {}

    /// Joins the parts of leaves with what is around them, each pair of leaves once, in parallel. On the
    /// way it calls visit(chunk, around) for every leaf, of which that many belong to a chunk.
    /// @throw Interrupted
    template <typename Visit>
    void joinAll(openvdb::util::NullInterrupter* interrupter, const Visit& visit)
    {
        parallelFor(mParts.chunks(), interrupter, [&](std::size_t chunk) {
            const uint32_t begin = uint32_t(chunk) * kPartChunk;
            const uint32_t end = std::min(begin + kPartChunk, mLayout.leafCount());
            LeafWalk around(mLayout, begin);
            for (uint32_t leaf = begin; leaf < end; ++leaf) {
                around.moveTo(leaf);
                joinLeaf(leaf, around);
                visit(chunk, around);
            }
        });
    }

    UnionFind& object() { return mObject; }
    UnionFind& background() { return mBackground; }

private:
    struct Side;
    struct Contact;

    void joinLeaf(uint32_t leaf, const LeafWalk& around);
    void joinObject(uint32_t leaf, const LeafWalk& around);
    void joinBackground(uint32_t leaf, const LeafWalk& around);
    void joinGap(uint32_t leaf, const LeafWalk& around);
    Side objectSide(uint32_t leaf) const;
    Side backgroundSide(uint32_t leaf) const;
    static bool areOne(UnionFind& sets, const Side& a, const Side& b);
    uint32_t nodeOf(const Side& side, Axis axis, int at, uint32_t bit) const;
    void joinContact(UnionFind& sets, const Side& a, const LeafMask& maskA, const Side& b,
        const LeafMask& maskB, const Contact& contact);
    void joinPlane(const Side& side, const LeafMask& mask, Axis axis, int at, uint32_t node);

    const LeafLayout& mLayout;
    const LevelParts& mParts;
    UnionFind mObject, mBackground;
};

} // namespace openvdb_spheretree::detail
