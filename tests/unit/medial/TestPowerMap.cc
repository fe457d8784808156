// SPDX-License-Identifier: Apache-2.0
/// @file TestPowerMap.cc
/// @brief The power map's interface, and its tie rule on objects small enough to think through.
/// Labels against brute force: TestTransformsOracle.cc; large radii: TestLargeRadiiOracle.cc.

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::MaskTree;

constexpr Axis kAxes[] = {Axis::X, Axis::Y, Axis::Z};

TEST(PowerMap, ASingleVoxelIsItsOwnLabel)
{
    for (const Coord& voxel : {Coord(0, 0, 0), Coord(-1, -1, -1), Coord(7, 8, 4095)}) {
        EXPECT_EQ(CoreStages(*maskOf(Voxels{voxel})).labels.label(voxel), voxel);
    }
}

TEST(PowerMap, ASmallBallBelongsToItsCentre)
{
    for (int radiusSq : {2, 4}) { // of larger ones, smaller balls cover some voxels better
        const Voxels ball = shapes::ball(radiusSq);
        const CoreStages stages(*maskOf(ball));
        for (const Coord& voxel : ball) {
            ASSERT_EQ(stages.labels.label(voxel), Coord(0, 0, 0)) << voxel;
        }
    }
}

/// Two crosses side by side along an axis share a voxel that both cover equally well, and as well
/// as it covers itself.
TEST(PowerMap, OfEquallyGoodSitesTheLargerWinsAndThenTheFirst)
{
    for (int axis = 0; axis < 3; ++axis) {
        Coord second(-1, 7, 7);
        second[axis] += 2;
        Voxels voxels = translated(shapes::ball(2), Coord(-1, 7, 7));
        for (const Coord& voxel : shapes::ball(2)) voxels.push_back(voxel + second);
        const CoreStages stages(*maskOf(voxels));
        Coord between(-1, 7, 7);
        between[axis] += 1;
        EXPECT_EQ(stages.distSq(between), 1u);
        EXPECT_EQ(stages.labels.label(between), Coord(-1, 7, 7)) << "axis " << axis;
        Coord behind = second;
        behind[axis] += 1;
        EXPECT_EQ(stages.labels.label(behind), second) << "axis " << axis;
    }
}

TEST(PowerMap, ABoxOfEvenSizeIsSplitBetweenItsMiddleVoxels)
{
    const CoordBBox box(Coord(0, 0, 0), Coord(3, 3, 3));
    const CoreStages stages(*maskOf(box));
    for (const Coord& voxel : voxelsOfBox(box)) {
        const Coord middle(voxel[0] < 2 ? 1 : 2, voxel[1] < 2 ? 1 : 2, voxel[2] < 2 ? 1 : 2);
        ASSERT_EQ(stages.labels.label(voxel), middle) << voxel;
    }
}

TEST(PowerMap, VoxelsOutsideTheObjectHaveNoLabel)
{
    const CoreStages stages(*maskOf(Voxels{Coord(-1, 0, 0), Coord(20, 0, 0)}));
    for (const Coord& voxel :
        {Coord(-2, 0, 0), Coord(0, 0, 0), Coord(21, 0, 0), Coord(1000, 0, 0)}) {
        EXPECT_THROW(stages.labels.label(voxel), openvdb::LookupError) << voxel;
    }
    try {
        stages.labels.label(Coord(12, 345, -6));
        FAIL() << "no exception";
    } catch (const openvdb::LookupError& error) {
        EXPECT_NE(std::string(error.what()).find("[12, 345, -6]"), std::string::npos)
            << error.what();
    }
}

TEST(PowerMap, AnEmptyLayoutHasNoLabels)
{
    const CoreStages stages((MaskTree(false)));
    EXPECT_THROW(stages.labels.label(Coord(0, 0, 0)), openvdb::LookupError);
}

TEST(PowerMap, OffsetsLeadFromVoxelToLabelInsideTheObject)
{
    for (uint32_t seed = 0; seed < 44; ++seed) {
        const RandomObject object = randomObject(seed);
        const CoreStages stages(*maskOf(object.voxels));
        forEachVoxel(stages.layout, [&](uint32_t leaf, uint32_t k, const Coord& voxel) {
            VoxelRef at{leaf, k};
            Coord ijk = voxel;
            for (Axis axis : kAxes) {
                ijk[int(axis)] += stages.labels.offset(axis, at);
                at = stages.labels.target(axis, at);
                ASSERT_EQ(stages.layout.voxel(at.leaf, at.index), ijk) << object.name;
                ASSERT_TRUE(stages.layout.mask(at.leaf).isOn(at.index)) << object.name;
            }
            ASSERT_EQ(stages.labels.label(voxel), ijk) << object.name;
            const VoxelRef label = stages.labels.label(VoxelRef{leaf, k});
            ASSERT_EQ(stages.layout.voxel(label.leaf, label.index), ijk) << object.name;
        });
    }
}

TEST(PowerMap, MovedCrossesLeafBorders)
{
    const CoreStages stages(*maskOf(CoordBBox(Coord(-20, -20, -20), Coord(20, 20, 20))));
    const Coord start(3, -5, 7);
    for (Axis axis : kAxes) {
        for (int steps = -15; steps <= 12; ++steps) {
            Coord end = start;
            end[int(axis)] += steps;
            const VoxelRef from{*stages.layout.findLeaf(start), leafIndex(start)};
            const VoxelRef to = moved(stages.layout, axis, from, steps);
            ASSERT_EQ(stages.layout.voxel(to.leaf, to.index), end);
        }
    }
}

TEST(PowerMap, TwoDimensionsLeaveTheZAxisOut)
{
    const CoordBBox box(Coord(-6, -6, 0), Coord(6, 6, 3));
    const CoreStages flat(*maskOf(box), 2), solid(*maskOf(box), 3);
    EXPECT_FALSE(flat.labels.usesZ());
    EXPECT_TRUE(solid.labels.usesZ());
    for (const Coord& voxel : voxelsOfBox(box)) {
        ASSERT_EQ(flat.labels.label(voxel)[2], voxel[2]);
    }
}

TEST(PowerMap, TilesHaveTheLabelsOfTheirVoxels)
{
    struct {
        int size;
        openvdb::Index level;
    } const tiles[] = {{8, 1}, {128, 2}};
    for (const auto& tile : tiles) {
        MaskTree tree(false);
        tree.addTile(tile.level, Coord(-tile.size, 0, tile.size), true, true);
        const CoreStages asTile(tree);
        tree.voxelizeActiveTiles(false);
        const CoreStages asVoxels(tree);
        const int half = tile.size / 2;
        const Coord middle = Coord(-tile.size, 0, tile.size).offsetBy(half - 1);
        EXPECT_EQ(asTile.labels.label(middle), middle);
        forEachVoxel(asTile.layout, [&](uint32_t, uint32_t, const Coord& voxel) {
            ASSERT_EQ(asTile.labels.label(voxel), asVoxels.labels.label(voxel));
        });
    }
}

TEST(PowerMap, VoxelsFarApartLabelThemselves)
{
    for (int far : {1000000, 1 << 27}) {
        const CoreStages stages(*maskOf(Voxels{Coord(-far, 0, 0), Coord(far, 0, 0)}));
        EXPECT_EQ(stages.labels.label(Coord(far, 0, 0)), Coord(far, 0, 0));
        EXPECT_EQ(stages.labels.label(Coord(-far, 0, 0)), Coord(-far, 0, 0));
    }
}

} // namespace
