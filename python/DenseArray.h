// SPDX-License-Identifier: Apache-2.0
/// @file DenseArray.h
/// @brief Values of a sparse tree into an array of numpy that has the shape of a volume.

#pragma once

#include "Volume.h"

#include <openvdb_spheretree/voxel/BoxSides.h>

#include <openvdb/tree/LeafManager.h>
#include <pybind11/numpy.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace binding {

/// Where the voxels of a volume are in an array of its shape, in C order.
class DensePlace {
public:
    explicit DensePlace(const Volume& volume) : mMin(volume.box.min())
    {
        const auto sides = openvdb_spheretree::detail::sidesOf(volume.box);
        const auto length = [&](int axis) { return std::size_t(sides[std::size_t(axis)]); };
        mStride = volume.reversed ? std::array<std::size_t, 3>{1, length(0), length(0) * length(1)}
                                  : std::array<std::size_t, 3>{length(1) * length(2), length(2), 1};
    }
    std::size_t operator()(const openvdb::Coord& ijk) const
    {
        std::size_t place = 0;
        for (int axis = 0; axis < 3; ++axis) {
            place += std::size_t(int64_t(ijk[axis]) - mMin[axis]) * mStride[std::size_t(axis)];
        }
        return place;
    }

private:
    openvdb::Coord mMin;
    std::array<std::size_t, 3> mStride;
};

/// @brief Put convert(value) in the place of each active voxel, tiles included. Parallel, without the GIL.
/// @param tree  its active voxels lie in the volume's box
template <typename T, typename Tree, typename Convert>
void fillDense(
    const Volume& volume, pybind11::array& array, const Tree& tree, const Convert& convert)
{
    T* const data = static_cast<T*>(array.mutable_data());
    const pybind11::gil_scoped_release others;
    const DensePlace place(volume);
    openvdb::tree::LeafManager<const Tree> leaves(tree);
    leaves.foreach ([&](const auto& leaf, std::size_t) {
        for (auto value = leaf.cbeginValueOn(); value; ++value) {
            data[place(value.getCoord())] = T(convert(*value));
        }
    });
    auto tile = tree.cbeginValueOn();
    tile.setMaxDepth(Tree::DEPTH - 2); // above leaves
    for (; tile; ++tile) {
        openvdb::CoordBBox box;
        tile.getBoundingBox(box);
        openvdb_spheretree::detail::forEachVoxelOf(
            box, [&](const openvdb::Coord& ijk) { data[place(ijk)] = T(convert(*tile)); });
    }
}

} // namespace binding
