// SPDX-License-Identifier: Apache-2.0
/// @file XSteps.h
/// @brief How far from each leaf the background is along x, beyond the leaf itself.
///
/// With these numbers a slab knows everything that it needs of the others: its distances along x
/// follow from its own mask words. Each run of leaves is swept both ways, on words alone.
///
/// Cost: 128 steps a leaf.

#pragma once

#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>

namespace openvdb_spheretree {
namespace slab {

/// @tparam Step  uint8_t or uint16_t; larger numbers stay at its largest one
template <typename Step>
class XSteps {
public:
    /// @param layout  kept by reference
    XSteps(const LeafLayout& layout, openvdb::util::NullInterrupter* interrupter);

    /// @brief The squared distance to the background on a voxel's own line along x.
    /// @param rows  receives them as rows across y (detail/LeafRows.h), 0 for background; Square is
    ///              twice as wide as Step
    template <typename Square>
    void squares(uint32_t leaf, Square* rows) const;

private:
    /// Steps from the last voxel before the leaf, and from the first one behind it, a lane 8 y + z.
    Step* below(uint32_t leaf) const { return mSteps.get() + std::size_t(leaf) * 128; }
    Step* above(uint32_t leaf) const { return below(leaf) + 64; }
    void sweep(LeafLayout::Run run);

    const LeafLayout& mLayout;
    detail::LargeArray<Step> mSteps;
};

} // namespace slab
} // namespace openvdb_spheretree
