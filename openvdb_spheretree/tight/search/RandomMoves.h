// SPDX-License-Identifier: Apache-2.0
/// @file RandomMoves.h
/// @brief Random changes of a ball. They depend on the number of a trial alone.

#pragma once

#include <openvdb_spheretree/base/Hash.h>
#include <openvdb_spheretree/tight/fit/FineSphere.h>

#include <openvdb/math/Math.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace openvdb_spheretree::tight {

/// Random numbers of one trial.
class Dice {
public:
    explicit Dice(uint64_t trial) : mState(detail::hash(trial)) {}
    /// In [0, 1).
    double uniform() { return detail::unitInterval(mState = detail::hash(mState)); }
    std::size_t below(std::size_t n) { return std::min(n - 1, std::size_t(uniform() * double(n))); }

private:
    uint64_t mState;
};

/// @return the ball with a larger radius: up to 1.3 times, or by up to 2.3 voxels.
inline ExactSphere grown(const ExactSphere& ball, Dice& dice)
{
    const double r = ball.radius();
    const double larger = dice.uniform() < 0.5 ? r * (1 + 0.3 * dice.uniform())
                                               : r + double(kFine) * (0.3 + 2 * dice.uniform());
    ExactSphere result = ball;
    result.radiusSq = std::max(ball.radiusSq, int64_t(larger * larger));
    return result;
}

/// @return the ball, moved by @a step (1/16 voxel) in some direction; @a flat: not along z.
inline ExactSphere shifted(const ExactSphere& ball, double step, bool flat, Dice& dice)
{
    const double z = flat ? 0 : 2 * dice.uniform() - 1;
    const double angle = 2 * openvdb::math::pi<double>() * dice.uniform();
    const double xy = std::sqrt(1 - z * z);
    ExactSphere result = ball;
    result.center[0] += std::lrint(step * xy * std::cos(angle));
    result.center[1] += std::lrint(step * xy * std::sin(angle));
    result.center[2] += std::lrint(step * z);
    return result;
}

/// @return about half of the ball: which half, and how much of it, is random.
inline ExactSphere halved(const ExactSphere& ball, bool flat, Dice& dice)
{
    ExactSphere half = shifted(ball, ball.radius() * (0.3 + 0.3 * dice.uniform()), flat, dice);
    const double radius = ball.radius() * (0.55 + 0.3 * dice.uniform());
    half.radiusSq = int64_t(radius * radius);
    return half;
}

} // namespace openvdb_spheretree::tight
