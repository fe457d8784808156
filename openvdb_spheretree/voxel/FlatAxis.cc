// SPDX-License-Identifier: Apache-2.0
#include "FlatAxis.h"

#include "BoxSides.h"
#include "Masks.h"

#include <openvdb/Grid.h>

#include <memory>

namespace openvdb_spheretree {

namespace {

using openvdb::Coord;
using openvdb::MaskTree;

template <typename Turn>
MaskTree::Ptr turned(const MaskTree& mask, const Turn& turn)
{
    auto result = std::make_shared<MaskTree>(false);
    openvdb::tree::ValueAccessor<MaskTree> accessor(*result);
    for (auto leaf = mask.cbeginLeaf(); leaf; ++leaf) {
        for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel) {
            accessor.setValueOn(turn(voxel.getCoord()));
        }
    }
    detail::forEachTile(mask, [&](const openvdb::CoordBBox& box) {
        detail::forEachVoxelOf(box, [&](const Coord& ijk) { accessor.setValueOn(turn(ijk)); });
    });
    return result;
}

} // namespace

int flatAxisOf(const openvdb::CoordBBox& box)
{
    for (int axis = 2; axis >= 0; --axis) {
        if (box.min()[axis] == box.max()[axis]) return axis;
    }
    return -1;
}

FlatAxis flatAxisOf(const openvdb::BoolGrid& object, int dim)
{
    openvdb::CoordBBox box;
    if (dim != 2 || !object.tree().evalActiveVoxelBoundingBox(box)) return FlatAxis(2);
    const int axis = flatAxisOf(box);
    return FlatAxis(axis < 0 ? 2 : axis);
}

MaskTree::Ptr voxelsOf(const openvdb::BoolGrid& object, const FlatAxis& flat)
{
    return flat.toZ(std::make_shared<MaskTree>(object.tree(), false, openvdb::TopologyCopy()));
}

MaskTree::Ptr FlatAxis::toZ(const MaskTree::Ptr& mask) const
{
    return isZ() ? mask : turned(*mask, [this](const Coord& ijk) { return toZ(ijk); });
}

MaskTree::Ptr FlatAxis::fromZ(const MaskTree::Ptr& mask) const
{
    return isZ() ? mask : turned(*mask, [this](const Coord& ijk) { return fromZ(ijk); });
}

} // namespace openvdb_spheretree
