// SPDX-License-Identifier: Apache-2.0
/// @file CoverBall.h
/// @brief A ball of a level that is being made, and the group it is in.
///
/// A level below a finished one has a group for each ball of the finished level: its children. A
/// voxel in a ball counts only if the ancestors of the ball's group hold it, too (GroupedCover.h).
/// All balls of other levels are in group 0.

#pragma once

#include <openvdb_spheretree/tight/fit/FineSphere.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

struct CoverBall {
    ExactSphere ball;
    int32_t group = 0;

    bool empty() const { return ball.empty(); }
};

/// @return the balls, all in group 0.
inline std::vector<CoverBall> ungrouped(const std::vector<ExactSphere>& balls)
{
    std::vector<CoverBall> cover;
    for (const ExactSphere& ball : balls) cover.push_back({ball, 0});
    return cover;
}

/// @return the balls, each in the group of its number.
inline std::vector<CoverBall> eachInItsGroup(const std::vector<ExactSphere>& balls)
{
    std::vector<CoverBall> cover;
    for (const ExactSphere& ball : balls) cover.push_back({ball, int32_t(cover.size())});
    return cover;
}

inline std::vector<ExactSphere> ballsOf(const std::vector<CoverBall>& cover)
{
    std::vector<ExactSphere> balls;
    for (const CoverBall& ball : cover) balls.push_back(ball.ball);
    return balls;
}

inline std::vector<int32_t> groupsOf(const std::vector<CoverBall>& cover)
{
    std::vector<int32_t> groups;
    for (const CoverBall& ball : cover) groups.push_back(ball.group);
    return groups;
}

} // namespace openvdb_spheretree::tight
