// SPDX-License-Identifier: Apache-2.0
#include "PictureLight.h"

#include "PictureColors.h"
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/math/Math.h>
#include <openvdb/math/Transform.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::detail {

using openvdb::Vec3d;

namespace {

constexpr double kPi = openvdb::math::pi<double>();

/// Two unit vectors across a third (Duff et al., Building an Orthonormal Basis, Revisited, 2017).
void makeBasis(const Vec3d& n, Vec3d& across, Vec3d& along)
{
    const double sign = std::copysign(1.0, n[2]);
    const double a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
    across = Vec3d(1 + sign * n[0] * n[0] * a, sign * b, -sign * n[0]);
    along = Vec3d(b, sign + n[1] * n[1] * a, -n[1]);
}

} // namespace

CameraRays::CameraRays(const Camera& camera, const openvdb::math::Transform& transform,
    const openvdb::Coord& middle, int width, int height)
    : parallel(camera.isOrthographic()),
      pixel((parallel ? camera.height / voxelSizeOf(transform)
                      : 2 * std::tan(camera.fovDegrees * kPi / 360))
          / height),
      halfWidth(pixel * width / 2), halfHeight(pixel * height / 2)
{
    const Vec3d ahead = (camera.lookAt - camera.eye).unit();
    const Vec3d sideways = ahead.cross(camera.up).unit();
    const auto map = transform.baseMap(); // it may mirror, so all three directions are mapped
    eye = map->applyInverseMap(camera.eye) - middle.asVec3d();
    forward = map->applyInverseJacobian(ahead).unit();
    right = map->applyInverseJacobian(sideways).unit();
    up = map->applyInverseJacobian(sideways.cross(ahead)).unit();
    // Spheres may reach behind the eye: it goes back until none does that is of any use to see.
    constexpr double kFarBack = 64;
    if (parallel) eye -= kFarBack * (eye.length() + halfWidth + halfHeight) * forward;
}

Light::Light(const CameraRays& camera)
    : lamp((-0.55 * camera.right + 0.8 * camera.up - 0.6 * camera.forward).unit()),
      zenith((camera.up - 0.35 * camera.forward).unit())
{
    makeBasis(lamp, lampAcross, lampAlong);
}

Vec3d Light::towardsLamp(double u, double v) const
{
    constexpr double kRadius = 0.14; // seen from the scene: some 8 degrees
    const double r = kRadius * std::sqrt(u), angle = 2 * kPi * v;
    return (lamp + r * std::cos(angle) * lampAcross + r * std::sin(angle) * lampAlong).unit();
}

Vec3d Light::towardsSky(const Vec3d& normal, double u, double v)
{
    Vec3d across, along;
    makeBasis(normal, across, along);
    const double r = std::sqrt(u), angle = 2 * kPi * v;
    return r * std::cos(angle) * across + r * std::sin(angle) * along + std::sqrt(1 - u) * normal;
}

Vec3d Light::sky(const Vec3d& direction) const
{
    const double height = 0.5 + 0.5 * direction.dot(zenith);
    return Vec3d(0.46, 0.45, 0.45) + height * Vec3d(0.54, 0.57, 0.61);
}

Vec3d Light::reflected(const Vec3d& albedo, const Vec3d& normal, const Vec3d& toEye,
    double lampShare, const Vec3d& ambient) const
{
    constexpr double kLamp = 0.95, kSky = 0.62, kGloss = 0.10, kRim = 0.10;
    const double direct = kLamp * lampShare * std::max(0.0, normal.dot(lamp));
    const Vec3d diffuse = albedo * (Vec3d(1.0, 0.985, 0.95) * direct + kSky * ambient);
    const double glint = std::pow(std::max(0.0, normal.dot((lamp + toEye).unit())), 48);
    const double grazing = std::pow(1 - std::min(1.0, std::max(0.0, normal.dot(toEye))), 4);
    return diffuse + Vec3d(kGloss * lampShare * glint) + kRim * grazing * ambient;
}

Vec3d Light::background(double y)
{
    const Vec3d top = linearOf({0.985, 0.988, 0.992}), bottom = linearOf({0.865, 0.88, 0.90});
    return top + y * (bottom - top);
}

} // namespace openvdb_spheretree::detail
