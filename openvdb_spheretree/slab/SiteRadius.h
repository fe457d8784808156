// SPDX-License-Identifier: Apache-2.0
/// @file slab/SiteRadius.h
/// @brief The radius of a medial ball, from what a slab keeps.
///
/// A key holds the radiusSq of the site that it came from. A ball's centre is mostly its own site, as
/// far as y and z go, and then it is in its own key. But a site need not lie in its own cell. Then it
/// is in the keys of the voxels that the labels came from: back along z, then along y.

#pragma once

#include "../LeafLayout.h"
#include "../PowerMap.h"
#include "../detail/MaxPlus.h"
#include "SlabLabels.h"

#include <openvdb/Exceptions.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace openvdb_spheretree {
namespace slab {

/// Of the balls of one slab.
template <typename Power>
class SiteRadius {
    using Voxel = PowerMap::Voxel;

public:
    /// @param alongY  where labels lead to along x, then y: one mask for each leaf of the slab. All are
    ///                kept by reference.
    SiteRadius(const LeafLayout& layout, const SlabLabels<Power>& labels,
        const std::vector<LeafMask>& alongY)
        : mLayout(layout), mLabels(labels), mAlongY(alongY)
    {}

    /// @param site  a voxel that labels lead to
    int32_t radiusSq(Voxel site) const
    {
        if (step(Axis::Y, site) == 0 && step(Axis::Z, site) == 0) return radiusIn(site);
        std::optional<int32_t> found = throughZ(site);
        if (found) return *found;
        OPENVDB_THROW(openvdb::RuntimeError,
            "no voxel has the label " << mLayout.voxel(site.leaf, site.offset));
    }

private:
    int32_t radiusIn(Voxel voxel) const
    {
        return int32_t(detail::siteSqOf<Power>(mLabels.keysOf(voxel.leaf)[voxel.offset]));
    }
    int step(Axis axis, Voxel voxel) const
    {
        if (axis == Axis::Y) return mLabels.dyOf(voxel.leaf)[voxel.offset];
        return mLabels.dz ? mLabels.dzOf(voxel.leaf)[voxel.offset] : 0;
    }

    std::optional<int32_t> throughZ(Voxel site) const
    {
        if (!mLabels.dz) return throughY(site);
        std::optional<int32_t> found;
        forEachOrigin(Axis::Z, site, [&](Voxel voxel) {
            if (isOn(mAlongY[voxel.leaf - mLabels.firstLeaf], voxel.offset))
                found = throughY(voxel);
            return found.has_value();
        });
        return found;
    }

    std::optional<int32_t> throughY(Voxel end) const
    {
        std::optional<int32_t> found;
        forEachOrigin(Axis::Y, end, [&](Voxel voxel) {
            if (isOn(mLabels.marksOf(voxel.leaf), voxel.offset)) found = radiusIn(voxel);
            return found.has_value();
        });
        return found;
    }

    /// Calls visit(voxel) for the object voxels of the line whose step along @a axis leads to @a end,
    /// until one of the calls says that it is enough.
    template <typename Visit>
    void forEachOrigin(Axis axis, Voxel end, const Visit& visit) const
    {
        if (step(axis, end) == 0 && visit(end)) return;
        for (const int direction : {-1, 1}) {
            Voxel voxel = end;
            for (int distance = 1; moveOn(axis, direction, voxel); ++distance) {
                if (step(axis, voxel) == -direction * distance && visit(voxel)) return;
            }
        }
    }

    /// @return whether there was an object voxel to go to.
    bool moveOn(Axis axis, int direction, Voxel& voxel) const
    {
        const int shift = 6 - 3 * int(axis), here = int(voxel.offset >> shift & 7);
        if (here + direction < 0 || here + direction > 7) {
            const auto next = mLayout.touching(voxel.leaf, axis, direction);
            if (!next) return false;
            voxel = {*next, uint32_t(int(voxel.offset) - direction * 7 * (1 << shift))};
        } else {
            voxel.offset = uint32_t(int(voxel.offset) + direction * (1 << shift));
        }
        return isOn(mLayout.mask(voxel.leaf), voxel.offset);
    }

    const LeafLayout& mLayout;
    const SlabLabels<Power>& mLabels;
    const std::vector<LeafMask>& mAlongY;
};

} // namespace slab
} // namespace openvdb_spheretree
