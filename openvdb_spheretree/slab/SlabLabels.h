// SPDX-License-Identifier: Apache-2.0
/// @file slab/SlabLabels.h
/// @brief Where the power labels of a slab are kept while others may still ask for them.

#pragma once

#include "../LeafLayout.h"

#include <cstddef>
#include <cstdint>

namespace openvdb_spheretree {
namespace slab {

/// 512 entries a leaf, in leaf order.
template <typename Power>
struct SlabLabels {
    using Key = typename Power::Key;
    using Offset = typename Power::Offset;

    uint32_t firstLeaf = 0;
    Key* keys = nullptr;                                ///< after the passes along z and y
    Offset *dx = nullptr, *dy = nullptr, *dz = nullptr; ///< dz is null in two dimensions
    LeafMask* marks = nullptr; ///< one a leaf: where labels lead to along x

    Key* keysOf(uint32_t leaf) const { return keys + place(leaf); }
    Offset* dxOf(uint32_t leaf) const { return dx + place(leaf); }
    Offset* dyOf(uint32_t leaf) const { return dy + place(leaf); }
    Offset* dzOf(uint32_t leaf) const { return dz + place(leaf); }
    LeafMask& marksOf(uint32_t leaf) const { return marks[leaf - firstLeaf]; }

private:
    std::size_t place(uint32_t leaf) const { return std::size_t(leaf - firstLeaf) * kLeafVoxels; }
};

} // namespace slab
} // namespace openvdb_spheretree
