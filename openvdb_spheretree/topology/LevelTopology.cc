// SPDX-License-Identifier: Apache-2.0
/// @file LevelTopology.cc
/// @brief Components b0, tunnels b1 and cavities b2 of closed cubes, from what can be counted
/// without looking at empty space:
/// - b0 is the number of 26-connected components of the object;
/// - b2 is the number of 6-connected components of the background, less the one outside (Alexander
///   duality);
/// - b0 - b1 + b2 is the Euler characteristic, a sum over leaves (EulerNumber.cc).
///
/// 1. `LevelParts`: cut object and background into their parts within each leaf, by flooding mask
///    words (LeafParts.h). Of the background outside the leaves, what lies between two leaves of a
///    column along z is one part, a *gap*. All else is open to infinity along z: one part as well,
///    whatever the bounding box.
/// 2. `PartJoiner`: join parts that touch across the borders of leaves, in two union-finds. A gap
///    is joined with what lies beside it by walking the four columns around it.
/// 3. Count the sets.
///
/// (Components of the surface between the two would need a node for each of its vertices; here it
/// is one for most leaves.) Cost: linear in leaves. Exact. Tests: TestLevelTopology.cc.

#include "LevelTopology.h"

#include "EulerNumber.h"
#include "LeafParts.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/UnionFind.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/LeafPlanes.h>
#include <openvdb_spheretree/voxel/LeafWalk.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace openvdb_spheretree {

namespace {

using detail::LeafPlace;
using detail::LeafWalk;
using detail::UnionFind;

constexpr uint32_t kChunk = 256; // leaves that one task takes on

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

    LevelParts(const LeafLayout& layout, openvdb::util::NullInterrupter* interrupter)
        : mLayout(layout), mCuts(layout.leafCount()), mLabels(chunks())
    {
        detail::parallelForWithScratch<detail::PartLabels>(
            chunks(), interrupter, [&](std::size_t chunk, detail::PartLabels& labels) {
                const uint32_t begin = uint32_t(chunk) * kChunk;
                const uint32_t end = std::min(begin + kChunk, layout.leafCount());
                for (uint32_t leaf = begin; leaf < end; ++leaf) {
                    const auto counts = detail::leafParts(layout.mask(leaf), labels);
                    mCuts[leaf].objectParts = uint16_t(counts.object);
                    mCuts[leaf].backgroundParts = uint16_t(counts.background);
                    if (counts.object <= 1 && counts.background <= 1) continue;
                    mCuts[leaf].labels = uint16_t(mLabels[chunk].size());
                    mLabels[chunk].push_back(labels);
                }
            });
        numberNodes();
    }

    std::size_t chunks() const { return (std::size_t(mLayout.leafCount()) + kChunk - 1) / kChunk; }
    uint32_t objectNodes() const { return mObjectNodes; }
    uint32_t backgroundNodes() const { return mBackgroundNodes; }
    const LeafCut& operator[](uint32_t leaf) const { return mCuts[leaf]; }
    bool isFull(uint32_t leaf) const { return mCuts[leaf].backgroundParts == 0; }

    uint32_t label(uint32_t leaf, uint32_t offset) const
    {
        const uint16_t index = mCuts[leaf].labels;
        return index == LeafCut::kUnlabelled ? 0 : mLabels[leaf / kChunk][index][offset];
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
    void numberNodes()
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

    const LeafLayout& mLayout;
    std::vector<LeafCut> mCuts;
    std::vector<std::vector<detail::PartLabels>> mLabels; ///< by chunk
    uint32_t mObjectNodes = 0, mBackgroundNodes = 0;
};

/// Where two leaves touch: a plane of voxels of each, and the moves along the plane's two axes that
/// bring voxels of the other leaf to voxels beside them of this one.
struct Contact {
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

/// Joins the parts of leaves with what is around them, each pair of leaves once, and sums up the
/// Euler characteristic on the way.
class PartJoiner {
public:
    PartJoiner(const LeafLayout& layout, const LevelParts& parts)
        : mLayout(layout), mParts(parts), mObject(parts.objectNodes()),
          mBackground(parts.backgroundNodes()), mEuler(parts.chunks(), 0)
    {}

