// SPDX-License-Identifier: Apache-2.0
/// @file ChainCheck.h
/// @brief Which voxels of an object have no chain of spheres, each the child of the one above, that
/// all hold them.

#pragma once

#include <openvdb_spheretree/sphere/SphereUnion.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

/// A forest of spheres, and the sections through it that chains are asked for: sets of nodes that
/// every way up from a leaf meets once while it lasts, in the same order on each. Levels are such,
/// and so are cuts of fewer and fewer spheres.
struct ChainForest {
    static constexpr int kMaxSections = 64;

    std::vector<ExactSphere> spheres; ///< children stand before their parents
    std::vector<int32_t> parent;      ///< by place in the list, or -1
    std::vector<uint64_t> sections;   ///< of each node, bit s: it is of section s; 0 are the leaves
    int sectionCount = 0;
};

/// The voxels that have a chain from the leaves up to the section before, but not to this one.
struct ChainLoss {
    int64_t voxels = 0;
    openvdb::Coord first; ///< in the order of Coord; of no meaning if there are none

    void add(const ChainLoss& other);
};

/// @return for each section, what has lost its chain there. Exact. The same for any number of
///         threads.
/// @note Cost: nodes near each part of the object, mostly along surfaces; memory: some times that
///       of the nodes, and as much again as the object's leaves.
std::vector<ChainLoss> brokenChains(const ChainForest& forest, const SphereMetric& metric,
    const openvdb::MaskTree& object, openvdb::util::NullInterrupter* interrupter);

} // namespace detail
} // namespace openvdb_spheretree
