// SPDX-License-Identifier: Apache-2.0
/// @file PictureLight.h
/// @brief The rays of a camera, and the light in front of it, in the space of a scene.

#pragma once

#include "Camera.h"
#include <openvdb_spheretree/index/Ray.h>

namespace openvdb_spheretree {
namespace detail {

/// A camera's place and directions in index space about @a middle. All three directions are mapped,
/// rather than the third made from two: a transform may mirror.
struct CameraFrame {
    openvdb::Vec3d eye, forward, right, up; ///< unit vectors, but for eye

    CameraFrame(const Camera& camera, const openvdb::math::Transform& transform,
        const openvdb::Coord& middle);
};

/// The rays of a picture's pixels.
class CameraRays {
public:
    CameraRays(const CameraFrame& frame, double fovDegrees, int width, int height);
    /// The ray through a point of the picture, in pixels from its upper left corner.
    Ray through(double x, double y) const
    {
        const openvdb::Vec3d direction = mFrame.forward + (x * mPixel - mHalfWidth) * mFrame.right
            + (mHalfHeight - y * mPixel) * mFrame.up;
        return Ray(mFrame.eye, direction.unit());
    }

private:
    CameraFrame mFrame;
    double mPixel, mHalfWidth, mHalfHeight; ///< in a plane at distance 1
};

/// A lamp behind the viewer's left shoulder, a sky, and a weak light from behind that parts dark
/// edges from each other. All of it goes with the camera, so that every view is lit well.
struct Light {
    explicit Light(const CameraFrame& frame);

    openvdb::Vec3d lamp, lampAcross, lampAlong; ///< unit: towards its middle, and two across that
    openvdb::Vec3d zenith;                      ///< unit

    /// @return the direction to a point of the lamp; @a u and @a v in [0, 1).
    openvdb::Vec3d towardsLamp(double u, double v) const;
    /// @return a direction above a surface, the likelier the more light from there counts.
    static openvdb::Vec3d towardsSky(const openvdb::Vec3d& normal, double u, double v);
    /// @return linear light of the sky; brightest above.
    openvdb::Vec3d sky(const openvdb::Vec3d& direction) const;
    /// @return linear light that a surface sends to the viewer.
    /// @param albedo   of the surface, linear
    /// @param normal   unit
    /// @param toEye    unit
    /// @param lampShare 1 where the lamp is seen, 0 where something stands before it
    /// @param ambient  mean light from above the surface
    openvdb::Vec3d reflected(const openvdb::Vec3d& albedo, const openvdb::Vec3d& normal,
        const openvdb::Vec3d& toEye, double lampShare, const openvdb::Vec3d& ambient) const;
    /// @return linear light behind everything; @a y is 0 at the picture's upper edge, 1 at the
    /// lower.
    static openvdb::Vec3d background(double y);
};

} // namespace detail
} // namespace openvdb_spheretree
