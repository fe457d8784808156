// SPDX-License-Identifier: Apache-2.0
/// @file ObjectSurface.h
/// @brief The surface of an object, for looking at: quads, no more than are wanted.
///
/// 1. *Blocks*: voxels become cubes of `factor` voxels a side, each with the share of its voxels that
///    are the object's. What is thinner than half a block would vanish; so a block with voxels counts
///    as full where neither it nor a block around it is half full. Such a surface is larger than
///    the object: `growth` says how much.
/// 2. *Mesh*: where the share is one half, by OpenVDB's tools::volumeToMesh().
///
/// The factor is the smallest power of two whose mesh is small enough. Which one to try first is
/// guessed from the surface of blocks of 8 voxels. Cost: leaf nodes and tiles of the object, and the
/// blocks of the meshes that were tried. The same for any number of threads. Tests:
/// TestObjectSurface.cc.

#pragma once

#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace openvdb_spheretree::detail {

struct ObjectSurface {
    int factor = 1;                  ///< voxels along a side of a block
    openvdb::Vec3d originWorld{0.0}; ///< what points are relative to
    double growth = 1; ///< volume of the blocks over that of the object: large where parts are thin
    std::vector<openvdb::Vec3s> points; ///< world units
    std::vector<openvdb::Vec4I> quads;  ///< of points; seen from outside they turn left
};

/// @param object     not empty, with uniform voxels
/// @param triangles  the most, two for each quad
/// @return nothing if not even the largest blocks, of 4096 voxels a side, are few enough
/// @throw Interrupted if the interrupter (may be null) said so
std::optional<ObjectSurface> objectSurface(const openvdb::BoolGrid& object, int64_t triangles,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree::detail
