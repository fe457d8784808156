// SPDX-License-Identifier: Apache-2.0
/// @file SphereLevelSet.h
/// @brief The spheres of a level of a tree to a level set (by OpenVDB's tools::ParticlesToLevelSet).

#pragma once

#include "SphereTree.h"

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <optional>

namespace openvdb_spheretree {

/// A level set may take this many voxels until its spheres are whole: 4 GiB.
constexpr int64_t kMaxLevelSetVoxels = int64_t(1) << 30;

/// @brief The union of a level's spheres as stored, padding included, as a narrow-band level set.
/// @param voxelSize  of the result, in world units, > 0; without one the result has the transform of
///                   the tree's source grid. With one its axes are the world's, and so is its origin
/// @param halfWidth  of the narrow band, in voxels of the result, 1 to 1000
/// @throw openvdb::ValueError if an argument is out of range, or the tree's balls are no spheres:
///        its distance is a norm; or no voxel size is given and those of the tree are no cubes, as somebody has
///        changed its transform; or, before any work, if the spheres and their band hold more
///        than kMaxLevelSetVoxels (or their box, where they overlap), or reach voxels beyond 2^30
/// @throw Interrupted if the interrupter said so
/// Cost: the voxels in the box of each sphere, a sphere a thread; 4 bytes a voxel inside, until the
/// spheres are whole, then what the band takes.
openvdb::SharedPtr<openvdb::FloatGrid> levelSetOfSpheres(const SphereTree& tree,
    const SphereTreeLevel& level, std::optional<double> voxelSize = {}, double halfWidth = 3,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
