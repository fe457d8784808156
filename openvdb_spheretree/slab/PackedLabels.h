// SPDX-License-Identifier: Apache-2.0
/// @file PackedLabels.h
/// @brief The labels of a slab in a form that compresses well, and back.
///
/// After the passes along z and y, a voxel's value is the site's radiusSq less the squares of the
/// offsets to it along y and z. So the key is not packed. In the power cell of a ball radiusSq is
/// constant, and offsets fall by one from voxel to voxel, which compresses well. The offset along z
/// is that of the voxel that dy leads to (SlabLabels::dzFollowsDy), so that a leaf is unpacked
/// without the others of its slab.

#pragma once

#include "SlabLabels.h"
#include <openvdb_spheretree/kernel/MaxPlus.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <cstdint>
#include <type_traits>

namespace openvdb_spheretree::slab {

template <typename Power>
struct PackedLabel {
    std::conditional_t<sizeof(typename Power::Key) == 4, uint16_t, uint32_t> siteSq;
    typename Power::Offset dy, dz;
};

/// @param packed  receives 512
template <typename Power>
void packLeaf(const LeafLayout& layout, uint32_t leaf, const SlabLabels<Power>& labels,
    PackedLabel<Power>* packed)
{
    const auto* keys = labels.keysOf(leaf);
    const auto* dy = labels.dyOf(leaf);
    for (uint32_t k = 0; k < kLeafVoxels; ++k) {
        packed[k].siteSq = detail::siteSqOf<Power>(keys[k]);
        packed[k].dy = dy[k];
        const VoxelRef voxel{leaf, k};
        const VoxelRef there = moved(layout, Axis::Y, voxel, dy[k]);
        packed[k].dz = typename Power::Offset(labels.dzAfter(voxel, there));
    }
}

/// @param keys  receives 512
template <typename Power>
void unpackKeys(const PackedLabel<Power>* packed, typename Power::Key* keys)
{
    for (uint32_t k = 0; k < kLeafVoxels; ++k) {
        const uint32_t siteSq = packed[k].siteSq;
        const auto below = uint32_t(packed[k].dy * packed[k].dy + packed[k].dz * packed[k].dz);
        keys[k] = detail::powerKey<Power>(siteSq - below, siteSq);
    }
}

/// @param labels  receive those of a leaf; with dzFollowsDy
template <typename Power>
void unpackLeaf(const PackedLabel<Power>* packed, uint32_t leaf, const SlabLabels<Power>& labels)
{
    unpackKeys<Power>(packed, labels.keysOf(leaf));
    auto* dy = labels.dyOf(leaf);
    for (uint32_t k = 0; k < kLeafVoxels; ++k) dy[k] = packed[k].dy;
    if (!labels.dz) return;
    auto* dz = labels.dzOf(leaf);
    for (uint32_t k = 0; k < kLeafVoxels; ++k) dz[k] = packed[k].dz;
}

} // namespace openvdb_spheretree::slab
