// SPDX-License-Identifier: Apache-2.0
/// @file LevelParts.h
/// @brief Object and background of a level cut into their parts within each leaf, and the numbers of these
/// parts as nodes of two graphs.
///
/// Of the background outside the leaves, what lies between two leaves of a column along z is one part, a
/// *gap*. All else is open to infinity along z: one part as well, whatever the bounding box.
///
/// Cost: linear in leaves; some 12 bytes a leaf, and 512 more where object or background is in parts.

#pragma once

#include "LeafParts.h"
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/LeafWalk.h>

#include <openvdb/util/NullInterrupter.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

constexpr uint32_t kPartChunk = 256; ///< leaves that one task takes on

/// How a leaf is cut into parts, and their nodes in the union-finds.
struct LeafCut {
    static constexpr uint16_t kUnlabelled = 0xffff;

    uint32_t object = 0, background = 0; ///< the first node; a gap behind the leaf has the node
                                         ///< behind those of the leaf's background
    uint16_t objectParts = 0, backgroundParts = 0;
    uint16_t labels = kUnlabelled; ///< index in the chunk's; unlabelled where all labels are 0
};

class LevelParts {
public:
    static constexpr uint32_t kOutside = 0; ///< the node of the background at infinity

    /// @param layout  kept by reference
    /// @throw openvdb::ValueError if there are more than 2^32 parts
    LevelParts(const LeafLayout& layout, openvdb::util::NullInterrupter* interrupter);

    const LeafLayout& layout() const { return mLayout; }
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

} // namespace openvdb_spheretree::detail
