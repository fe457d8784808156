// SPDX-License-Identifier: Apache-2.0
/// @file DagAdjacency.h
/// @brief The edges of a Sphere-DAG for walking it: the children of every node, and its parents, as
/// compressed sparse rows (CSR), and counts of them by level.
///
/// 4 bytes an edge and direction, 8 a node. Cost: O(nodes + edges). Tests: TestDagAdjacency.cc.

#pragma once

#include "SphereTree.h"
#include <openvdb_spheretree/base/CompressedRows.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

/// Both directions of a DAG; neighbours come in ascending order. Reading is thread-safe.
struct DagAdjacency {
    CompressedRows children; ///< a row for each parent
    CompressedRows parents;  ///< a row for each child

    std::size_t edgeCount() const { return children.targets.size(); }
};

/// @brief The rows of edges between two kinds of node, as sphereDag() returns them.
/// @param edges  sorted and unique
/// @throw openvdb::ValueError naming the first edge that is out of order, there twice or not
///        between nodes
DagAdjacency dagAdjacency(
    const std::vector<DagEdge>& edges, int32_t parentCount, int32_t childCount);

/// @brief The rows of a whole tree: every node has one in each direction, by id. Rows of a tree
/// without edges are empty.
/// @throw openvdb::ValueError as above, or if an edge does not lead to the next level down
DagAdjacency dagAdjacency(const SphereTree& tree);

/// How many neighbours the nodes of a level have.
struct Degrees {
    int64_t min = 0, max = 0;
    double mean = 0;
};

/// The edges of a Sphere-DAG to the nodes of one level from those of the level above.
struct DagLevelStats {
    int level = 0; ///< the finer one
    int64_t edges = 0;
    Degrees childrenPerParent, parentsPerChild;
    int64_t sharedChildren = 0; ///< with more than one parent
    /// Of the tree's own links (SphereTree::parent) from this level up, those that are edges too.
    double treeEdgesInDagPercent = 0;
};

/// @return the edges counted for each level but the top one, the finest first; nothing for a tree
///         without edges.
/// @throw openvdb::ValueError as dagAdjacency()
std::vector<DagLevelStats> dagStats(const SphereTree& tree);

} // namespace openvdb_spheretree
