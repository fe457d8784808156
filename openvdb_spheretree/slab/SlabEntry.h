// SPDX-License-Identifier: Apache-2.0
/// @file SlabEntry.h
/// @brief How a slab enters: its distances, and what of the power labels stays within it.

#pragma once

#include "SlabDistance.h"
#include "SlabPower.h"
#include "XSteps.h"
#include <openvdb_spheretree/base/Stage.h>

#include <algorithm>
#include <cstdint>

namespace openvdb_spheretree {
namespace slab {

/// Memory of one thread; sees slab after slab.
template <typename Power, typename T>
class SlabEntry {
public:
    /// @param labels  receives keys and steps along y and z
    /// @return the largest squared distance.
    uint32_t enter(const LeafLayout& layout, uint32_t slab, const XSteps<StepOf<T>>& steps, int dim,
        const SlabLabels<Power>& labels)
    {
        const detail::Stage all("", nullptr, &seconds);
        uint32_t largest = 0;
        mPower.open(layout, slab, dim);
        mDistance.forEachRun(
            layout, slab, steps, dim, [&](const LeafLayout::Run& run, const T* rows) {
                const detail::Stage stage("", nullptr, &powerSeconds);
                largest = std::max(largest,
                    dim == 3 ? mPower.alongZ(run, rows, labels) : mPower.fromY(run, rows, labels));
            });
        const detail::Stage stage("", nullptr, &powerSeconds);
        if (dim == 3) mPower.alongY(layout, slab, labels);
        return largest;
    }

    double seconds = 0, powerSeconds = 0; ///< all so far, and those of power

private:
    SlabDistance<T> mDistance;
    SlabPower<Power> mPower;
};

} // namespace slab
} // namespace openvdb_spheretree
