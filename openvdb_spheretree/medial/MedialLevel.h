// SPDX-License-Identifier: Apache-2.0
/// @file MedialLevel.h
/// @brief One level of voxels with what trees are made from: its layout, its medial balls, and the
/// power labels of some or all voxels.

#pragma once

#include "PowerMap.h"
#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/voxel/Distance.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/MedialBall.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace openvdb_spheretree {

/// What is queried of a level beside its balls.
struct LevelQueries {
    std::size_t count = 0;                              ///< of voxels whose labels are queried
    std::function<openvdb::Coord(std::size_t)> voxel{}; ///< each of them; called by many threads
    bool allLabels = false; ///< keep the label of every voxel: 3 or 6 bytes each
    int64_t memory = 0;     ///< as SphereTreeSettings::memory
};

/// @return the bytes that the labels of a norm take, which have no stream: all are in memory.
int64_t normBytes(const LeafLayout& layout);

struct MedialLevel {
    /// @param distance  what the balls are balls of
    /// @param seconds   may be null; the stages' times are added to it
    /// @throw as distanceTransform() and LabelStream::run()
    MedialLevel(const openvdb::MaskTree& voxels, int dim, const Distance& distance,
        openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds = nullptr,
        const LevelQueries& queries = {});
    MedialLevel(const MedialLevel&) = delete; // labels refer to the layout
    MedialLevel& operator=(const MedialLevel&) = delete;

    /// @return the index in `balls` of the ball with its center at @a center. O(log balls).
    /// @throw openvdb::LookupError if there is none
    int32_t ballAt(const openvdb::Coord& center) const;
    /// @return the index in `balls` of the label of @a ijk, if all labels were queried. O(log
    ///         balls).
    /// @throw openvdb::LookupError if @a ijk is off
    int32_t labelOf(const openvdb::Coord& ijk) const { return ballAt(labels.label(ijk)); }

    const LeafLayout layout;
    std::vector<MedialBall> balls;     ///< ordered by center
    std::vector<LeafMask> centers;     ///< of the balls, a mask for each leaf
    std::vector<int32_t> queriedLabel; ///< of each queried voxel, a ball; -1: the voxel is off
    PowerMap labels;                   ///< of all voxels, if queried; else undefined

private:
    void findBalls(int dim, const LevelQueries& queries,
        openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds);
    void findNormBalls(int dim, const Distance& distance, const LevelQueries& queries,
        openvdb::util::NullInterrupter* interrupter, StageSeconds* seconds);
};

} // namespace openvdb_spheretree
