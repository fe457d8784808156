// SPDX-License-Identifier: Apache-2.0
/// @file TestPowerTree.cc
/// @brief The nearest ball by power against a look at all of them.

#include "support/RandomObjects.h"

#include <openvdb_spheretree/index/PowerTree.h>

#include <gtest/gtest.h>

#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

TEST(PowerSearch, FindsWhatALookAtAllBallsFinds)
{
    Random random(3);
    for (int i = 0; i < 40; ++i) {
        std::vector<MedialBall> balls;
        const int width = random.between(1, 60);
        for (int n = random.between(1, 300); n > 0; --n) {
            balls.push_back({random.coord(-width, width), random.between(1, 1 + width * width)});
        }
        const detail::PowerSearch search(balls);
        for (int j = 0; j < 100; ++j) {
            const Coord voxel = random.coord(-width - 3, width + 3);
            int32_t expected = 0;
            const auto power = [&](int32_t b) {
                return squaredDistance(balls[b].center, voxel) - balls[b].radiusSq;
            };
            for (int32_t b = 1; b < int32_t(balls.size()); ++b) {
                if (power(b) < power(expected)) expected = b;
            }
            ASSERT_EQ(search.nearest(voxel), expected);
        }
    }
}

} // namespace
