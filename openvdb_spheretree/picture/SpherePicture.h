// SPDX-License-Identifier: Apache-2.0
/// @file SpherePicture.h
/// @brief A ray-cast picture of a level of a sphere-tree, or of an object, for slides and papers.
///
/// 1. *Shapes*: the level's spheres as stored, or the polyhedra that they are in the norms l1,
///    l-infinity and chamfer, or a box for every leaf node and tile of the object; in index space
///    about the middle of the object, where doubles are finest.
/// 2. *Colours*, one a sphere: siblings share one, and differ from the siblings beside them.
/// 3. *Rays*: every pixel is the mean of a square of samples, more where shapes meet. A sample is
///    the shape that its ray hits first, in closed form, lit by a lamp with soft shadow, by a sky
///    with ambient occlusion and by a little light from behind.
/// 4. *Blur*: where pixels side by side show one smooth surface, or nearly one plane, each takes
///    the mean light of the 25 around it. Shadows lose their grain; no edge is blurred.
///
/// What is random about a sample depends on its pixel alone: the same input gives the same picture,
/// for any number of threads. Cost: O(pixels log shapes), whatever the bounding box: 10.5 s of CPU
/// time for the 138,157 leaf balls of dragon-512 at 1280 x 960, on a busy Xeon with AVX-512.
/// Tests: TestSpherePicture.cc.

#pragma once

#include "Camera.h"
#include "Picture.h"
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {

enum class PictureColor {
    Parent, ///< siblings share a colour; without parents all spheres have the same
    Level,  ///< all spheres of a level have the same
    Id,     ///< every sphere has its own
    Fixed   ///< `PictureSettings::fixed`
};

struct PictureSettings {
    int width = 1280; ///< pixels, 1 to kMaxSide
    int height = 960; ///< pixels, 1 to kMaxSide
    /// What gives spheres their colours. An object is warm grey, unless this is Fixed.
    PictureColor color = PictureColor::Parent;
    openvdb::Vec3d fixed{0.8, 0.77, 0.73}; ///< red, green, blue; sRGB, 0 to 1
    /// Samples a side of a pixel where shapes meet, 2 to kMaxSamples: 4 is 16 of them in all. Where
    /// four samples see one smooth surface, these are enough.
    int samples = 4;
    /// Rays from a pixel to the sky, 1 to kMaxLightRays, and half as many to the lamp; a sample
    /// sends one of each at least. More of them make shadows less grainy; time is proportional to
    /// them.
    int lightRays = 16;

    static constexpr int kMaxSide = 16384;
    static constexpr int kMaxSamples = 16;
    static constexpr int kMaxLightRays = 4096;
    /// @throw openvdb::ValueError naming the first setting out of range, and its range
    void validate() const;
};

/// @brief Draw the spheres of a level with the radius that files hold (`radiusWorld`: padding is
/// part of it), but half a voxel at least: a single voxel without padding would be invisible.
/// @param tree         its transform must have uniform voxels
/// @param level        0 is the finest
/// @param camera       in world space; viewOf() makes one that suits
/// @param settings     size, colours, quality
/// @param interrupter  may be null; asked from many threads
/// @throw openvdb::ValueError if the tree has no such level, or the camera or a setting is wrong
/// @throw Interrupted if the interrupter said so
Picture renderLevel(const SphereTree& tree, int level, const Camera& camera,
    const PictureSettings& settings = {}, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief Draw the active voxels of @a object as cubes, tiles included. Parameters as above; an eye
/// within the object sees what of it there is to see beyond the voxel or tile that holds it.
/// @throw openvdb::ValueError if the object is empty, its voxels are not uniform, or the camera or
///        a setting is wrong
/// @throw Interrupted if the interrupter said so
Picture renderObject(const openvdb::BoolGrid& object, const Camera& camera,
    const PictureSettings& settings = {}, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
