// SPDX-License-Identifier: Apache-2.0
#include "SharedVoxels.h"

#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/tight/fit/BallGrid.h>

#include <algorithm>

namespace openvdb_spheretree::nearest {

namespace {

using detail::square;
using tight::kFine;
using tight::kFineShift;

/// Voxels from first to last along an axis; none if first > last.
struct VoxelRange {
    int64_t first, last;

    VoxelRange(int64_t center, int64_t restSq) : first(INT64_MAX), last(INT64_MIN)
    {
        if (restSq < 0) return;
        const int64_t reach = detail::floorSqrt(restSq);
        first = (center - reach + kFine - 1) >> kFineShift;
        last = (center + reach) >> kFineShift;
    }
    VoxelRange meet(const VoxelRange& other) const
    {
        VoxelRange both = *this;
        both.first = std::max(first, other.first);
        both.last = std::min(last, other.last);
        return both;
    }
};

/// What is left of a squared radius at a voxel's coordinate along an axis.
int64_t restAt(const ExactSphere& sphere, int64_t restSq, int axis, int64_t voxel)
{
    return restSq - square(kFine * voxel - sphere.center[axis]);
}

} // namespace

int64_t sharedVoxels(const ExactSphere& a, const ExactSphere& b, bool flat)
{
    int64_t count = 0;
    const VoxelRange alongX = VoxelRange(a.center[0], a.radiusSq).meet({b.center[0], b.radiusSq});
    for (int64_t x = alongX.first; x <= alongX.last; ++x) {
        const int64_t ax = restAt(a, a.radiusSq, 0, x), bx = restAt(b, b.radiusSq, 0, x);
        const VoxelRange alongY = VoxelRange(a.center[1], ax).meet({b.center[1], bx});
        for (int64_t y = alongY.first; y <= alongY.last; ++y) {
            const int64_t ay = restAt(a, ax, 1, y), by = restAt(b, bx, 1, y);
            VoxelRange row = VoxelRange(a.center[2], ay).meet({b.center[2], by});
            if (flat) {
                row.first = std::max<int64_t>(row.first, 0);
                row.last = std::min<int64_t>(row.last, 0);
            }
            count += std::max<int64_t>(row.last - row.first + 1, 0);
        }
    }
    return count;
}

std::vector<int32_t> parentsOf(const std::vector<ExactSphere>& spheres,
    const std::vector<ExactSphere>& above, bool flat, openvdb::util::NullInterrupter* interrupter)
{
    const tight::BallGrid grid(above);
    std::vector<int32_t> parents(spheres.size());
    detail::parallelFor(spheres.size(), interrupter, [&](std::size_t i) {
        int64_t most = 0;
        for (const int32_t other : grid.near(spheres[i], 1)) {
            const int64_t shared = sharedVoxels(spheres[i], above[other], flat);
            if (shared <= most) continue;
            most = shared;
            parents[i] = other;
        }
        if (most == 0) parents[i] = grid.nearest(/*id=*/-1, spheres[i], 1).front();
    });
    return parents;
}

} // namespace openvdb_spheretree::nearest
