// SPDX-License-Identifier: Apache-2.0
#include "DilatedCover.h"

#include "BallPruning.h"
#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/tight/fit/FineSphere.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::tight {

namespace {

/// @return by how much balls are dilated so that one in @a ratio is left, in 1/16 voxel. It was
/// measured for models, scans and thin structures: 1 + 3 x + x^2 for x voxels, within a fifth of
/// it.
int64_t dilationFor(double ratio)
{
    const double most = double(kMostPerDilated);
    const double voxels = (std::sqrt(5 + 4 * std::clamp(ratio, 1.0, most)) - 3) / 2;
    return std::llround(double(kFine) * voxels);
}

std::vector<ExactSphere> dilated(const std::vector<ExactSphere>& balls, int64_t by)
{
    std::vector<ExactSphere> large(balls);
    for (ExactSphere& ball : large) {
        const int64_t radius = detail::ceilSqrt(ball.radiusSq) + by;
        ball.radiusSq = radius * radius;
    }
    return large;
}

} // namespace

std::vector<ExactSphere> dilatedCover(const std::vector<ExactSphere>& balls, int64_t about,
    int64_t least, const SampleLevel& object, openvdb::util::NullInterrupter* interrupter)
{
    const double ratio = double(balls.size()) / double(about);
    for (int64_t by = dilationFor(ratio); by > 0; by /= 2) {
        const std::vector<ExactSphere> large = dilated(balls, by);
        std::vector<ExactSphere> cover;
        for (const int32_t i : prunedBalls(large, object, interrupter)) cover.push_back(large[i]);
        if (cover.size() == balls.size()) break;
        if (int64_t(cover.size()) >= least) return cover;
    }
    return balls;
}

} // namespace openvdb_spheretree::tight
