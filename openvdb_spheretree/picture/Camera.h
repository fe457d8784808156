// SPDX-License-Identifier: Apache-2.0
/// @file Camera.h
/// @brief Where a picture is taken from, and a camera that suits an object.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

namespace openvdb_spheretree {

/// A camera in world space: perspective, or orthographic where the angle of view is 0.
struct Camera {
    /// @name What is possible; far beyond it, squares are out of the range of double
    /// @{
    static constexpr double kMaxCoordinate = 1e100;
    static constexpr double kMinUp = 1e-100, kMaxUp = 1e100;
    static constexpr double kMinFov = 0.001, kMaxFov = 179.999;
    /// @}

    openvdb::Vec3d eye{0, 0, 1};    ///< where it stands, world units
    openvdb::Vec3d lookAt{0, 0, 0}; ///< the point in the middle of the picture, world units
    openvdb::Vec3d up{0, 1, 0};     ///< upright in the picture; its length is kMinUp to kMaxUp
    /// Vertical angle of view in degrees, kMinFov to kMaxFov; or 0 for an orthographic camera, whose
    /// rays are parallel. That one shows what is behind its eye as well.
    double fovDegrees = 30;
    double height = 1; ///< of what an orthographic camera shows, world units, kMinUp to kMaxUp

    bool isOrthographic() const { return fovDegrees == 0; }

    /// @brief Looks at each member by itself.
    /// @throw openvdb::ValueError if one is out of its range or not finite
    void validateRanges() const;

    /// @throw openvdb::ValueError if a member is out of its range, eye the same point as lookAt, or
    ///        up parallel to the view
    void validate() const;
};

/// How much of a picture's width or height the box of an object takes, as viewOf() sees it.
constexpr double kFilled = 0.92;

/// @brief A camera for an object and for all levels of its tree, so that their pictures can be
/// compared: it looks at the middle of the object's box, and the corners of the box as they are seen
/// fill kFilled of the picture's width or height, whichever is reached first. Spheres stick out of
/// the box, those of the topmost level often out of the picture.
///
/// It looks from the front, the right and above. At an object one voxel thick along an axis (as with
/// dim=2) it looks along that axis; if `up` is that axis, another direction is upright.
/// @param box         of the active voxels, in index space, inclusive, not empty
/// @param transform   index space to world, with uniform voxels
/// @param up          upright in the picture, as in Camera
/// @param fovDegrees  vertical angle of view, in degrees, as in Camera; 0: orthographic
/// @param aspect      width of the picture over its height
/// @throw openvdb::ValueError if @a up or @a fovDegrees is out of its range
Camera viewOf(const openvdb::CoordBBox& box, const openvdb::math::Transform& transform,
    const openvdb::Vec3d& up, double fovDegrees, double aspect);

} // namespace openvdb_spheretree
