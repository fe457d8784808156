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

double powerInMiddle(const ExactSphere& ball, const openvdb::CoordBBox& box)
{
    double power = double(ball.radiusSq);
    for (int a = 0; a < 3; ++a) {
        const int64_t twice = kFine * (int64_t(box.min()[a]) + box.max()[a]);
        const double d = 0.5 * double(twice) - double(ball.center[a]);
        power -= d * d;
    }
    return power;
}

bool hasMorePower(const ExactSphere& ball, const ExactSphere& other, const openvdb::CoordBBox& box)
{
    // The difference is linear, so along each axis it is smallest at one of the ends.
    int64_t least = ball.radiusSq - other.radiusSq;
    for (int a = 0; a < 3; ++a) {
        const auto gain = [&](int64_t at) {
            const int64_t mine = kFine * at - ball.center[a], theirs = kFine * at - other.center[a];
            return theirs * theirs - mine * mine;
        };
        least += std::min(gain(box.min()[a]), gain(box.max()[a]));
    }
    return least > 0;
}

} // namespace openvdb_spheretree::tight
