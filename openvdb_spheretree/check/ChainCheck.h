// SPDX-License-Identifier: Apache-2.0
/// @file ChainCheck.h
/// @brief Which voxels of an object have no chain of spheres that all hold them, each sphere the
/// child of the one above.

#pragma once

#include <openvdb_spheretree/sphere/SphereUnion.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::detail {

/// A forest of spheres, and the sections through it that chains must lead to. A section is a set of
/// nodes. Every path from a leaf towards its root meets a section in one node, or ends below it; it
/// meets the sections in their order. The levels of a tree are sections, and so are cuts of fewer
/// and fewer spheres.
struct ChainForest {
    static constexpr int kMaxSections = 64;

    std::vector<ExactSphere> spheres; ///< children stand before their parents
    std::vector<int32_t> parent;      ///< by place in the list, or -1
    std::vector<uint64_t> sections;   ///< of each node; bit s: it is in section s (0: the leaves)
    int sectionCount = 0;
};

/// The voxels that have a chain from the leaves up to the section before, but not to this one.
struct ChainLoss {
    int64_t voxels = 0;
    openvdb::Coord first; ///< in the order of Coord; undefined without voxels

    void add(const ChainLoss& other);
};

/// @return for each section, the voxels whose chain ends below it. Exact, and the same for any
///         number of threads.
/// @note Cost: linear in the nodes near each part of the object, mostly along its surface. Memory:
///       a few times that of the nodes, and that of the object's leaves.
std::vector<ChainLoss> brokenChains(const ChainForest& forest, const SphereMetric& metric,
    const openvdb::MaskTree& object, openvdb::util::NullInterrupter* interrupter);

} // namespace openvdb_spheretree::detail
