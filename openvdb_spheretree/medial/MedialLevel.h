// SPDX-License-Identifier: Apache-2.0
/// @file MedialLevel.h
/// @brief One level of voxels with what the trees ask of it: layout, medial balls, and some or all
/// power labels.

#pragma once

#include "DistanceMap.h"
#include "PowerMap.h"
#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/voxel/Distance.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/MedialBall.h>

#include <openvdb/openvdb.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace openvdb_spheretree {

/// @return the medial balls, in the order of their centers (x first).
std::vector<MedialBall> medialBalls(const PowerMap& labels, const DistanceMap& distances,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// What is wanted of a level beside its balls.
struct LevelWants {
    std::size_t count = 0;                              ///< of voxels whose labels are wanted
    std::function<openvdb::Coord(std::size_t)> voxel{}; ///< each of them; asked from many threads
    bool allLabels = false; ///< keep the label of every voxel: 3 or 6 bytes each
    int64_t memory = 0;     ///< as SphereTreeSettings::memory
};

/// @return the bytes that the labels of a norm take, which have no stream: all are in memory.
int64_t normBytes(const LeafLayout& layout);

struct MedialLevel {
    /// @param distance  what the balls are balls of
    /// @param seconds   may be null; the stages' times are added to it
    /// @throw as distanceTransform() and powerMap()
    MedialLevel(const openvdb::MaskTree& voxels, int dim, const Distance& distance,
        openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds = nullptr,
        const LevelWants& wants = {});
    MedialLevel(const MedialLevel&) = delete; // labels refer to the layout
    MedialLevel& operator=(const MedialLevel&) = delete;

    /// @return the index in `balls` of the ball centred at @a center. O(log balls).
    /// @throw openvdb::LookupError if there is none
    int32_t ballAt(const openvdb::Coord& center) const;
    /// @return the index in `balls` of the label of @a ijk, if all labels were wanted. O(log balls).
    /// @throw openvdb::LookupError if @a ijk is off
    int32_t labelOf(const openvdb::Coord& ijk) const { return ballAt(labels.label(ijk)); }

    const LeafLayout layout;
    std::vector<MedialBall> balls;    ///< ordered by centre
    std::vector<LeafMask> centers;    ///< of the balls, a mask for each leaf
    std::vector<int32_t> wantedLabel; ///< per voxel of LevelWants, a ball; -1: it is off
    PowerMap labels;                  ///< unless all were wanted, of no use

private:
    void findBalls(int dim, const LevelWants& wants, openvdb::util::NullInterrupter* interrupter,
        StageSeconds* seconds);
    void findNormBalls(int dim, const Distance& distance, const LevelWants& wants,
        openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds);
};

} // namespace openvdb_spheretree
