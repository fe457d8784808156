// SPDX-License-Identifier: Apache-2.0
/// @file PictureLight.h
/// @brief The rays of a camera and the light of a scene, in index space about its middle.

#pragma once

#include "Camera.h"
#include <openvdb_spheretree/index/Ray.h>

namespace openvdb_spheretree::detail {

/// The rays of a picture's pixels.
struct CameraRays {
    openvdb::Vec3d eye;
    openvdb::Vec3d forward, right, up; ///< unit vectors
    bool parallel;                     ///< the camera is orthographic
    /// Lengths in the plane at distance 1; of parallel rays, in voxels.
    double pixel, halfWidth, halfHeight;

    /// @param middle         the origin of the scene, in index space
    /// @param width, height  of the picture, in pixels
    CameraRays(const Camera& camera, const openvdb::math::Transform& transform,
        const openvdb::Coord& middle, int width, int height);

    /// @return the ray through a point of the picture, in pixels from its upper left corner.
    Ray through(double x, double y) const
    {
        const openvdb::Vec3d aside =
            (x * pixel - halfWidth) * right + (halfHeight - y * pixel) * up;
        return parallel ? Ray(eye + aside, forward) : Ray(eye, (forward + aside).unit());
    }
};

/// A lamp behind the viewer's left shoulder, a sky, and a weak light from behind the object that
/// makes dark edges visible. All of them move with the camera, so every view is lit well.
struct Light {
    explicit Light(const CameraRays& camera);

    openvdb::Vec3d lamp;                  ///< unit, towards the middle of the lamp
    openvdb::Vec3d lampAcross, lampAlong; ///< an orthonormal basis with `lamp`
    openvdb::Vec3d zenith;                ///< unit

    /// @return the direction to a point of the lamp; @a u and @a v in [0, 1).
    openvdb::Vec3d towardsLamp(double u, double v) const;
    /// @return a direction above a surface; for even u and v they are distributed by the cosine of
    ///         their angle to the normal, which is how much light from there counts.
    static openvdb::Vec3d towardsSky(const openvdb::Vec3d& normal, double u, double v);
    /// @return the linear light of the sky, which is brightest at the zenith.
    openvdb::Vec3d sky(const openvdb::Vec3d& direction) const;
    /// @return the linear light that a surface sends to the viewer.
    /// @param albedo   of the surface, linear
    /// @param normal   unit
    /// @param toEye    unit
    /// @param lampShare  how much of the lamp is visible from there, 0 to 1
    /// @param ambient  mean light of the sky above the surface
    openvdb::Vec3d reflected(const openvdb::Vec3d& albedo, const openvdb::Vec3d& normal,
        const openvdb::Vec3d& toEye, double lampShare, const openvdb::Vec3d& ambient) const;
    /// @return the linear light of the background.
    /// @param y  0 at the picture's upper edge, 1 at its lower edge
    static openvdb::Vec3d background(double y);
};

} // namespace openvdb_spheretree::detail
