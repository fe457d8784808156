// SPDX-License-Identifier: Apache-2.0
#include "PartSelection.h"

#include "PartJoiner.h"
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

namespace {

using detail::LevelParts;
using detail::PartJoiner;
using openvdb::Coord;
using openvdb::MaskTree;

const auto nothingElse = [](std::size_t, const detail::LeafWalk&) {};

/// @return the voxels of a leaf whose part keep(part) wants, where @a voxels are all of its object or of its
///         background, in @a count parts.
template <typename Keep>
LeafMask keptParts(
    const LevelParts& parts, uint32_t leaf, const LeafMask& voxels, int count, const Keep& keep)
{
    if (count == 1) return keep(0) ? voxels : LeafMask{};
    LeafMask kept{};
    voxels.visitOn([&](uint32_t offset) {
        if (keep(parts.label(leaf, offset))) kept.setOn(offset);
    });
    return kept;
}

/// Adds voxels of a leaf, which is in memory or not.
void addTo(MaskTree& tree, const Coord& origin, const LeafMask& voxels)
{
    if (voxels.none()) return;
    auto* const leaf = tree.touchLeaf(origin);
    LeafMask all = LeafMask::from(leaf->getValueMask());
    all |= voxels;
    detail::LeafNode::NodeMaskType mask;
    all.copyTo(mask);
    leaf->setValueMask(mask);
}

} // namespace

MaskTree::Ptr largestPart(const MaskTree& voxels, openvdb::util::NullInterrupter* interrupter)
{
    const LeafLayout layout(voxels);
    const LevelParts parts(layout, interrupter);
    PartJoiner joiner(parts);
    joiner.joinAll(interrupter, nothingElse);

    std::vector<int64_t> sizes(parts.objectNodes(), 0); // by the root of a set
    for (uint32_t leaf = 0; leaf < layout.leafCount(); ++leaf) {
        const auto setOf = [&](uint32_t part) {
            return joiner.object().find(parts[leaf].object + part);
        };
        const LeafMask& mask = layout.mask(leaf);
        if (parts[leaf].objectParts == 1) {
            sizes[setOf(0)] += mask.count();
            continue;
        }
        mask.visitOn([&](uint32_t offset) { ++sizes[setOf(parts.label(leaf, offset))]; });
    }
    auto result = std::make_shared<MaskTree>(false);
    // A set's root is its smallest node, so of equal sets the first one comes first.
    const auto largest = uint32_t(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    for (uint32_t leaf = 0; leaf < layout.leafCount(); ++leaf) {
        const auto isKept = [&](uint32_t part) {
            return joiner.object().find(parts[leaf].object + part) == largest;
        };
        addTo(*result, layout.origin(leaf),
            keptParts(parts, leaf, layout.mask(leaf), parts[leaf].objectParts, isKept));
    }
    openvdb::tools::prune(*result);
    return result;
}

MaskTree::Ptr withCavitiesFilled(
    const MaskTree& voxels, openvdb::util::NullInterrupter* interrupter)
{
    const LeafLayout layout(voxels);
    const LevelParts parts(layout, interrupter);
    PartJoiner joiner(parts);
    joiner.joinAll(interrupter, nothingElse);

    auto result = std::make_shared<MaskTree>(voxels);
    for (uint32_t leaf = 0; leaf < layout.leafCount(); ++leaf) {
        const Coord& origin = layout.origin(leaf);
        const auto isCavity = [&](uint32_t part) {
            return !joiner.isOutside(parts[leaf].background + part);
        };
        if (!parts.isFull(leaf)) {
            addTo(*result, origin,
                keptParts(parts, leaf, LeafMask::full() - layout.mask(leaf),
                    parts[leaf].backgroundParts, isCavity));
        }
        if (parts.hasGapBehind(leaf) && !joiner.isOutside(parts.gapBehind(leaf))) {
            const Coord& next = layout.origin(leaf + 1);
            result->sparseFill(
                openvdb::CoordBBox(origin.offsetBy(0, 0, kLeafDim),
                    Coord(origin[0] + kLeafDim - 1, origin[1] + kLeafDim - 1, next[2] - 1)),
                true);
        }
    }
    openvdb::tools::prune(*result);
    return result;
}

} // namespace openvdb_spheretree
