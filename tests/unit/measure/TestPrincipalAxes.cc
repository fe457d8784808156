// SPDX-License-Identifier: Apache-2.0
/// @file TestPrincipalAxes.cc
/// @brief Eigenvalues and frames of symmetric matrices that were made of them.

#include <openvdb_spheretree/measure/PrincipalAxes.h>

#include <gtest/gtest.h>
#include <openvdb/math/Quat.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <random>

namespace {

using openvdb::Mat3d;
using openvdb::Vec3d;
using openvdb_spheretree::detail::principalAxes;
using openvdb_spheretree::detail::PrincipalAxes;

Mat3d diagonal(const Vec3d& moments)
{
    Mat3d matrix = Mat3d::zero();
    for (int a = 0; a < 3; ++a) matrix(a, a) = moments[a];
    return matrix;
}

Mat3d turned(const Mat3d& matrix, const Mat3d& rotation)
{
    const Mat3d result = rotation.transpose() * matrix * rotation;
    return 0.5 * (result + result.transpose());
}

Mat3d randomRotation(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    openvdb::math::Quat<double> q(normal(random), normal(random), normal(random), normal(random));
    q.normalize();
    return Mat3d(q);
}

/// They are a right-handed frame, and make the matrix again.
void expectFrameOf(const Mat3d& matrix, const PrincipalAxes& found)
{
    const double size = std::max(found.moments[2], -found.moments[0]);
    const Mat3d again = turned(diagonal(found.moments), found.axes);
    const Mat3d unit = found.axes * found.axes.transpose();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            EXPECT_NEAR(again(i, j), matrix(i, j), 1e-13 * size);
            EXPECT_NEAR(unit(i, j), i == j, 1e-14);
        }
    }
    EXPECT_NEAR(found.axes.det(), 1, 1e-14);
    EXPECT_LE(found.moments[0], found.moments[1] + 1e-13 * size);
    EXPECT_LE(found.moments[1], found.moments[2] + 1e-13 * size);
}

TEST(PrincipalAxes, AreFoundOfTurnedMatricesOfAnySize)
{
    std::mt19937 random(1);
    const Vec3d shapes[] = {Vec3d(1, 2, 3), Vec3d(1, 1, 2), Vec3d(1, 2, 2), Vec3d(1, 1, 1),
        Vec3d(0, 1, 1), Vec3d(1e-9, 1, 1 + 1e-9), Vec3d(-1, 0, 4)};
    for (const double scale : {1.0, 1e-15, 1e-60, 1e18}) {
        for (const Vec3d& shape : shapes) {
            for (int i = 0; i < 50; ++i) {
                const Mat3d matrix = turned(diagonal(scale * shape), randomRotation(random));
                const PrincipalAxes found = principalAxes(matrix);
                expectFrameOf(matrix, found);
                for (int a = 0; a < 3; ++a) {
                    EXPECT_NEAR(found.moments[a], scale * shape[a], 1e-13 * scale * shape[2]);
                }
            }
        }
    }
}

TEST(PrincipalAxes, OfADiagonalMatrixAreTheAxesInTheOrderOfTheirMoments)
{
    const PrincipalAxes found = principalAxes(diagonal(Vec3d(3, 1, 2)));
    EXPECT_EQ(found.moments, Vec3d(1, 2, 3));
    EXPECT_EQ(found.axes, Mat3d(0, 1, 0, 0, 0, 1, 1, 0, 0));
}

TEST(PrincipalAxes, OfABallThatWasTurnedAreTheAxesOfTheWorld)
{
    std::mt19937 random(2);
    for (int i = 0; i < 100; ++i) {
        const Mat3d ball = turned(diagonal(Vec3d(0.4)), randomRotation(random));
        EXPECT_EQ(principalAxes(ball).axes, Mat3d::identity());
    }
}

TEST(PrincipalAxes, OfNothingAreTheAxesOfTheWorld)
{
    const PrincipalAxes found = principalAxes(Mat3d::zero());
    EXPECT_EQ(found.moments, Vec3d(0));
    EXPECT_EQ(found.axes, Mat3d::identity());
}

TEST(PrincipalAxes, PointAlongTheirLargestCoordinate)
{
    std::mt19937 random(3);
    for (int i = 0; i < 100; ++i) {
        const auto axes =
            principalAxes(turned(diagonal(Vec3d(1, 2, 4)), randomRotation(random))).axes;
        for (int row = 0; row < 2; ++row) {
            const Vec3d axis = axes.row(row);
            EXPECT_EQ(std::max({axis[0], axis[1], axis[2]}),
                std::max({std::abs(axis[0]), std::abs(axis[1]), std::abs(axis[2])}));
        }
    }
    // As large but for rounding: the first one.
    const Mat3d edge(
        1.5, -0.5, 0.0, -0.5, 1.5, 0.0, 0.0, 0.0, 9.0); // moments 1, 2, 9 along (1,1) and (1,-1)
    EXPECT_GT(principalAxes(edge).axes(1, 0), 0);
    EXPECT_LT(principalAxes(edge).axes(1, 1), 0);
}

} // namespace
