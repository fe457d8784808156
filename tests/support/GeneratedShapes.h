// SPDX-License-Identifier: Apache-2.0
/// @file GeneratedShapes.h
/// @brief Generated objects, and their voxels against a rule, one by one.

#pragma once

#include <openvdb_spheretree/input/shapes/GeneratedObject.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <cstdint>
#include <functional>

namespace spheretree_test {

using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb_spheretree::GeneratedObjectSettings;
using openvdb_spheretree::Shape;

GeneratedObjectSettings settingsOf(Shape shape, int64_t voxels, uint64_t seed = 1);

openvdb::SharedPtr<BoolGrid> made(Shape shape, int64_t voxels, uint64_t seed = 1);

CoordBBox boxOf(const BoolGrid& grid);

using Rule = std::function<bool(const Coord&)>;

/// The grid's voxels are those of the box by the rule, on and true, and there are no others.
void expectRule(const BoolGrid& grid, const CoordBBox& box, const Rule& rule);

bool isNearCube(const Coord& sides);

} // namespace spheretree_test
