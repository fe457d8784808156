// SPDX-License-Identifier: Apache-2.0
/// @file TestCamera.cc
/// @brief Cameras that see nothing are refused; the view of an object holds all of it.

#include "support/Messages.h"

#include <openvdb_spheretree/picture/Camera.h>

#include <openvdb/math/Math.h>
#include <openvdb/Exceptions.h>
#include <openvdb/math/Transform.h>

#include <gtest/gtest.h>

#include <algorithm>
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

/// How much of a picture's width and height the corners of a box take, seen by this camera.
struct Filled {
    double wide = 0, tall = 0;
    Filled(const Camera& camera, const CoordBBox& box, const Transform& transform, double aspect)
    {
        const Vec3d ahead = (camera.lookAt - camera.eye).unit();
        const Vec3d right = ahead.cross(camera.up).unit(), up = right.cross(ahead);
        for (int i = 0; i < 8; ++i) {
            const Vec3d index(i & 1 ? box.max()[0] + 0.5 : box.min()[0] - 0.5,
                i & 2 ? box.max()[1] + 0.5 : box.min()[1] - 0.5,
                i & 4 ? box.max()[2] + 0.5 : box.min()[2] - 0.5);
            const Vec3d from = transform.indexToWorld(index) - camera.eye;
            const double half = camera.isOrthographic()
                ? camera.height / 2
                : from.dot(ahead) * std::tan(camera.fovDegrees * kPi / 360);
            tall = std::max(tall, std::abs(from.dot(up)) / half);
            wide = std::max(wide, std::abs(from.dot(right)) / (half * aspect));
        }
    }
};

} // namespace

TEST(Camera, OneThatSeesNothingIsRefusedByName)
{
    EXPECT_NO_THROW(Camera().validate());
    Camera camera;
    for (const double fov : {-1.0, 1e-300, 180.0, 1e9, std::nan("")}) {
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

TEST(Camera, TheBoxOfAnObjectFillsItsView)
{
    auto transform = Transform::createLinearTransform(0.25);
    transform->postRotate(0.7, openvdb::math::Y_AXIS);
    transform->postTranslate(Vec3d(1000, -3, 5));
    const CoordBBox box(Coord(-10, 0, 4), Coord(29, 11, 9));
    const Vec3d center = transform->indexToWorld(Vec3d(9.5, 5.5, 6.5));
    for (const double fov : {0.0, 0.01, 40.0, 120.0}) {
        for (const Vec3d& up : {Vec3d(0, 1, 0), Vec3d(0, 0, 2), Vec3d(-1, 0, 0), Vec3d(1, 1, 1)}) {
            for (const double aspect : {2.0, 1.0, 0.1}) {
                const Camera camera = viewOf(box, *transform, up, fov, aspect);
                EXPECT_NO_THROW(camera.validate());
                EXPECT_EQ(camera.lookAt, center);
                EXPECT_GT((camera.eye - camera.lookAt).dot(up), 0) << "from above";
                const Filled filled(camera, box, *transform, aspect);
                EXPECT_NEAR(std::max(filled.wide, filled.tall), kFilled, 1e-6) << fov << aspect;
            }
        }
    }
}

TEST(Camera, AnOrthographicOneHasAHeight)
{
    Camera camera;
    camera.fovDegrees = 0;
    EXPECT_NO_THROW(camera.validate());
    for (const double height : {0.0, -1.0, std::nan(""), 1e101}) {
        camera.height = height;
        EXPECT_TRUE(mentions(whyNot(camera), "height"));
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
