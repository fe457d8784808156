// SPDX-License-Identifier: Apache-2.0
/// @file SphereTracks.h
/// @brief Which spheres of two frames are the same: tracks, numbers that a sphere keeps from frame to frame.
///
///     startTracks(first);
///     continueTracks(second, first);
///
/// The index of a node is its id, and says where it stands in its level, so it changes from frame to frame. The
/// track of a sphere is that of the sphere of the last frame which has become it:
/// 1. Spheres are compared in the frame of their object's voxels, so what only the transform moves or turns stays where it is.
///    Level by level, those of the last frame are moved by as much as the center of mass of all has moved. A body
///    that only moves keeps all its tracks, however fast it is.
/// 2. Spheres are paired so that they have moved the least in all (base/Assignment.h). What a pair has
///    moved by is how far one is from the other, as sets of points: the distance of their centers and the
///    difference of their radii.
/// 3. Where a level has more spheres than before, those that are left get tracks that no sphere had; where it has
///    fewer, tracks end.
///
/// Levels of more than 256 spheres are halved by rank across their longest side until there are no more: the least
/// movement in each part, not of all.
///
/// Cost: n 256^2 for a level of n spheres, at most. The same for any number of threads.

#pragma once

#include "SphereTree.h"

#include <openvdb/util/NullInterrupter.h>

namespace openvdb_spheretree {

/// Makes ids the tracks of a tree: that of the first frame.
void startTracks(SphereTree& tree);

/// @brief Give the spheres of a tree the tracks of those that they come from.
/// @param last  the tree of the frame before; where it has no tracks, ids are its tracks. Levels of one number
///              belong together.
/// @throw openvdb::ValueError if there would be more than 2^31 - 1 tracks
/// @throw Interrupted
void continueTracks(SphereTree& tree, const SphereTree& last,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// @return how far the spheres of a level have moved since the frame before, on average over those that are paired, in mean
///         radii that they had (in voxels if these are 0): the sum over all levels. 0 if no level has spheres in both.
double movementSince(const SphereTree& last, const SphereTree& tree,
    openvdb::util::NullInterrupter* interrupter = nullptr);

} // namespace openvdb_spheretree
