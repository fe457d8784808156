// SPDX-License-Identifier: Apache-2.0
#include "Camera.h"

#include <openvdb_spheretree/voxel/FlatAxis.h>

#include <openvdb/math/Math.h>
#include <openvdb/math/Transform.h>
#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {

namespace {

using openvdb::Vec3d;

void requireFinite(const char* name, const Vec3d& v)
{
    if (!v.isFinite()) OPENVDB_THROW(openvdb::ValueError, name << "=" << v << " is not finite");
}

/// @return the unit vector towards a viewer in front, to the right and above.
Vec3d frontRightAbove(const Vec3d& up)
{
    const Vec3d above = up.unit();
    const Vec3d axis = std::abs(above[0]) < 0.9 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d right = (axis - axis.dot(above) * above).unit();
    return (0.55 * right + 0.42 * above + right.cross(above)).unit();
}

} // namespace

void Camera::validate() const
{
    constexpr double kParallel = 1e-6; // sine of the angle
    requireFinite("eye", eye);
    requireFinite("lookat", lookAt);
    requireFinite("up", up);
    if (!(fovDegrees > 0 && fovDegrees < 180)) {
        OPENVDB_THROW(openvdb::ValueError,
            "fov=" << fovDegrees << " is out of range: it takes degrees, above 0 and below 180");
    }
    const Vec3d view = lookAt - eye;
    if (!(view.length() > 0)) {
        OPENVDB_THROW(openvdb::ValueError,
            "eye and lookat are the same point, " << eye
                                                  << ", so there is no direction to look in");
    }
    if (!(view.cross(up).length() > kParallel * view.length() * up.length())) {
        OPENVDB_THROW(openvdb::ValueError,
            "up=" << up << " points along the view, or nowhere: give another up");
    }
}

Camera viewOf(const openvdb::CoordBBox& box, const openvdb::math::Transform& transform,
    const openvdb::Vec3d& up, double fovDegrees, double aspect)
{
    Camera camera;
    camera.up = up;
    camera.fovDegrees = fovDegrees;
    const Vec3d lo = transform.indexToWorld(box.min().asVec3d() - Vec3d(0.5));
    const Vec3d hi = transform.indexToWorld(box.max().asVec3d() + Vec3d(0.5));
    camera.lookAt = (lo + hi) / 2;
    const double half = std::tan(fovDegrees * openvdb::math::pi<double>() / 360);
    const double narrower = std::atan(half * std::min(aspect, 1.0));
    const double distance = (hi - lo).length() / 2 / std::sin(narrower);
    const int flat = flatAxisOf(box);
    if (flat < 0) {
        camera.eye = camera.lookAt + distance * frontRightAbove(up);
        return camera;
    }
    const auto worldAxis = [&](int axis) {
        Vec3d index(0, 0, 0);
        index[axis] = 1;
        return transform.baseMap()->applyJacobian(index).unit();
    };
    camera.eye = camera.lookAt + distance * worldAxis(flat);
    const bool isAcross = worldAxis(flat).cross(up.unit()).length() > 1e-3;
    if (!isAcross) camera.up = worldAxis(flat == 2 ? 1 : 2);
    return camera;
}

} // namespace openvdb_spheretree
