// SPDX-License-Identifier: Apache-2.0
/// @file GeneratedShapes.h
/// @brief Generated objects, and their voxels against a rule, one by one.

#pragma once

#include <openvdb_spheretree/input/shapes/GeneratedObject.h>

#include <openvdb/openvdb.h>

#include <gtest/gtest.h>

#include <functional>

namespace spheretree_test {

using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb_spheretree::GeneratedObjectSettings;
using openvdb_spheretree::Shape;

inline GeneratedObjectSettings settingsOf(Shape shape, int64_t voxels, uint64_t seed = 1)
{
    GeneratedObjectSettings settings;
    settings.shape = shape;
    settings.voxels = voxels;
    settings.seed = seed;
    return settings;
}

inline BoolGrid::Ptr made(Shape shape, int64_t voxels, uint64_t seed = 1)
{
    return generateObject(settingsOf(shape, voxels, seed));
}

inline CoordBBox boxOf(const BoolGrid& grid) { return grid.evalActiveVoxelBoundingBox(); }

using Rule = std::function<bool(const Coord&)>;

/// The grid's voxels are those of the box by the rule, on and true, and there are no others.
inline void expectRule(const BoolGrid& grid, const CoordBBox& box, const Rule& rule)
{
    const auto accessor = grid.getConstAccessor();
    uint64_t count = 0;
    for (auto ijk = box.begin(); ijk; ++ijk) {
        const bool on = rule(*ijk);
        count += on;
        ASSERT_EQ(accessor.isValueOn(*ijk), on) << *ijk;
        ASSERT_EQ(accessor.getValue(*ijk), on) << *ijk;
    }
    EXPECT_EQ(grid.activeVoxelCount(), count);
    EXPECT_FALSE(grid.background());
}

inline bool isNearCube(const Coord& sides)
{
    return sides[0] >= sides[1] && sides[1] >= sides[2] && sides[0] - sides[2] <= 1;
}

} // namespace spheretree_test
