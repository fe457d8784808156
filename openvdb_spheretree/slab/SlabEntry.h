// SPDX-License-Identifier: Apache-2.0
/// @file SlabEntry.h
/// @brief How a slab enters: its distances, and the passes of the power labels within it.

#pragma once

#include "SlabDistance.h"
#include "SlabPower.h"
#include "XGaps.h"
#include <openvdb_spheretree/base/Stage.h>

#include <algorithm>
#include <cstdint>

namespace openvdb_spheretree {
namespace slab {

/// Memory of one thread, for one slab after the other.
template <typename Power, typename T>
class SlabEntry {
public:
    /// @param labels  receives keys, and offsets along y and z
    /// @return the largest squared distance.
    uint32_t enter(const LeafLayout& layout, uint32_t slab, const XGaps<GapOf<T>>& gaps, int dim,
        const SlabLabels<Power>& labels)
    {
        const detail::Stage all("", nullptr, &seconds);
        uint32_t largest = 0;
        mPower.open(layout, slab, dim);
        mDistance.forEachRun(
            layout, slab, gaps, dim, [&](const LeafLayout::Run& run, const T* rows) {
                const detail::Stage stage("", nullptr, &powerSeconds);
                largest = std::max(largest,
                    dim == 3 ? mPower.alongZ(run, rows, labels) : mPower.fromY(run, rows, labels));
            });
        const detail::Stage stage("", nullptr, &powerSeconds);
        if (dim == 3) mPower.alongY(layout, slab, labels);
        return largest;
    }

    double seconds = 0, powerSeconds = 0; ///< in all, and in the passes of power labels

private:
    SlabDistance<T> mDistance;
    SlabPower<Power> mPower;
};

} // namespace slab
} // namespace openvdb_spheretree
