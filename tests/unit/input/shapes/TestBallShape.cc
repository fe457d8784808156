// SPDX-License-Identifier: Apache-2.0
/// @file TestBallShape.cc
/// @brief The generated ball against its definition, and its tiles.

#include <openvdb_spheretree/input/shapes/BallShape.h>

#include "support/GeneratedShapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

TEST(GeneratedBall, IsTheDigitalBall)
{
    for (const int voxels : {1000, 5000, 70000, 1000000}) {
        const int64_t radiusSq = detail::SolidBall(voxels).radiusSq();
        const double volume = 4.18879020478639 * std::pow(double(radiusSq), 1.5);
        EXPECT_LE(volume, voxels * 1.000001);
        const int r = int(std::sqrt(double(radiusSq))) + 1;
        expectRule(*made(Shape::Ball, voxels), CoordBBox(Coord(-r), Coord(r)), [&](const Coord& q) {
            return int64_t(q[0]) * q[0] + int64_t(q[1]) * q[1] + int64_t(q[2]) * q[2] < radiusSq;
        });
    }
}

TEST(GeneratedBall, IsTilesInside)
{
    const auto grid = made(Shape::Ball, 113097336); // radius 300
    const auto& tree = grid->tree();
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) ASSERT_FALSE(leaf->isDense());
    EXPECT_EQ(tree.getValueDepth(Coord(0)), 1);         // a tile of 128^3
    EXPECT_EQ(tree.getValueDepth(Coord(0, 0, 280)), 2); // of 8^3
    EXPECT_TRUE(tree.isValueOn(Coord(0)));
    EXPECT_LT(tree.leafCount(), 40000u);
}

} // namespace
