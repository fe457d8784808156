// SPDX-License-Identifier: Apache-2.0
/// @file TestRigidTransform.cc
/// @brief Rotations and translations, and matrices that are none.

#include "QuerySamples.h"
#include "support/Messages.h"

#include <openvdb_spheretree/query/RigidTransform.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Mat3d;
using openvdb::Vec3d;

template <typename Make>
std::string refusal(const Make& make)
{
    return messageOf<openvdb::ValueError>([&] { make(); });
}

void expectNear(const Vec3d& a, const Vec3d& b, double tolerance = 1e-12)
{
    EXPECT_LE((a - b).length(), tolerance) << a << " and " << b;
}

} // namespace

TEST(RigidTransform, TurnsByTheRightHandRuleThenMoves)
{
    const auto quarter = RigidTransform::fromRotation(Vec3d(0, 0, 5), M_PI / 2);
    expectNear(quarter * Vec3d(1, 0, 0), Vec3d(0, 1, 0));
    const auto moved = RigidTransform::fromTranslation(Vec3d(1, 2, 3));
    expectNear((moved * quarter) * Vec3d(1, 0, 0), Vec3d(1, 3, 3));
    expectNear((quarter * moved) * Vec3d(1, 0, 0), Vec3d(-2, 2, 3));
    expectNear(moved.rotate(Vec3d(4, 5, 6)), Vec3d(4, 5, 6));
}

TEST(RigidTransform, ReadsTheRowsOfAMatrix)
{
    const auto m = RigidTransform::fromMatrix({0, -1, 0, 10, 1, 0, 0, 20, 0, 0, 1, 30, 0, 0, 0, 1});
    expectNear(m * Vec3d(1, 2, 3), Vec3d(8, 21, 33));
}

TEST(RigidTransform, UndoesWhatItDoes)
{
    Random random(1);
    for (int i = 0; i < 100; ++i) {
        const auto pose =
            RigidTransform::fromTranslation(5 * randomDirection(random)) * randomRotation(random);
        const Vec3d p = 3 * randomDirection(random);
        expectNear(pose.inverse() * (pose * p), p);
        expectNear((pose.inverse() * pose) * p, p);
        EXPECT_NEAR((pose * p - pose * Vec3d(0, 0, 0)).length(), 3, 1e-12);
    }
}

TEST(RigidTransform, MakesAnAlmostRotationOne)
{
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        Mat3d rounded = randomRotation(random).rotation();
        for (int k = 0; k < 9; ++k) rounded.asPointer()[k] += uniform(random, -1e-6, 1e-6);
        const Mat3d m = RigidTransform(rounded, Vec3d(0, 0, 0)).rotation();
        EXPECT_TRUE((m * m.transpose()).eq(Mat3d::identity(), 1e-15));
        EXPECT_TRUE(m.eq(rounded, 3e-6));
    }
}

TEST(RigidTransform, RefusesWhatIsNotRigidAndSaysHowFarOff)
{
    const Vec3d none(0, 0, 0);
    const auto refused = [&](const Mat3d& m) { return refusal([&] { RigidTransform(m, none); }); };
    EXPECT_NE(refused(Mat3d::identity() * 2.0).find("off the identity by 3"), std::string::npos);
    EXPECT_NE(refused(Mat3d::identity() * 2.0).find("It scales by 2"), std::string::npos);
    const Mat3d sheared(1.0, 0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    EXPECT_NE(refused(sheared).find("off the identity by 0.1"), std::string::npos);
    EXPECT_EQ(refused(sheared).find("It scales"), std::string::npos);
    EXPECT_NE(refused(Mat3d(-1, 0, 0, 0, 1, 0, 0, 0, 1)).find("mirrors"), std::string::npos);
    EXPECT_NE(refused(Mat3d(0, 0, 0, 0, 0, 0, 0, 0, 0)).find("not rigid"), std::string::npos);
    EXPECT_NO_THROW(RigidTransform(Mat3d(1 + 4e-6, 0., 0., 0., 1., 0., 0., 0., 1.), none));
    EXPECT_NE(refused(Mat3d(1 + 6e-6, 0., 0., 0., 1., 0., 0., 0., 1.)), "");
}

TEST(RigidTransform, RefusesWhatIsNoNumber)
{
    const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
    EXPECT_NE(refusal([&] { RigidTransform::fromTranslation(Vec3d(0, nan, 0)); }), "");
    EXPECT_NE(refusal([&] { RigidTransform::fromTranslation(Vec3d(0, 0, infinity)); }), "");
    EXPECT_NE(refusal([&] { RigidTransform::fromRotation(Vec3d(0, 0, 0), 1); }), "");
    EXPECT_NE(refusal([&] { RigidTransform::fromRotation(Vec3d(0, 0, 1), nan); }), "");
    EXPECT_NE(refusal([&] {
        RigidTransform(Mat3d(nan, 0., 0., 0., 1., 0., 0., 0., 1.), Vec3d(0, 0, 0));
    }),
        "");
    EXPECT_NE(refusal([&] {
        RigidTransform::fromMatrix({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1});
    }).find("last row"),
        std::string::npos);
}

TEST(RigidTransform, TurnsAboutTheTiniestAxis)
{
    expectNear(
        RigidTransform::fromRotation(Vec3d(0, 0, 1e-300), M_PI) * Vec3d(1, 0, 0), Vec3d(-1, 0, 0));
}
