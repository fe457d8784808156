// SPDX-License-Identifier: Apache-2.0
#include "DagAdjacency.h"

#include "TreeShape.h"

#include <openvdb/Exceptions.h>

#include <algorithm>

namespace openvdb_spheretree {

namespace {

Degrees degreesOf(const CompressedRows& rows, const SphereTreeLevel& level)
{
    Degrees degrees;
    degrees.min = int64_t(rows[level.begin].size());
    int64_t sum = 0;
    for (int32_t id = level.begin; id < level.end; ++id) {
        const int64_t degree = int64_t(rows[id].size());
        degrees.min = std::min(degrees.min, degree);
        degrees.max = std::max(degrees.max, degree);
        sum += degree;
    }
    degrees.mean = double(sum) / level.size();
    return degrees;
}

} // namespace

DagAdjacency dagAdjacency(
    const std::vector<DagEdge>& edges, int32_t parentCount, int32_t childCount)
{
    if (parentCount < 0 || childCount < 0) {
        OPENVDB_THROW(openvdb::ValueError,
            "a DAG between " << parentCount << " and " << childCount << " nodes cannot be");
    }
    for (const DagEdge& e : edges) {
        if (e.parent >= 0 && e.parent < parentCount && e.child >= 0 && e.child < childCount)
            continue;
        OPENVDB_THROW(openvdb::ValueError,
            "the edge of the DAG from node " << e.parent << " to node " << e.child
                                             << " is not between nodes that there are");
    }
    detail::throwFirst(detail::edgeOrderDamage(edges));
    const auto parent = [&](std::size_t i) { return edges[i].parent; };
    const auto child = [&](std::size_t i) { return edges[i].child; };
    return {compressedRows(edges.size(), std::size_t(parentCount), parent, child),
        compressedRows(edges.size(), std::size_t(childCount), child, parent)};
}

DagAdjacency dagAdjacency(const SphereTree& tree)
{
    detail::throwFirst(detail::edgeDamage(tree.dag, tree));
    return dagAdjacency(tree.dag, tree.size(), tree.size());
}

std::vector<DagLevelStats> dagStats(const SphereTree& tree)
{
    std::vector<DagLevelStats> result;
    if (tree.dag.empty()) return result;
    const DagAdjacency rows = dagAdjacency(tree);
    for (std::size_t k = 0; k + 1 < tree.levels.size(); ++k) {
        const SphereTreeLevel& level = tree.levels[k];
        DagLevelStats stats;
        stats.level = level.level;
        stats.edges = rows.parents.offsets[std::size_t(level.end)]
            - rows.parents.offsets[std::size_t(level.begin)];
        stats.childrenPerParent = degreesOf(rows.children, tree.levels[k + 1]);
        stats.parentsPerChild = degreesOf(rows.parents, level);
        int64_t both = 0;
        for (int32_t id = level.begin; id < level.end; ++id) {
            const NodeSpan parents = rows.parents[id];
            stats.sharedChildren += parents.size() > 1;
            both += std::binary_search(parents.begin(), parents.end(), tree.spheres.parent[id]);
        }
        stats.treeEdgesInDagPercent = 100.0 * double(both) / level.size();
        result.push_back(stats);
    }
    return result;
}

} // namespace openvdb_spheretree
