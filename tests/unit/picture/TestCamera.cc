// SPDX-License-Identifier: Apache-2.0
/// @file TestCamera.cc
/// @brief Cameras that see nothing are refused; the view of an object holds all of it.

#include "support/Messages.h"

#include <openvdb_spheretree/picture/Camera.h>

#include <openvdb/math/Math.h>
#include <openvdb/Exceptions.h>
#include <openvdb/math/Transform.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;
using openvdb::math::Transform;

namespace {

constexpr double kPi = openvdb::math::pi<double>();

std::string whyNot(const Camera& camera)
{
    return messageOf<openvdb::ValueError>([&] { camera.validate(); });
}

/// The sine of the angle between the axis of view and the outermost point of a ball.
double sineOfReach(const Camera& camera, const Vec3d& center, double radius)
{
    EXPECT_NEAR((camera.lookAt - center).length(), 0, 1e-9);
    return radius / (camera.eye - center).length();
}

} // namespace

TEST(Camera, OneThatSeesNothingIsRefusedByName)
{
    EXPECT_NO_THROW(Camera().validate());
    Camera camera;
    for (const double fov : {0.0, -1.0, 1e-300, 180.0, 1e9, std::nan("")}) {
        camera.fovDegrees = fov;
        EXPECT_TRUE(mentions(whyNot(camera), "fov="));
    }
    camera = Camera();
    camera.eye = camera.lookAt;
    EXPECT_TRUE(mentions(whyNot(camera), "eye and lookat"));
    for (const Vec3d& up : {Vec3d(0, 0, 3), Vec3d(0, 0, -1), Vec3d(0, 0, 0)}) {
        camera = Camera();
        camera.up = up;
        EXPECT_TRUE(mentions(whyNot(camera), "up="));
    }
    for (const double far : {std::numeric_limits<double>::infinity(), 1e308, -1e101}) {
        camera = Camera();
        camera.eye[1] = far;
        EXPECT_TRUE(mentions(whyNot(camera), "eye="));
        camera = Camera();
        camera.lookAt[0] = far;
        EXPECT_TRUE(mentions(whyNot(camera), "lookat="));
        camera = Camera();
        camera.up[0] = far;
        EXPECT_TRUE(mentions(whyNot(camera), "up="));
    }
    camera = Camera();
    camera.eye[0] = camera.up[1] = 1e99;
    EXPECT_NO_THROW(camera.validate());
    camera.up[1] = 1e-99;
    EXPECT_NO_THROW(camera.validate());
}

TEST(Camera, ThereIsNoViewFromADirectionOrAngleThatIsNone)
{
    const auto transform = Transform::createLinearTransform(1);
    const CoordBBox box(Coord(0), Coord(9));
    EXPECT_THROW(viewOf(box, *transform, Vec3d(1e-320, 0, 0), 30, 1), openvdb::ValueError);
    EXPECT_THROW(viewOf(box, *transform, Vec3d(0, 1, 0), 1e-300, 1), openvdb::ValueError);
}

TEST(Camera, TheViewOfAnObjectJustHoldsTheSphereAroundItsBox)
{
    auto transform = Transform::createLinearTransform(0.25);
    transform->postRotate(0.7, openvdb::math::Y_AXIS);
    transform->postTranslate(Vec3d(1000, -3, 5));
    const CoordBBox box(Coord(-10, 0, 4), Coord(29, 11, 9));
    const Vec3d center = transform->indexToWorld(Vec3d(9.5, 5.5, 6.5));
    const double radius = 0.25 * Vec3d(40, 12, 6).length() / 2;
    for (const Vec3d& up : {Vec3d(0, 1, 0), Vec3d(0, 0, 2), Vec3d(-1, 0, 0), Vec3d(1, 1, 1)}) {
        const Camera wide = viewOf(box, *transform, up, 40, 2);
        EXPECT_NO_THROW(wide.validate());
        EXPECT_NEAR(sineOfReach(wide, center, radius), std::sin(20 * kPi / 180), 1e-9);
        EXPECT_GT((wide.eye - wide.lookAt).dot(up), 0) << "from above";
        const Camera narrow = viewOf(box, *transform, up, 40, 0.5);
        EXPECT_NEAR(std::tan(std::asin(sineOfReach(narrow, center, radius))),
            std::tan(20 * kPi / 180) / 2, 1e-9);
    }
}

TEST(Camera, AFlatObjectIsSeenFromStraightAhead)
{
    const auto transform = Transform::createLinearTransform(2);
    const CoordBBox box(Coord(0, 0, 7), Coord(9, 4, 7));
    const Camera camera = viewOf(box, *transform, Vec3d(0, 1, 0), 30, 1);
    EXPECT_EQ(camera.lookAt, Vec3d(9, 4, 14));
    EXPECT_GT(camera.eye[2], 14);
    EXPECT_EQ(Vec3d(camera.eye[0], camera.eye[1], 0), Vec3d(9, 4, 0));
}
