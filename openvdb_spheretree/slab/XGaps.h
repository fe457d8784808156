// SPDX-License-Identifier: Apache-2.0
/// @file XGaps.h
/// @brief The gaps along x at both ends of every leaf: how far the background is from there.
///
/// A slab needs nothing else of the other slabs: with these numbers, its distances along x follow
/// from its own mask words. Each run of leaves is swept both ways, on words alone. Cost: 128 gaps a
/// leaf.

#pragma once

#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/kernel/BackgroundGaps.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <cstring>

namespace openvdb_spheretree::slab {

/// @tparam Gap  uint8_t or uint16_t; larger gaps stay at its largest number
template <typename Gap>
class XGaps {
public:
    /// @param layout  kept by reference
    XGaps(const LeafLayout& layout, openvdb::util::NullInterrupter* interrupter)
        : mLayout(layout), mGaps(detail::makeLargeArray<Gap>(std::size_t(layout.leafCount()) * 128))
    {
        detail::parallelFor(layout.runCount(Axis::X), interrupter, [&](std::size_t index) {
            const LeafLayout::Run run = layout.run(Axis::X, uint32_t(index));
            const uint32_t *leaf = run.leaves, last = run.count - 1;
            std::memset(below(leaf[0]), 0, 64 * sizeof(Gap));
            for (uint32_t i = 0; i < last; ++i) {
                gapsThrough(
                    layout.mask(leaf[i]), below(leaf[i]), below(leaf[i + 1]), /*back=*/false);
            }
            std::memset(above(leaf[last]), 0, 64 * sizeof(Gap));
            for (uint32_t i = last; i > 0; --i) {
                gapsThrough(
                    layout.mask(leaf[i]), above(leaf[i]), above(leaf[i - 1]), /*back=*/true);
            }
        });
    }

    /// @brief The squared distance to the background on a voxel's own line along x.
    /// @param rows  receives them as rows across y (LeafRows.h), 0 for background; Square is twice
    ///              as wide as Gap
    template <typename Square>
    void squares(uint32_t leaf, Square* rows) const
    {
        squaresOfGaps(mLayout.mask(leaf), below(leaf), above(leaf), rows);
    }

private:
    /// Of the last voxels before the leaf, looking back, and of the first ones behind it, looking
    /// on.
    Gap* below(uint32_t leaf) const { return mGaps.get() + std::size_t(leaf) * 128; }
    Gap* above(uint32_t leaf) const { return below(leaf) + 64; }

    const LeafLayout& mLayout;
    detail::LargeArray<Gap> mGaps;
};

} // namespace openvdb_spheretree::slab
