// SPDX-License-Identifier: Apache-2.0
#include "CarriedLevels.h"

#include "PlacedLevels.h"
#include <openvdb_spheretree/base/IntegerRoot.h>

#include <utility>

namespace openvdb_spheretree::tight {

ExactSphere lifted(const ExactSphere& ball, const PyramidStep& step)
{
    // A voxel's children are its middle plus or minus half a voxel along each axis that is halved.
    constexpr int64_t kHalf = kFine / 2;
    constexpr int64_t kToChild[] = {0, 0, 12, 14}; // kHalf times the root of 2, of 3, rounded up
    ExactSphere fine = ball;
    for (int a = 0; a < step.dim; ++a) {
        fine.center[a] = 2 * ball.center[a] + kFine * int64_t(step.origin[a]) + kHalf;
    }
    const int64_t radius = 2 * detail::ceilSqrt(ball.radiusSq) + kToChild[step.dim];
    fine.radiusSq = radius * radius;
    return fine;
}

std::vector<TightLevel> carriedDown(
    std::vector<TightLevel> levels, const PyramidStep& step, int64_t most, const LevelMaker& finer)
{
    for (TightLevel& level : levels) {
        for (ExactSphere& ball : level.balls) ball = lifted(ball, step);
        level.digital.clear();
    }
    return placedLevels(std::move(levels), most, finer);
}

} // namespace openvdb_spheretree::tight
