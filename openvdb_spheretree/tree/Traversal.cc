// SPDX-License-Identifier: Apache-2.0
#include "Traversal.h"

#include <openvdb/Exceptions.h>

#include <cstddef>

namespace openvdb_spheretree {

CompressedRows children(const SphereTree& tree)
{
    const std::vector<int32_t>& parent = tree.spheres.parent;
    std::vector<int32_t> nodes; // with a parent
    nodes.reserve(parent.size());
    for (int32_t id = 0; id < tree.size(); ++id) {
        if (parent[id] == -1) continue;
        if (parent[id] < 0 || parent[id] >= tree.size()) {
            OPENVDB_THROW(openvdb::ValueError,
                "node " << id << " has the parent " << parent[id] << ", but there are nodes 0 to "
                        << tree.size() - 1);
        }
        nodes.push_back(id);
    }
    return compressedRows(
        nodes.size(), parent.size(), [&](std::size_t i) { return parent[nodes[i]]; },
        [&](std::size_t i) { return nodes[i]; });
}

} // namespace openvdb_spheretree
