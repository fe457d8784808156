// SPDX-License-Identifier: Apache-2.0
/// @file Camera.h
/// @brief Where a picture is taken from, and a camera that suits an object.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

namespace openvdb_spheretree {

/// A perspective camera, in world space.
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
    double fovDegrees = 30;         ///< vertical angle of view in degrees, kMinFov to kMaxFov

    /// @brief Looks at each member by itself.
    /// @throw openvdb::ValueError if one is out of its range or not finite
    void validateRanges() const;

    /// @throw openvdb::ValueError if a member is out of its range, eye the same point as lookAt, or
    ///        up parallel to the view
    void validate() const;
};

/// @brief A camera for an object and for all levels of its tree, so that their pictures can be
/// compared: the sphere around the object's box fills the shorter side of the picture. That shows
/// the spheres of all levels, but often not the whole of the topmost one.
///
/// It looks from the front, the right and above. At an object one voxel thick along an axis (as with
/// dim=2) it looks along that axis; if `up` is that axis, another direction is upright.
/// @param box         of the active voxels, in index space, inclusive, not empty
/// @param transform   index space to world, with uniform voxels
/// @param up          upright in the picture, as in Camera
/// @param fovDegrees  vertical angle of view, in degrees, as in Camera
/// @param aspect      width of the picture over its height
/// @throw openvdb::ValueError if @a up or @a fovDegrees is out of its range
Camera viewOf(const openvdb::CoordBBox& box, const openvdb::math::Transform& transform,
    const openvdb::Vec3d& up, double fovDegrees, double aspect);

} // namespace openvdb_spheretree
