// SPDX-License-Identifier: Apache-2.0
#include "PartSets.h"

#include <openvdb_spheretree/voxel/LeafPlanes.h>

#include <limits>
#include <utility>

namespace openvdb_spheretree::detail {

LevelParts::LevelParts(const LeafLayout& layout, openvdb::util::NullInterrupter* interrupter)
    : mLayout(layout), mCuts(layout.leafCount()), mLabels(chunks())
{
    parallelForWithScratch<PartLabels>(
        chunks(), interrupter, [&](std::size_t chunk, PartLabels& labels) {
            const uint32_t begin = uint32_t(chunk) * kPartChunk;
            const uint32_t end = std::min(begin + kPartChunk, layout.leafCount());
            for (uint32_t leaf = begin; leaf < end; ++leaf) {
                const auto counts = leafParts(layout.mask(leaf), labels);
                mCuts[leaf].objectParts = uint16_t(counts.object);
                mCuts[leaf].backgroundParts = uint16_t(counts.background);
                if (counts.object <= 1 && counts.background <= 1) continue;
                mCuts[leaf].labels = uint16_t(mLabels[chunk].size());
                mLabels[chunk].push_back(labels);
            }
        });
    numberNodes();
}

void LevelParts::numberNodes()
{
    int64_t object = 0, background = 1; // outside
    for (uint32_t leaf = 0; leaf < mLayout.leafCount(); ++leaf) {
        LeafCut& cut = mCuts[leaf];
        cut.object = uint32_t(object);
        cut.background = uint32_t(background);
        object += cut.objectParts;
        background += cut.backgroundParts + hasGapBehind(leaf);
    }
    if (std::max(object, background) > std::numeric_limits<uint32_t>::max()) {
        OPENVDB_THROW(openvdb::ValueError,
            "the voxels of a level and the background between them are cut into "
                << std::max(object, background)
                << " parts by leaf nodes, more than 2^32: build without topology");
    }
    mObjectNodes = uint32_t(object);
    mBackgroundNodes = uint32_t(background);
}

/// Where two leaves touch: a plane of voxels of each, and the moves along the plane's two axes that
/// bring voxels of the other leaf to voxels beside them of this one.
struct PartSets::Contact {
    struct Moves {
        int first, last;
    };

    Axis axis;
    int here, there; ///< the plane's coordinate along the axis in each leaf
    Moves alongU, alongV;

    static Moves moves(int step) { return step == 0 ? Moves{-1, 1} : Moves{7 * step, 7 * step}; }

