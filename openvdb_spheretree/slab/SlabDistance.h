// SPDX-License-Identifier: Apache-2.0
/// @file SlabDistance.h
/// @brief The exact distances of one slab, while its values are in the cache.
///
/// Squares along x come straight from mask words (XGaps.h) into rows along y. The passes along y
/// and z work on rows of 64 lanes (MinPlus.h), with each leaf transposed in between.

#pragma once

#include "SlabRows.h"
#include "XGaps.h"
#include <openvdb_spheretree/kernel/LeafRows.h>
#include <openvdb_spheretree/kernel/LeafTranspose.h>
#include <openvdb_spheretree/kernel/MinPlus.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <cstdint>

namespace openvdb_spheretree::slab {

/// The type of the gaps whose squares are T.
template <typename T>
using GapOf = std::conditional_t<sizeof(T) == 2, uint8_t, uint16_t>;

/// Memory of one thread, for one slab after the other.
template <typename T>
class SlabDistance {
public:
    /// Calls visit(run, rows) for every run of the slab along its last axis, which is z, or y where
    /// @a dim is 2, with the squared distances as rows of that axis (LeafRows.h). They are
    /// exact as long as all stay below detail::kNarrowMax (kWideMax).
    template <typename Visit>
    void forEachRun(const LeafLayout& layout, uint32_t slab, const XGaps<GapOf<T>>& gaps, int dim,
        const Visit& visit)
    {
        if (dim == 3) mAlongZ.open(layout, slab, Axis::Z);
        const LeafLayout::Slab alongY = layout.runsOfSlab(Axis::Y, slab);
        for (uint32_t index = alongY.begin; index < alongY.end; ++index) {
            const LeafLayout::Run run = layout.run(Axis::Y, index);
            const int rows = int(run.count) * kLeafDim;
            T* in = mIn.rows(rows, 1);
            T* out = mOut.rows(rows);
            for (uint32_t i = 0; i < run.count; ++i) {
                gaps.squares(run.leaves[i], in + std::size_t(i) * kLeafVoxels);
            }
            detail::minPlus(in, out, rows, mEnvelope);
            if (dim == 2) visit(run, out);
            for (uint32_t i = 0; dim == 3 && i < run.count; ++i) {
                detail::swapRows(out + std::size_t(i) * kLeafVoxels, mAlongZ.ofLeaf(run.leaves[i]));
            }
        }
        if (dim == 2) return;
        const LeafLayout::Slab alongZ = layout.runsOfSlab(Axis::Z, slab);
        for (uint32_t index = alongZ.begin; index < alongZ.end; ++index) {
            const LeafLayout::Run run = layout.run(Axis::Z, index);
            const int rows = int(run.count) * kLeafDim;
            T* out = mOut.rows(rows);
            detail::minPlus(mAlongZ.ofRun(index), out, rows, mEnvelope);
            visit(run, out);
        }
    }

private:
    SlabRows<T> mAlongZ;
    detail::RowBuffer<T> mIn, mOut;
    detail::EnvelopeScratch mEnvelope;
};

} // namespace openvdb_spheretree::slab
