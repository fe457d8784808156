// SPDX-License-Identifier: Apache-2.0
/// @file DagAdjacency.h
/// @brief The edges of a Sphere-DAG for walking it: the children of every node, and its parents, as
/// compressed sparse rows (CSR), and counts of them by level.
///
/// A direction is two arrays: the neighbours of node i are `targets[offsets[i] ... offsets[i +
/// 1])`. Edges come sorted by parent, so the children's array is there already; the parents' is one
/// counting sort of it. 4 bytes an edge and direction, 8 a node. Cost: O(nodes + edges). Tests:
/// TestDagAdjacency.cc.

#pragma once

#include "SphereTree.h"

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

/// Neighbours in ascending order, for a range-for.
struct NodeSpan {
    const int32_t *first = nullptr, *last = nullptr;

    const int32_t* begin() const { return first; }
    const int32_t* end() const { return last; }
    std::size_t size() const { return std::size_t(last - first); }
    bool empty() const { return first == last; }
    int32_t operator[](std::size_t i) const { return first[i]; }
};

/// Rows of neighbours, one row a node.
struct CompressedRows {
    std::vector<int64_t> offsets; ///< of each row in `targets`, and its size at the end
    std::vector<int32_t> targets;

    /// @param node  in [0, number of rows)
    NodeSpan operator[](int32_t node) const
    {
        return {targets.data() + offsets[std::size_t(node)],
            targets.data() + offsets[std::size_t(node) + 1]};
    }
    std::size_t rowCount() const { return offsets.size() - 1; }
};

/// Both directions of a DAG. Reading is thread-safe.
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