    /// By faces, edges or corners, of a leaf and the one (dx, dy, dz) leaves on.
    static Contact withCorners(int dx, int dy, int dz)
    {
        if (dx != 0) return {Axis::X, dx < 0 ? 0 : 7, dx < 0 ? 7 : 0, moves(dy), moves(dz)};
        if (dy != 0) return {Axis::Y, dy < 0 ? 0 : 7, dy < 0 ? 7 : 0, moves(0), moves(dz)};
        return {Axis::Z, dz < 0 ? 0 : 7, dz < 0 ? 7 : 0, moves(0), moves(0)};
    }
    /// By faces, of a leaf and the one before it along @a axis.
    static Contact withFaces(Axis axis) { return {axis, 0, 7, {0, 0}, {0, 0}}; }
};

/// Object or background of a leaf.
struct PartSets::Side {
    uint32_t leaf, firstNode;
    bool isWhole; ///< one part, whatever the voxel
};

void PartSets::joinLeaf(uint32_t leaf, const LeafWalk& around)
{
    joinObject(leaf, around);
    if (!mParts.isFull(leaf)) joinBackground(leaf, around);
    if (mParts.hasGapBehind(leaf)) joinGap(leaf, around);
}

/// With the 13 leaves before it.
void PartSets::joinObject(uint32_t leaf, const LeafWalk& around)
{
    for (int i = 0; i < 13; ++i) {
        const int dx = i / 9 - 1, dy = i / 3 % 3 - 1, dz = i % 3 - 1;
        const uint32_t other = around.at(dx, dy, dz);
        if (other == LeafWalk::kNone) continue;
        const Side here = objectSide(leaf), there = objectSide(other);
        if (areOne(mObject, here, there)) continue;
        joinContact(mObject, here, mLayout.mask(leaf), there, mLayout.mask(other),
            Contact::withCorners(dx, dy, dz));
    }
}

void PartSets::joinBackground(uint32_t leaf, const LeafWalk& around)
{
    const Side here = backgroundSide(leaf);
    const LeafMask mask = LeafMask::full() - mLayout.mask(leaf);
    for (int i = 0; i < 6; ++i) {
        const int step = i < 3 ? -1 : 1, axis = i % 3;
        const int dx = step * (axis == 0), dy = step * (axis == 1), dz = step * (axis == 2);
        const uint32_t other = around.at(dx, dy, dz);
        if (other == LeafWalk::kNone) {
            const LeafPlace place = LeafPlace(mLayout.origin(leaf)).offsetBy(dx, dy, dz);
            const uint32_t node = mParts.emptyPlace(place, around.firstFrom(dx, dy, dz));
            joinPlane(here, mask, Axis(axis), step < 0 ? 0 : 7, node);
        } else if (step < 0 && !mParts.isFull(other)) {
            const Side there = backgroundSide(other);
            if (areOne(mBackground, here, there)) continue;
            joinContact(mBackground, here, mask, there, LeafMask::full() - mLayout.mask(other),
                Contact::withFaces(Axis(axis)));
        }
    }
}

/// The gap behind a leaf with the empty places beside it: along each column around, from the
/// gap's first place to its last, those before, between and behind the leaves there.
void PartSets::joinGap(uint32_t leaf, const LeafWalk& around)
{
    const uint32_t gap = mParts.gapBehind(leaf);
    const LeafPlace first = LeafPlace(mLayout.origin(leaf)).offsetBy(0, 0, 1);
    const int64_t end = LeafPlace(mLayout.origin(leaf + 1)).z;
    for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
        LeafPlace place = first.offsetBy(dx, dy, 0);
        uint32_t next = around.firstFrom(dx, dy, 1);
        while (place.z < end) {
            const bool inColumn =
                next < mLayout.leafCount() && LeafPlace(mLayout.origin(next)).sameColumn(place);
            const bool isLeaf = inColumn && mLayout.origin(next)[2] == place.z;
            if (!isLeaf) mBackground.unite(gap, mParts.emptyPlace(place, next));
            if (!inColumn) break;
            place.z = int64_t(mLayout.origin(next)[2]) + kLeafDim;
            ++next;
        }
    }
}

PartSets::Side PartSets::objectSide(uint32_t leaf) const
{
    return {leaf, mParts[leaf].object, mParts[leaf].objectParts == 1};
}

PartSets::Side PartSets::backgroundSide(uint32_t leaf) const
{
    return {leaf, mParts[leaf].background, mParts[leaf].backgroundParts == 1};
}

/// Where two leaves are joined as a whole already, their voxels need no look.
bool PartSets::areOne(UnionFind& sets, const Side& a, const Side& b)
{
    return a.isWhole && b.isWhole && sets.find(a.firstNode) == sets.find(b.firstNode);
}

uint32_t PartSets::nodeOf(const Side& side, Axis axis, int at, uint32_t bit) const
{
    if (side.isWhole) return side.firstNode;
    return side.firstNode + mParts.label(side.leaf, offsetInPlane(axis, at, bit));
}

void PartSets::joinContact(UnionFind& sets, const Side& a, const LeafMask& maskA, const Side& b,
    const LeafMask& maskB, const Contact& contact)
{
    const Axis axis = contact.axis;
    const uint64_t here = planeOf(maskA, axis, contact.here);
    const uint64_t there = planeOf(maskB, axis, contact.there);
    for (int u = contact.alongU.first; u <= contact.alongU.last; ++u) {
        for (int v = contact.alongV.first; v <= contact.alongV.last; ++v) {
            uint64_t touching = here & movedPlane(there, u, v);
            for (; touching; touching &= touching - 1) {
                const uint32_t bit = openvdb::util::FindLowestOn(touching);
                sets.unite(nodeOf(a, axis, contact.here, bit),
                    nodeOf(b, axis, contact.there, bit - uint32_t(8 * u + v)));
                if (a.isWhole && b.isWhole) return;
            }
        }
    }
}

void PartSets::joinPlane(const Side& side, const LeafMask& mask, Axis axis, int at, uint32_t node)
{
    for (uint64_t left = planeOf(mask, axis, at); left; left &= left - 1) {
        const uint32_t bit = openvdb::util::FindLowestOn(left);
        mBackground.unite(node, nodeOf(side, axis, at, bit));
        if (side.isWhole) return;
    }
}

} // namespace openvdb_spheretree::detail
