// SPDX-License-Identifier: Apache-2.0
/// @file MedialLevel.h
/// @brief One level of voxels with everything the trees ask of it: layout, distances, power labels
/// and medial balls.

#pragma once

#include "DistanceTransform.h"
#include "LeafLayout.h"
#include "MedialAxis.h"
#include "PowerMap.h"
#include "SphereTree.h"

#include <openvdb/openvdb.h>

#include <vector>

namespace openvdb_spheretree {

struct MedialLevel {
    /// @param distance  what the balls are balls of
    /// @param seconds  may be null; the stages' times are added to it
    /// @throw as distanceTransform() and powerMap()
    MedialLevel(const openvdb::MaskTree& voxels, int dim, const Distance& distance,
        openvdb::util::NullInterrupter* interrupter, BuildSeconds* seconds = nullptr);
    MedialLevel(const MedialLevel&) = delete; // labels refer to the layout
    MedialLevel& operator=(const MedialLevel&) = delete;

    /// @return the index in `balls` of the ball centred at @a center. O(log balls).
    /// @throw openvdb::LookupError if there is none
    int32_t ballAt(const openvdb::Coord& center) const;
    /// @return the index in `balls` of the label of @a ijk.
    /// @throw openvdb::LookupError if @a ijk is off
    int32_t labelOf(const openvdb::Coord& ijk) const { return ballAt(labels.label(ijk)); }

    const LeafLayout layout;
    const DistanceMap distances;
    const PowerMap labels;
    const std::vector<MedialBall> balls; ///< ordered by centre
};

} // namespace openvdb_spheretree