    LevelTopology joinAll(openvdb::util::NullInterrupter* interrupter)
    {
        detail::parallelFor(mParts.chunks(), interrupter, [&](std::size_t chunk) {
            const uint32_t begin = uint32_t(chunk) * kChunk;
            const uint32_t end = std::min(begin + kChunk, mLayout.leafCount());
            LeafWalk around(mLayout, begin);
            for (uint32_t leaf = begin; leaf < end; ++leaf) {
                around.moveTo(leaf);
                joinObject(leaf, around);
                if (!mParts.isFull(leaf)) joinBackground(leaf, around);
                if (mParts.hasGapBehind(leaf)) joinGap(leaf, around);
                if (!isDeepInside(around)) mEuler[chunk] += eulerOfLeaf(mLayout, around);
            }
        });
        const int64_t components = mObject.sets(), cavities = mBackground.sets() - 1;
        const int64_t euler = std::accumulate(mEuler.begin(), mEuler.end(), int64_t(0));
        return {components, components + cavities - euler, cavities};
    }

private:
    /// Where all leaves that eulerOfLeaf() looks at are full, the sum is 0.
    bool isDeepInside(const LeafWalk& around) const
    {
        for (int i = 0; i < 18; ++i) {
            const uint32_t leaf = around.at(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
            if (leaf == LeafWalk::kNone || !mParts.isFull(leaf)) return false;
        }
        return true;
    }

    /// With the 13 leaves before it.
    void joinObject(uint32_t leaf, const LeafWalk& around)
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

    void joinBackground(uint32_t leaf, const LeafWalk& around)
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
    void joinGap(uint32_t leaf, const LeafWalk& around)
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

    /// Object or background of a leaf.
    struct Side {
        uint32_t leaf, firstNode;
        bool isWhole; ///< one part, whatever the voxel
    };

    Side objectSide(uint32_t leaf) const
    {
        return {leaf, mParts[leaf].object, mParts[leaf].objectParts == 1};
    }
    Side backgroundSide(uint32_t leaf) const
    {
        return {leaf, mParts[leaf].background, mParts[leaf].backgroundParts == 1};
    }
    /// Where two leaves are joined as a whole already, their voxels need no look.
    static bool areOne(UnionFind& sets, const Side& a, const Side& b)
    {
        return a.isWhole && b.isWhole && sets.find(a.firstNode) == sets.find(b.firstNode);
    }
    uint32_t nodeOf(const Side& side, Axis axis, int at, uint32_t bit) const
    {
        if (side.isWhole) return side.firstNode;
        return side.firstNode + mParts.label(side.leaf, detail::offsetInPlane(axis, at, bit));
    }

    void joinContact(UnionFind& sets, const Side& a, const LeafMask& maskA, const Side& b,
        const LeafMask& maskB, const Contact& contact)
    {
        const Axis axis = contact.axis;
        const uint64_t here = detail::planeOf(maskA, axis, contact.here);
        const uint64_t there = detail::planeOf(maskB, axis, contact.there);
        for (int u = contact.alongU.first; u <= contact.alongU.last; ++u) {
            for (int v = contact.alongV.first; v <= contact.alongV.last; ++v) {
                uint64_t touching = here & detail::movedPlane(there, u, v);
                for (; touching; touching &= touching - 1) {
                    const uint32_t bit = openvdb::util::FindLowestOn(touching);
                    sets.unite(nodeOf(a, axis, contact.here, bit),
                        nodeOf(b, axis, contact.there, bit - uint32_t(8 * u + v)));
                    if (a.isWhole && b.isWhole) return;
                }
            }
        }
    }

    void joinPlane(const Side& side, const LeafMask& mask, Axis axis, int at, uint32_t node)
    {
        for (uint64_t left = detail::planeOf(mask, axis, at); left; left &= left - 1) {
            const uint32_t bit = openvdb::util::FindLowestOn(left);
            mBackground.unite(node, nodeOf(side, axis, at, bit));
            if (side.isWhole) return;
        }
    }

    const LeafLayout& mLayout;
    const LevelParts& mParts;
    UnionFind mObject, mBackground;
    std::vector<int64_t> mEuler; ///< by chunk
};

} // namespace

LevelTopology levelTopology(const LeafLayout& level, openvdb::util::NullInterrupter* interrupter)
{
    const LevelParts parts(level, interrupter);
    return PartJoiner(level, parts).joinAll(interrupter);
}

LevelTopology levelTopology(
    const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter)
{
    return levelTopology(LeafLayout(*voxelsOf(object, FlatAxis(2))), interrupter);
}

} // namespace openvdb_spheretree
