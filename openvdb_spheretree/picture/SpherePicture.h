// SPDX-License-Identifier: Apache-2.0
/// @file SpherePicture.h
/// @brief A ray-cast picture of a level of a sphere-tree, or of an object, for slides and papers.
///
/// 1. *Shapes* are the level's spheres as stored; in the norms l1, l-infinity and chamfer they are
///    polyhedra. In trees with dim = 2 they are circles: flat discs in the object's plane, the
///    smaller ones in front, with a rim that shows where one ends. Of an object they are its leaf nodes and tiles. Coordinates are those of index
///    space about the middle of the object, where doubles are finest.
/// 2. *Colours*: a sphere has one, by PictureColor.
/// 3. *Rays*: every pixel is the mean of a square of samples, of more where shapes meet. A sample
///    shows the shape that its ray hits first, found in closed form (spheres by the kernel of query/, where
///    that is sooner: BallScene.h). It is lit by a lamp with soft
///    shadow, by a sky with ambient occlusion, and by a little light from behind.
/// 4. *Blur*: where a pixel shows one smooth surface, it takes the mean light of those of the 25
///    pixels around it that show nearly the same plane. So shadows lose their grain, and no edge is
///    blurred.
///
/// Random numbers depend on the pixel alone: the same input gives the same picture, for any number
/// of threads. Cost: O(pixels log shapes), whatever the bounding box: 7.3 s of CPU time for the
/// 138,157 leaf balls of dragon-512 at 1280 x 960, on a busy Xeon with AVX-512 (9.5 s without the kernel).
/// Tests: TestSpherePicture.cc.

#pragma once

#include "Camera.h"
#include "Picture.h"
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {

enum class PictureColor {
    Parent, ///< siblings share one, which differs from those of siblings beside them; as Id where
            ///< there are no parents
    Level,  ///< all spheres of a level have the same
    Id,     ///< every sphere has its own
    Fixed   ///< `PictureSettings::fixed`
};

struct PictureSettings {
    int width = 1280; ///< pixels, 1 to kMaxSide
    int height = 960; ///< pixels, 1 to kMaxSide
    /// What the colour of a sphere stands for. An object is warm grey, unless this is Fixed.
    PictureColor color = PictureColor::Parent;
    openvdb::Vec3d fixed{0.8, 0.77, 0.73}; ///< red, green and blue of sRGB, 0 to 1 each
    /// Where shapes meet, a pixel has samples x samples samples; 2 to kMaxSamples. Where four
    /// samples see one smooth surface, these are enough.
    int samples = 4;
    /// Rays from a pixel to the sky, 1 to kMaxLightRays. Half as many go to the lamp; every sample
    /// sends at least one of each. More rays make shadows less grainy; time is proportional to them.
    int lightRays = 16;

    static constexpr int kMaxSide = 16384;
    static constexpr int kMaxSamples = 16;
    static constexpr int kMaxLightRays = 4096;
    /// @throw openvdb::ValueError naming the first setting out of range, and its range
    void validate() const;
};

/// @brief Draw the spheres of a level with the radius that files hold (`radiusWorld`, which includes
/// padding), but at least half a voxel: a single voxel without padding would be invisible.
/// @param tree         its transform must have uniform voxels
/// @param level        0 is the finest
/// @param camera       in world space; viewOf() makes one that suits
/// @param settings     size, colours, quality
/// @param interrupter  may be null; called by many threads
/// @throw openvdb::ValueError if the tree has no such level, or the camera or a setting is wrong
/// @throw Interrupted if the interrupter said so
Picture renderLevel(const SphereTree& tree, int level, const Camera& camera,
    const PictureSettings& settings = {}, openvdb::util::NullInterrupter* interrupter = nullptr);

/// @brief Draw the active voxels of @a object as cubes, tiles included. Parameters as above. An eye
/// within the object looks out of the voxel or tile that holds it.
/// @throw openvdb::ValueError if the object is empty, its voxels are not uniform, or the camera or
///        a setting is wrong
/// @throw Interrupted if the interrupter said so
Picture renderObject(const openvdb::BoolGrid& object, const Camera& camera,
    const PictureSettings& settings = {}, openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
