// SPDX-License-Identifier: Apache-2.0
#include "GeneratedShapes.h"

#include <openvdb_spheretree/voxel/MaskGrids.h>

#include <gtest/gtest.h>

namespace spheretree_test {

GeneratedObjectSettings settingsOf(Shape shape, int64_t voxels, uint64_t seed)
{
    GeneratedObjectSettings settings;
    settings.shape = shape;
    settings.voxels = voxels;
    settings.seed = seed;
    return settings;
}

openvdb::SharedPtr<BoolGrid> made(Shape shape, int64_t voxels, uint64_t seed)
{
    return generateObject(settingsOf(shape, voxels, seed));
}

CoordBBox boxOf(const BoolGrid& grid) { return grid.evalActiveVoxelBoundingBox(); }

void expectRule(const BoolGrid& grid, const CoordBBox& box, const Rule& rule)
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

bool isNearCube(const Coord& sides)
{
    return sides[0] >= sides[1] && sides[1] >= sides[2] && sides[0] - sides[2] <= 1;
}

} // namespace spheretree_test
