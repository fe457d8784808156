// SPDX-License-Identifier: Apache-2.0
#include "BallReach.h"

#include <openvdb_spheretree/base/IntegerRoot.h>

#include <algorithm>
#include <limits>

namespace openvdb_spheretree::tight {

openvdb::CoordBBox ballBox(const ExactSphere& ball)
{
    openvdb::CoordBBox box;
    if (ball.empty()) return box;
    const int64_t reach = detail::floorSqrt(ball.radiusSq);
    for (int a = 0; a < 3; ++a) {
        const int64_t lo = (ball.center[a] - reach + kFine - 1) >> kFineShift;
        const int64_t hi = (ball.center[a] + reach) >> kFineShift;
        if (lo > hi) return {};
        constexpr int64_t kLeast = std::numeric_limits<int32_t>::min() + 8;
        constexpr int64_t kMost = std::numeric_limits<int32_t>::max() - 8;
        box.min()[a] = int32_t(std::max(kLeast, std::min(kMost, lo)));
        box.max()[a] = int32_t(std::max(kLeast, std::min(kMost, hi)));
    }
    return box;
}

} // namespace openvdb_spheretree::tight
