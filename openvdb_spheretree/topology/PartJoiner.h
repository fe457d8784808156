// SPDX-License-Identifier: Apache-2.0
/// @file PartJoiner.h
/// @brief Joins the parts of a level's leaves that touch across the borders of leaves, in two union-finds: the
/// object's parts by faces, edges and corners (26-connected), the background's by faces (6-connected).
///
/// A gap of the background is joined with what lies beside it by walking the four columns around it. Cost:
/// linear in leaves. Exact; the same for any number of threads.

#pragma once

#include "LevelParts.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/UnionFind.h>
#include <openvdb_spheretree/voxel/LeafPlanes.h>

#include <cstdint>

namespace openvdb_spheretree::detail {

struct Contact;

class PartJoiner {
public:
    /// @param parts  kept by reference
    explicit PartJoiner(const LevelParts& parts)
        : mLayout(parts.layout()), mParts(parts), mObject(parts.objectNodes()),
          mBackground(parts.backgroundNodes())
    {}

    /// Joins each pair of leaves once. Calls alsoVisit(chunk, around) at each leaf on the way, from several
    /// threads, but of a chunk from one.
    template <typename Visit>
    void joinAll(openvdb::util::NullInterrupter* interrupter, const Visit& alsoVisit)
    {
        parallelFor(mParts.chunks(), interrupter, [&](std::size_t chunk) {
            const uint32_t begin = uint32_t(chunk) * kPartChunk;
            const uint32_t end = std::min(begin + kPartChunk, mLayout.leafCount());
            LeafWalk around(mLayout, begin);
            for (uint32_t leaf = begin; leaf < end; ++leaf) {
                around.moveTo(leaf);
                joinObject(leaf, around);
                if (!mParts.isFull(leaf)) joinBackground(leaf, around);
                if (mParts.hasGapBehind(leaf)) joinGap(leaf, around);
                alsoVisit(chunk, around);
            }
        });
    }

    /// @name The sets, by the nodes that LevelParts gives the parts
    /// @{
    UnionFind& object() { return mObject; }
    UnionFind& background() { return mBackground; }
    /// @}
    /// @return whether a node of the background can be reached from infinity.
    bool isOutside(uint32_t node)
    {
        return mBackground.find(node) == mBackground.find(LevelParts::kOutside);
    }

private:
    /// Object or background of a leaf.
    struct Side {
        uint32_t leaf, firstNode;
        bool isWhole; ///< it is one part
    };

    void joinObject(uint32_t leaf, const LeafWalk& around);
    void joinBackground(uint32_t leaf, const LeafWalk& around);
    void joinGap(uint32_t leaf, const LeafWalk& around);
    void joinContact(UnionFind& sets, const Side& a, const LeafMask& maskA, const Side& b,
        const LeafMask& maskB, const Contact& contact);
    void joinPlane(const Side& side, const LeafMask& mask, Axis axis, int at, uint32_t node);

    Side objectSide(uint32_t leaf) const;
    Side backgroundSide(uint32_t leaf) const;
    /// Where two leaves are joined as a whole already, their voxels need no look.
    static bool areOne(UnionFind& sets, const Side& a, const Side& b);
    uint32_t nodeOf(const Side& side, Axis axis, int at, uint32_t bit) const;

    const LeafLayout& mLayout;
    const LevelParts& mParts;
    UnionFind mObject, mBackground;
};

} // namespace openvdb_spheretree::detail
