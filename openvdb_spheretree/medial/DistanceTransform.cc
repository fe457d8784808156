// SPDX-License-Identifier: Apache-2.0
#include "DistanceTransform.h"

#include "DistanceMap.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/MakeGrid.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>

#include <array>
#include <memory>
#include <vector>

namespace openvdb_spheretree {

openvdb::Int32Grid::Ptr distanceTransform(const openvdb::BoolGrid& object, int dim,
    const Distance& distance, openvdb::util::NullInterrupter* interrupter)
{
    const FlatAxis flat = flatAxisOf(object, dim);
    const LeafLayout layout(*voxelsOf(object, flat));
    const DistanceMap map = distanceTransform(layout, dim, distance, interrupter);

    std::array<uint32_t, kLeafVoxels> place; // in the grid's leaf, of a voxel of the turned one
    for (uint32_t k = 0; k < kLeafVoxels; ++k) {
        place[k] = leafIndex(flat.fromZ(leafVoxel(openvdb::Coord(0), k)));
    }
    using Leaf = openvdb::Int32Tree::LeafNodeType;
    std::vector<std::unique_ptr<Leaf>> leaves(layout.leafCount());
    detail::parallelFor(leaves.size(), interrupter, [&](std::size_t i) {
        leaves[i] = std::make_unique<Leaf>(flat.fromZ(layout.origin(uint32_t(i))), 0);
        Leaf::ValueType* values = leaves[i]->buffer().data();
        const LeafMask& mask = layout.mask(uint32_t(i));
        Leaf::NodeMaskType on;
        for (uint32_t k = 0; k < kLeafVoxels; ++k) {
            values[place[k]] = int32_t(map.at(uint32_t(i), k));
            if (mask.isOn(k)) on.setOn(place[k]);
        }
        leaves[i]->setValueMask(on);
    });
    auto grid = detail::makeGrid<openvdb::Int32Grid>();
    for (auto& leaf : leaves) grid->tree().addLeaf(leaf.release());
    grid->setTransform(object.transform().copy());
    return grid;
}

} // namespace openvdb_spheretree
