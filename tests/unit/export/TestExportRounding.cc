// SPDX-License-Identifier: Apache-2.0
// Spheres rounded to the numbers of a file still hold, or lie in, those that they stand for.

#include <openvdb_spheretree/export/ExportRounding.h>

#include <openvdb/Exceptions.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace openvdb_spheretree;
using detail::decimalsFor;
using detail::KeepSphere;
using detail::RoundedSphere;
using detail::SphereRounding;
using openvdb::Vec3d;

namespace {

/// In numbers with more digits than those that are rounded.
bool contains(const Vec3d& center, double radius, const Vec3d& innerCenter, double innerRadius)
{
    long double movedSq = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const long double moved = (long double)(center[axis]) - innerCenter[axis];
        movedSq += moved * moved;
    }
    const long double slack = (long double)(radius)-innerRadius;
    // Of squares of 64 digits, the last may be wrong.
    return slack >= 0 && slack * slack >= movedSq * (1 - 1e-18L);
}

struct Case {
    Vec3d center;
    double radius;
};

std::vector<Case> someSpheres()
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1), exponent(-6, 6);
    std::vector<Case> cases = {{{0, 0, 0}, 0}, {{1, 2, 3}, 0}, {{0.1, -0.1, 1e-9}, 0.3}};
    for (int i = 0; i < 20000; ++i) {
        const double size = std::pow(10.0, exponent(random));
        const double radius = std::abs(unit(random)) * std::pow(10.0, exponent(random));
        cases.push_back({Vec3d(unit(random), unit(random), unit(random)) * size, radius});
    }
    return cases;
}

TEST(ExportRounding, SpheresAroundAnObjectStayAroundIt)
{
    for (const Case& sphere : someSpheres()) {
        for (const int decimals : {0, 3, 6}) {
            const SphereRounding round(ExportNumbers::Decimal, decimals, KeepSphere::Covered);
            const RoundedSphere rounded = round(sphere.center, sphere.radius, 0);
            ASSERT_TRUE(contains(rounded.center, rounded.radius, sphere.center, sphere.radius));
            const double unit = std::pow(10.0, -decimals);
            EXPECT_LE(rounded.radius, sphere.radius + 1.9 * unit + 1e-15 * sphere.radius);
        }
        const SphereRounding round(ExportNumbers::Float, 0, KeepSphere::Covered);
        const RoundedSphere rounded = round(sphere.center, sphere.radius, 0);
        ASSERT_TRUE(contains(rounded.center, rounded.radius, sphere.center, sphere.radius));
        EXPECT_EQ(double(float(rounded.radius)), rounded.radius);
        EXPECT_EQ(double(float(rounded.center[0])), rounded.center[0]);
    }
}

TEST(ExportRounding, SpheresInsideAnObjectStayInside)
{
    for (const Case& sphere : someSpheres()) {
        for (const ExportNumbers numbers : {ExportNumbers::Decimal, ExportNumbers::Float}) {
            const SphereRounding round(numbers, 4, KeepSphere::Inside);
            const RoundedSphere rounded = round(sphere.center, sphere.radius, 0);
            EXPECT_GE(rounded.radius, 0);
            if (rounded.radius == 0) continue; // it is no ball any more
            ASSERT_TRUE(contains(sphere.center, sphere.radius, rounded.center, rounded.radius));
        }
    }
}

TEST(ExportRounding, OthersAreRoundedToNearest)
{
    const SphereRounding round(ExportNumbers::Decimal, 2, KeepSphere::Nearest);
    const RoundedSphere rounded = round({0.126, -0.124, 5}, 0.374, 0);
    EXPECT_EQ(rounded.center, Vec3d(0.13, -0.12, 5));
    EXPECT_EQ(rounded.radius, 0.37);
}

TEST(ExportRounding, WhatTheCenterIsOffByAlreadyCounts)
{
    const Vec3d center(1, 2, 3);
    const SphereRounding around(ExportNumbers::Double, 0, KeepSphere::Covered);
    EXPECT_EQ(around(center, 1, 0.25).radius, 1.25);
    const SphereRounding inside(ExportNumbers::Double, 0, KeepSphere::Inside);
    EXPECT_EQ(inside(center, 1, 0.25).radius, 0.75);
    EXPECT_EQ(inside(center, 0.125, 0.25).radius, 0);
}

TEST(ExportRounding, DecimalsAreAMillionthOfTheSmallestRadius)
{
    EXPECT_EQ(decimalsFor(1, 1), 6);
    EXPECT_EQ(decimalsFor(0.5, 100), 7);
    EXPECT_EQ(decimalsFor(1e6, 1e6), 0);
    EXPECT_EQ(decimalsFor(1e-3, 1), 9);
    // Not all of them would fit 52 bits: 1e9 with 6 are 50, with 7 are 54.
    EXPECT_EQ(decimalsFor(1e-3, 1e9), 6);
    EXPECT_EQ(decimalsFor(1e-30, 1e-30), 22);
    EXPECT_EQ(decimalsFor(std::numeric_limits<double>::infinity(), 0), 0);
}

TEST(ExportRounding, NumbersThatAFileCannotHoldAreRefused)
{
    const double infinity = std::numeric_limits<double>::infinity();
    for (const ExportNumbers numbers : {ExportNumbers::Decimal, ExportNumbers::Float}) {
        const SphereRounding round(numbers, 3, KeepSphere::Covered);
        EXPECT_THROW(round({infinity, 0, 0}, 1, 0), openvdb::ValueError);
        EXPECT_THROW(round({std::nan(""), 0, 0}, 1, 0), openvdb::ValueError);
        EXPECT_THROW(round({0, 0, 0}, infinity, 0), openvdb::ValueError);
    }
    const SphereRounding floats(ExportNumbers::Float, 0, KeepSphere::Covered);
    EXPECT_THROW(floats({1e39, 0, 0}, 1, 0), openvdb::ValueError);
    EXPECT_THROW(floats({0, 0, 0}, 1e39, 0), openvdb::ValueError);
}

} // namespace
