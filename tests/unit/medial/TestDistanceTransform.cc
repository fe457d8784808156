// SPDX-License-Identifier: Apache-2.0
/// @file TestDistanceTransform.cc
/// @brief The distance transform's interface. Values against brute force: TestTransformsOracle.cc;
/// large radii: TestLargeRadiiOracle.cc.

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/medial/DistanceTransform.h>

#include <openvdb/openvdb.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::MaskTree;

uint32_t distSqAt(const LeafLayout& layout, const DistanceMap& map, const Coord& ijk)
{
    return map.at(*layout.findLeaf(ijk), leafIndex(ijk));
}

/// Of every voxel of a solid box, the squared steps to its nearest face.
void expectBox(const MaskTree& tree, const CoordBBox& box, int dim)
{
    const LeafLayout layout(tree);
    const DistanceMap map = distanceTransform(layout, dim);
    ASSERT_EQ(layout.voxelCount(), int64_t(box.volume()));
    forEachVoxel(layout, [&](uint32_t leaf, uint32_t k, const Coord& voxel) {
        int steps = 1 << 20;
        for (int axis = 0; axis < dim; ++axis) {
            steps = std::min(
                {steps, voxel[axis] - box.min()[axis] + 1, box.max()[axis] - voxel[axis] + 1});
        }
        ASSERT_EQ(map.at(leaf, k), uint32_t(steps * steps)) << voxel << " in " << box;
    });
}

TEST(DistanceTransform, ASingleVoxelIsOneAwayFromBackground)
{
    for (const Coord& voxel : {Coord(0, 0, 0), Coord(-1, -1, -1), Coord(7, 8, 4095)}) {
        const LeafLayout layout(*maskOf(Voxels{voxel}));
        const DistanceMap map = distanceTransform(layout);
        EXPECT_EQ(distSqAt(layout, map, voxel), 1u);
        EXPECT_EQ(map.largest(), 1u);
    }
}

TEST(DistanceTransform, BackgroundIsZeroAllOverTheLeaf)
{
    const RandomObject object = randomObject(3);
    const LeafLayout layout(*maskOf(object.voxels));
    const DistanceMap map = distanceTransform(layout);
    for (uint32_t leaf = 0; leaf < layout.leafCount(); ++leaf) {
        for (uint32_t k = 0; k < kLeafVoxels; ++k) {
            ASSERT_EQ(map.at(leaf, k) > 0, layout.mask(leaf).isOn(k));
        }
    }
}

TEST(DistanceTransform, AnEmptyLayoutHasNoDistances)
{
    const LeafLayout layout((MaskTree(false)));
    EXPECT_EQ(distanceTransform(layout).largest(), 0u);
    EXPECT_EQ(distanceTransform(layout, 2).largest(), 0u);
}

TEST(DistanceTransform, TheLargestDistanceIsThatOfTheDeepestVoxel)
{
    const Voxels voxels = shapes::ball(81);
    const LeafLayout layout(*maskOf(voxels));
    const DistanceMap map = distanceTransform(layout);
    EXPECT_EQ(map.largest(), 81u);
    EXPECT_EQ(distSqAt(layout, map, Coord(0, 0, 0)), 81u);
}

TEST(DistanceTransform, TheLargestDistanceIsFoundInWhicheverLeafItIs)
{
    const Coord corners[] = {Coord(0, 0, 0), Coord(0, 8, 16), Coord(16, 0, 8), Coord(24, 24, 24)};
    for (const Coord& deepest : corners) {
        auto mask = maskOf(Voxels(std::begin(corners), std::end(corners)));
        mask->fill(CoordBBox(deepest, deepest.offsetBy(4)), true);
        EXPECT_EQ(distanceTransform(LeafLayout(*mask)).largest(), 9u) << deepest;
    }
}

TEST(DistanceTransform, BoxesHaveTheirClosedForm)
{
    const CoordBBox box(Coord(-17, -3, 120), Coord(12, 40, 131));
    expectBox(*maskOf(box), box, 3);
    expectBox(*maskOf(voxelsOfBox(box)), box, 3);
}

TEST(DistanceTransform, TwoDimensionsLeaveTheZAxisOut)
{
    const CoordBBox plate(Coord(-17, -3, 5), Coord(12, 40, 5)),
        box(Coord(1, 2, 3), Coord(30, 40, 60));
    expectBox(*maskOf(plate), plate, 2);
    expectBox(*maskOf(box), box, 2);
    const LeafLayout layout(*maskOf(plate));
    EXPECT_EQ(distanceTransform(layout, 3).largest(), 1u);
    EXPECT_EQ(distanceTransform(layout, 2).largest(), 225u);
}

TEST(DistanceTransform, TilesHaveTheDistancesOfTheirVoxels)
{
    struct {
        int size;
        openvdb::Index level;
    } const tiles[] = {{8, 1}, {128, 2}};
    for (const auto& tile : tiles) {
        const CoordBBox box = CoordBBox::createCube(Coord(-tile.size, 0, tile.size), tile.size);
        MaskTree tree(false);
        tree.addTile(tile.level, box.min(), true, true);
        expectBox(tree, box, 3);
    }
}

TEST(DistanceTransform, VoxelsFarApartDoNotSeeEachOther)
{
    for (int far : {1000000, 1 << 27}) {
        const LeafLayout layout(
            *maskOf(Voxels{Coord(0, 0, 0), Coord(far, 0, 0), Coord(0, far, far)}));
        EXPECT_EQ(distanceTransform(layout).largest(), 1u);
    }
}

