// SPDX-License-Identifier: Apache-2.0
/// @file Camera.h
/// @brief Where a picture is taken from, and a view that suits an object.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

namespace openvdb_spheretree {

/// A perspective camera, in world space.
struct Camera {
    openvdb::Vec3d eye{0, 0, 1};    ///< where it stands, world units
    openvdb::Vec3d lookAt{0, 0, 0}; ///< the point in the middle of the picture, world units
    openvdb::Vec3d up{0, 1, 0};     ///< shown upright; any length
    double fovDegrees = 30; ///< the vertical angle of view, in degrees, above 0 and below 180

    /// @throw openvdb::ValueError naming what is wrong: a number that is not finite, an angle of
    ///        view out of range, eye and lookAt in one place, or up along the view
    void validate() const;
};

/// @brief A view of an object that suits all levels of its tree as well, so that their pictures can
/// stand side by side: the sphere around the object's box fills the picture's shorter side. That
/// holds the spheres of every level but, often, a margin of the topmost one.
///
/// Seen from the front, the right and above; an object one voxel thick along an axis, as those of
/// trees with dim=2 are, along that axis, with another direction upright where `up` is that axis.
/// @param box         of the active voxels, index space, inclusive, not empty
/// @param transform   index space to world, with uniform voxels
/// @param up          shown upright, not zero
/// @param fovDegrees  vertical angle of view, in degrees
/// @param aspect      width of the picture over its height
Camera viewOf(const openvdb::CoordBBox& box, const openvdb::math::Transform& transform,
    const openvdb::Vec3d& up, double fovDegrees, double aspect);

} // namespace openvdb_spheretree
