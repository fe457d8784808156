// SPDX-License-Identifier: Apache-2.0
#include "Camera.h"

#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>

#include <openvdb/math/Math.h>
#include <openvdb/math/Transform.h>
#include <openvdb/Exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace openvdb_spheretree {

namespace {

using openvdb::Vec3d;

/// @return the numbers as the command takes them.
std::string listed(const Vec3d& v)
{
    detail::TextStream text;
    text << v[0] << "," << v[1] << "," << v[2];
    return text.str();
}

void requireInRange(const char* name, const Vec3d& v)
{
    constexpr double kMax = Camera::kMaxCoordinate;
    const Vec3d size = openvdb::math::Abs(v);
    if (size[0] <= kMax && size[1] <= kMax && size[2] <= kMax) return; // false for NaN as well
    OPENVDB_THROW(openvdb::ValueError,
        name << "=" << listed(v) << " is out of range: coordinates are " << -kMax << " to "
             << kMax);
}

/// @return the unit vector towards a viewer in front, to the right and above.
Vec3d frontRightAbove(const Vec3d& up)
{
    const Vec3d above = up.unit();
    const Vec3d axis = std::abs(above[0]) < 0.9 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d right = (axis - axis.dot(above) * above).unit();
    return (0.55 * right + 0.42 * above + right.cross(above)).unit();
}

std::array<Vec3d, 8> cornersOf(
    const openvdb::CoordBBox& box, const openvdb::math::Transform& transform)
{
    std::array<Vec3d, 8> corners;
    for (int i = 0; i < 8; ++i) {
        Vec3d corner;
        for (int axis = 0; axis < 3; ++axis) {
            corner[axis] = i >> axis & 1 ? box.max()[axis] + 0.5 : box.min()[axis] - 0.5;
        }
        corners[i] = transform.indexToWorld(corner);
    }
    return corners;
}

/// Sets the height of an orthographic camera. @return how far the eye must be away
double fit(
    Camera& camera, const Vec3d& towardsEye, const std::array<Vec3d, 8>& corners, double aspect)
{
    const Vec3d right = camera.up.cross(towardsEye).unit(), up = towardsEye.cross(right);
    const double half = std::tan(camera.fovDegrees * openvdb::math::pi<double>() / 360);
    const double tall = half * kFilled, wide = tall * aspect;
    double distance = 0, height = 0, around = 0;
    for (const Vec3d& corner : corners) {
        const Vec3d from = corner - camera.lookAt;
        const double x = std::abs(from.dot(right)), y = std::abs(from.dot(up));
        around = std::max(around, from.length());
        height = std::max({height, 2 * y / kFilled, 2 * x / (aspect * kFilled)});
        if (camera.isOrthographic()) continue;
        distance = std::max(distance, std::max(x / wide, y / tall) + from.dot(towardsEye));
    }
    if (!camera.isOrthographic()) return distance;
    camera.height = std::max(height, Camera::kMinUp);
    return 4 * around;
}

} // namespace

void Camera::validateRanges() const
{
    requireInRange("eye", eye);
    requireInRange("lookat", lookAt);
    if (!(up.length() >= kMinUp && up.length() <= kMaxUp)) { // false for NaN as well
        OPENVDB_THROW(openvdb::ValueError,
            "up=" << listed(up) << " is no direction: its length must be " << kMinUp << " to "
                  << kMaxUp);
    }
    if (!isOrthographic() && !(fovDegrees >= kMinFov && fovDegrees <= kMaxFov)) {
        OPENVDB_THROW(openvdb::ValueError,
            "fov=" << fovDegrees << " is out of range: it takes degrees, " << kMinFov << " to "
                   << kMaxFov << ", or 0 for an orthographic camera");
    }
    if (!(height >= kMinUp && height <= kMaxUp)) {
        OPENVDB_THROW(openvdb::ValueError,
            "the height " << height << " of the view is out of range: it takes " << kMinUp << " to "
                          << kMaxUp);
    }
}

void Camera::validate() const
{
    constexpr double kParallel = 1e-6; // sine of the angle
    validateRanges();
    const Vec3d view = lookAt - eye;
    if (!(view.length() > 0)) {
        OPENVDB_THROW(openvdb::ValueError,
            "eye and lookat are the same point, " << listed(eye)
                                                  << ", so there is no direction to look in");
    }
    if (!(view.unit().cross(up.unit()).length() > kParallel)) {
        OPENVDB_THROW(
            openvdb::ValueError, "up=" << listed(up) << " points along the view: give another up");
    }
}

Camera viewOf(const openvdb::CoordBBox& box, const openvdb::math::Transform& transform,
    const openvdb::Vec3d& up, double fovDegrees, double aspect)
{
    Camera camera;
    camera.up = up;
    camera.fovDegrees = fovDegrees;
    camera.validateRanges();
    const Vec3d lo = transform.indexToWorld(box.min().asVec3d() - Vec3d(0.5));
    const Vec3d hi = transform.indexToWorld(box.max().asVec3d() + Vec3d(0.5));
    camera.lookAt = (lo + hi) / 2;
    Vec3d towardsEye = frontRightAbove(up);
    const int flat = flatAxisOf(box);
    if (flat >= 0) {
        const auto worldAxis = [&](int axis) {
            Vec3d index(0, 0, 0);
            index[axis] = 1;
            return transform.baseMap()->applyJacobian(index).unit();
        };
        towardsEye = worldAxis(flat);
        const bool isAcross = towardsEye.cross(up.unit()).length() > 1e-3;
        if (!isAcross) camera.up = worldAxis(flat == 2 ? 1 : 2);
    }
    const double distance = fit(camera, towardsEye, cornersOf(box, transform), aspect);
    camera.eye = camera.lookAt + distance * towardsEye;
    return camera;
}

} // namespace openvdb_spheretree
