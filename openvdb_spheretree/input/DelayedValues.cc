// SPDX-License-Identifier: Apache-2.0
#include "DelayedValues.h"

#include "LeafValues.h"
#include "../base/Parallel.h"

#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <vector>

namespace openvdb_spheretree {

namespace {

/// Those of whose leaves OpenVDB can leave the values in the file.
using DelayedGrids = openvdb::NumericGridTypes::Append<openvdb::Vec3GridTypes>::Append<
    openvdb::points::PointDataGrid>;

} // namespace

void requireReadableValues(
    const openvdb::GridBase& grid, openvdb::util::NullInterrupter* interrupter)
{
    grid.apply<DelayedGrids>([&](const auto& typed) {
        using LeafT = typename std::decay_t<decltype(typed)>::TreeType::LeafNodeType;
        std::vector<const LeafT*> leaves;
        typed.tree().getNodes(leaves);
        detail::parallelFor(leaves.size(), interrupter, [&](std::size_t n) {
            if (leaves[n]->buffer().isOutOfCore()) detail::LeafValues<LeafT> values(*leaves[n]);
        });
    });
}

} // namespace openvdb_spheretree
