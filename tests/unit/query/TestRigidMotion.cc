// SPDX-License-Identifier: Apache-2.0
/// @file TestRigidMotion.cc
/// @brief Lines and screws: where they begin and end, and how points go between.

#include "QuerySamples.h"
#include "support/Messages.h"

#include <openvdb_spheretree/query/RigidMotion.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

RigidTransform randomPose(Random& random)
{
    return RigidTransform::fromTranslation(4 * randomDirection(random)) * randomRotation(random);
}

void expectSame(const RigidTransform& a, const RigidTransform& b, double tolerance)
{
    EXPECT_TRUE(a.rotation().eq(b.rotation(), tolerance)) << a.rotation() << b.rotation();
    EXPECT_LE((a.translation() - b.translation()).length(), tolerance);
}

} // namespace

TEST(RigidMotion, AScrewGoesFromItsStartToItsEnd)
{
    Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const RigidTransform start = randomPose(random);
        const double angle = i % 3 == 0 ? std::pow(10.0, uniform(random, -13, 0))
            : i % 3 == 1                ? M_PI - std::pow(10.0, uniform(random, -16, 0))
                                        : uniform(random, 0, M_PI);
        const RigidTransform end = RigidTransform::fromTranslation(randomDirection(random))
            * RigidTransform::fromRotation(randomDirection(random), angle) * start;
        const RigidMotion motion = RigidMotion::screw(start, end);
        expectSame(motion.at(0), start, 1e-11);
        EXPECT_LE(std::abs(motion.radians()), M_PI + 1e-12);
        // An axis far away is known to as many digits as its distance leaves.
        expectSame(motion.at(1), end, 1e-11 + 1e-14 * motion.point().length());
    }
}

TEST(RigidMotion, PointsGoAlongHelicesAtASteadySpeed)
{
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        const RigidMotion motion = RigidMotion::screw(randomPose(random), randomPose(random));
        const Vec3d p = 3 * randomDirection(random);
        const Vec3d from = motion.at(0) * p - motion.point();
        const double radius = from.cross(motion.axis()).length();
        double step = -1;
        for (double t = 0; t < 0.95; t += 0.1) {
            const Vec3d at = motion.at(t) * p - motion.point(),
                        next = motion.at(t + 0.1) * p - motion.point();
            EXPECT_NEAR(at.cross(motion.axis()).length(), radius, 1e-9);
            EXPECT_NEAR((at - from).dot(motion.axis()), t * motion.slide(), 1e-9);
            if (step >= 0) {
                EXPECT_NEAR((next - at).length(), step, 1e-9);
            }
            step = (next - at).length();
        }
    }
}

TEST(RigidMotion, ALineDoesNotTurn)
{
    Random random(3);
    const RigidTransform start = randomPose(random);
    const RigidMotion motion = RigidMotion::line(start, Vec3d(1, 2, 3));
    EXPECT_TRUE(motion.at(0.5).rotation() == start.rotation());
    EXPECT_LE(
        (motion.at(0.5).translation() - start.translation() - Vec3d(0.5, 1, 1.5)).length(), 1e-14);
    expectSame(RigidMotion::line(start, Vec3d(0, 0, 0)).at(1), start, 0);
    const RigidMotion same =
        RigidMotion::screw(start, RigidTransform::fromTranslation(Vec3d(1, 2, 3)) * start);
    EXPECT_LE(
        (same.at(0.5).translation() - start.translation() - Vec3d(0.5, 1, 1.5)).length(), 1e-14);
}

TEST(RigidMotion, TurnsAboutAGivenAxis)
{
    const RigidMotion motion = RigidMotion::screw({}, Vec3d(1, 0, 0), Vec3d(0, 0, 2), M_PI, 4);
    EXPECT_LE((motion.at(0.5) * Vec3d(2, 0, 0) - Vec3d(1, 1, 2)).length(), 1e-12);
    EXPECT_LE((motion.at(1) * Vec3d(2, 0, 0) - Vec3d(0, 0, 4)).length(), 1e-12);
}

TEST(RigidMotion, RefusesWhatIsNoMotion)
{
    const double nan = std::nan("");
    EXPECT_THROW(RigidMotion::line({}, Vec3d(nan, 0, 0)), openvdb::ValueError);
    EXPECT_THROW(RigidMotion::screw({}, Vec3d(0, 0, 0), Vec3d(0, 0, 0), 1, 1), openvdb::ValueError);
    EXPECT_THROW(
        RigidMotion::screw({}, Vec3d(nan, 0, 0), Vec3d(0, 0, 1), 1, 1), openvdb::ValueError);
    EXPECT_THROW(
        RigidMotion::screw({}, Vec3d(0, 0, 0), Vec3d(0, 0, 1), nan, 1), openvdb::ValueError);
    EXPECT_THROW(
        RigidMotion::screw({}, Vec3d(0, 0, 0), Vec3d(0, 0, 1), 1, nan), openvdb::ValueError);
    const std::string message = messageOf<openvdb::ValueError>(
        [] { RigidMotion::screw({}, Vec3d(0, 0, 0), Vec3d(0, 0, 1), 7, 0); });
    EXPECT_TRUE(mentions(message, "divide the motion"));
}