TEST(DistanceTransform, ValuesAreStoredIn16BitsWhereTheyFit)
{
    const LeafLayout thin(*maskOf(CoordBBox(Coord(0, 0, 0), Coord(506, 506, 0))));  // radius 254
    const LeafLayout thick(*maskOf(CoordBBox(Coord(0, 0, 0), Coord(508, 508, 0)))); // radius 255
    const DistanceMap narrow = distanceTransform(thin, 2), wide = distanceTransform(thick, 2);
    EXPECT_NE(narrow.narrow(), nullptr);
    EXPECT_EQ(narrow.wide(), nullptr);
    EXPECT_EQ(narrow.largest(), 254u * 254u);
    EXPECT_EQ(wide.narrow(), nullptr);
    EXPECT_NE(wide.wide(), nullptr);
    EXPECT_EQ(wide.largest(), 255u * 255u);
}

void expectValuesOfMap(const LeafLayout& layout, int dim)
{
    const DistanceMap map = distanceTransform(layout, dim);
    std::vector<int32_t> values(std::size_t(layout.leafCount()) * kLeafVoxels, -1);
    ASSERT_EQ(distanceTransform(layout, values.data(), dim), map.largest());
    for (uint32_t leaf = 0; leaf < layout.leafCount(); ++leaf) {
        for (uint32_t k = 0; k < kLeafVoxels; ++k) {
            ASSERT_EQ(values[std::size_t(leaf) * kLeafVoxels + k], int32_t(map.at(leaf, k)));
        }
    }
}

TEST(DistanceTransform, GivesTheValuesOfTheMapInTheCallersMemory)
{
    for (uint32_t seed = 0; seed < 22; ++seed) {
        const LeafLayout layout(*maskOf(randomObject(seed).voxels));
        for (const int dim : {2, 3}) {
            ASSERT_NO_FATAL_FAILURE(expectValuesOfMap(layout, dim)) << seed;
        }
    }
    for (const int radius : {181, 182, 254, 255, 256}) { // 16 bits with and without a sign, and 32
        const CoordBBox box(Coord(0, 0, 0), Coord(2 * radius - 2, 2 * radius - 2, 0));
        ASSERT_NO_FATAL_FAILURE(expectValuesOfMap(LeafLayout(*maskOf(box)), 2)) << radius;
    }
    const LeafLayout empty((MaskTree(false)));
    EXPECT_EQ(distanceTransform(empty, nullptr), 0u);
    alignas(16) int32_t values[2];
    EXPECT_THROW(distanceTransform(empty, values + 1), openvdb::ValueError);
}

TEST(DistanceTransform, TheGridHasTheObjectsVoxelsAndTransform)
{
    const RandomObject object = randomObject(9);
    const auto grid = gridOf(object.voxels);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    const openvdb::Int32Grid::Ptr distances = distanceTransform(*grid);
    EXPECT_EQ(distances->background(), 0);
    EXPECT_EQ(distances->transform(), grid->transform());
    EXPECT_EQ(distances->activeVoxelCount(), object.voxels.size());
    const NaiveReference naive(object.voxels);
    auto accessor = distances->getConstAccessor();
    for (std::size_t i = 0; i < naive.voxels().size(); ++i) {
        ASSERT_TRUE(accessor.isValueOn(naive.voxels()[i]));
        ASSERT_EQ(accessor.getValue(naive.voxels()[i]), naive.distSq(i));
    }
    for (auto it = distances->cbeginValueOff(); it; ++it) ASSERT_EQ(*it, 0) << it.getCoord();
}

TEST(DistanceTransform, TheGridMayBeOfTwoDimensionsOrEmpty)
{
    const auto plate = gridOf(*maskOf(CoordBBox(Coord(0, 0, 0), Coord(8, 8, 0))));
    EXPECT_EQ(distanceTransform(*plate, 2)->tree().getValue(Coord(4, 4, 0)), 25);
    EXPECT_EQ(distanceTransform(*plate, 3)->tree().getValue(Coord(4, 4, 0)), 1);
    EXPECT_EQ(distanceTransform(*openvdb::BoolGrid::create())->activeVoxelCount(), 0u);
}

TEST(DistanceTransform, ActiveVoxelsOfValueFalseCount)
{
    const auto grid = openvdb::BoolGrid::create(false);
    grid->tree().setValueOn(Coord(1, 2, 3), false);
    grid->tree().setValueOff(Coord(1, 2, 4), true);
    const auto distances = distanceTransform(*grid);
    EXPECT_EQ(distances->activeVoxelCount(), 1u);
    EXPECT_EQ(distances->tree().getValue(Coord(1, 2, 3)), 1);
}

TEST(DistanceTransform, OfANormTheSquareOfTheLargestFits32BitsOrIsRefused)
{
    const Distance norm = Distance::chamfer(255, 255, 255); // 46340 is 181.7 steps
    for (const int steps : {181, 182}) {
        const int side = 2 * steps - 1;
        const LeafLayout layout(*maskOf(shapes::box(Coord(side, side, 1))));
        if (steps == 181) {
            EXPECT_EQ(distanceTransform(layout, 2, norm).largest(), 181u * 255);
        } else {
            EXPECT_THROW(distanceTransform(layout, 2, norm), openvdb::ValueError);
        }
    }
}

TEST(DistanceTransform, StopsWhenInterrupted)
{
    const auto mask = maskOf(shapes::ball(100));
    const LeafLayout layout(*mask);
    for (int after : {0, 1, 2}) {
        StopAfter interrupter(after);
        EXPECT_THROW(distanceTransform(layout, 3, {}, &interrupter), Interrupted) << after;
    }
    StopAfter never(1 << 30);
    EXPECT_EQ(distanceTransform(layout, 3, {}, &never).largest(), 100u);
    StopAfter interrupter;
    EXPECT_THROW(distanceTransform(*gridOf(*mask), 3, {}, &interrupter), Interrupted);
}

} // namespace
