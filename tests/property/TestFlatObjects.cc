// SPDX-License-Identifier: Apache-2.0
/// @file TestFlatObjects.cc
/// @brief Two dimensions along any axis: an object turned on its side has the same tree, turned.

#include "support/BuiltTrees.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/medial/DistanceTransform.h>
#include <openvdb_spheretree/medial/MedialAxis.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>

namespace {

using namespace spheretree_test;
using openvdb_spheretree::Distance;
using openvdb_spheretree::FlatAxis;

/// An object flat along z, at a height that is no multiple of anything.
Voxels flatObject(uint32_t seed)
{
    return translated(flattened(randomObject(seed).voxels), Coord(-3, 5, 13));
}

Voxels turnedFromZ(Voxels voxels, int axis)
{
    for (Coord& voxel : voxels) voxel = FlatAxis(axis).fromZ(voxel);
    return voxels;
}

std::vector<SphereTreeSettings> flatSettings()
{
    std::vector<SphereTreeSettings> all;
    for (const TreeType type : {TreeType::Reversible, TreeType::Extended}) {
        for (const SphereTreeSettings& settings : allSettings(type, 2)) all.push_back(settings);
    }
    all.push_back(all.back());
    all.back().pyramid().dist = Distance::chamfer(3, 4, 5);
    return all;
}

TEST(FlatObjects, TurnedThereAndBackIsTheSame)
{
    const Coord ijk(1, 2, 3);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(FlatAxis(axis).fromZ(FlatAxis(axis).toZ(ijk)), ijk);
        EXPECT_EQ(FlatAxis(axis).toZ(ijk)[2], ijk[axis]);
    }
}

TEST(FlatObjects, HaveTheTreeOfTheObjectTurnedSoThatItIsFlatAlongZ)
{
    for (uint32_t seed = 0; seed < 22; ++seed) {
        const Voxels flat = flatObject(seed);
        const auto upright = gridOf(flat);
        for (int axis = 0; axis < 2; ++axis) {
            const FlatAxis turn(axis);
            const Voxels turned = turnedFromZ(flat, axis);
            const auto grid = gridOf(turned);
            if (boxOf(flat).min()[0] == boxOf(flat).max()[0]) continue; // flat along two axes
            if (boxOf(flat).min()[1] == boxOf(flat).max()[1]) continue;
            for (const SphereTreeSettings& settings : flatSettings()) {
                SCOPED_TRACE("seed " + std::to_string(seed) + " axis " + std::to_string(axis) + ' '
                    + describe(settings));
                const SphereTree expected = buildSphereTree(*upright, settings);
                SphereTree tree = buildSphereTree(*grid, settings);
                ASSERT_EQ(tree.flatAxis, axis);
                ASSERT_EQ(turn.toZ(tree.origin), expected.origin);
                ASSERT_TRUE(covers(tree, turned));
                for (auto& center : tree.spheres.center) center = turn.toZ(center);
                for (auto& ijk : tree.ijk) ijk = turn.toZ(ijk);
                ASSERT_TRUE(sameNodes(tree, expected));
            }
        }
    }
}

TEST(FlatObjects, AreCountedCheckedAndStoredInTheirPlane)
{
    for (uint32_t seed = 30; seed < 41; ++seed) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto grid = gridOf(turnedFromZ(flatObject(seed), axis));
            SphereTreeSettings settings = extendedTree();
            settings.dim = 2;
            settings.pyramid().dag = true;
            SphereTree tree = buildSphereTree(*grid, settings);
            computeLevelErrors(tree, *grid);
            EXPECT_EQ(tree.levels[0].error->excess, 0);
            const SphereTree read = openvdb_spheretree::fromPoints(
                *openvdb_spheretree::toPoints(tree), openvdb_spheretree::dagToPoints(tree).get());
            EXPECT_EQ(read.flatAxis, tree.flatAxis);
            const auto faults = openvdb_spheretree::checkSphereTree(read, *grid);
            EXPECT_TRUE(faults.empty()) << faults.front().sentence;
        }
    }
}

TEST(FlatObjects, HaveTheirStagesTurnedToo)
{
    const Voxels flat = flatObject(4);
    const auto upright = gridOf(flat);
    const auto expectedDistances = openvdb_spheretree::distanceTransform(*upright, 2);
    const auto expectedBalls = openvdb_spheretree::medialBalls(*upright, 2);
    const auto expectedPyramid = openvdb_spheretree::buildOrPyramid(*upright, 3, 2);
    for (int axis = 0; axis < 2; ++axis) {
        const FlatAxis turn(axis);
        const auto grid = gridOf(turnedFromZ(flat, axis));
        const auto distances = openvdb_spheretree::distanceTransform(*grid, 2);
        ASSERT_EQ(distances->activeVoxelCount(), expectedDistances->activeVoxelCount());
        for (auto voxel = distances->cbeginValueOn(); voxel; ++voxel) {
            ASSERT_EQ(*voxel, expectedDistances->tree().getValue(turn.toZ(voxel.getCoord())));
        }
        auto balls = openvdb_spheretree::medialBalls(*grid, 2);
        for (auto& ball : balls) ball.center = turn.toZ(ball.center);
        EXPECT_EQ(balls, expectedBalls);
        const auto pyramid = openvdb_spheretree::buildOrPyramid(*grid, 3, 2);
        ASSERT_EQ(pyramid.levels.size(), expectedPyramid.levels.size());
        EXPECT_EQ(turn.toZ(pyramid.origin), expectedPyramid.origin);
        for (std::size_t k = 0; k < pyramid.levels.size(); ++k) {
            Voxels voxels = voxelsOf(*pyramid.levels[k]);
            for (Coord& voxel : voxels) voxel = turn.toZ(voxel);
            EXPECT_EQ(voxels, voxelsOf(*expectedPyramid.levels[k]));
        }
    }
}

TEST(FlatObjects, AThickObjectIsRefusedWithItsSize)
{
    SphereTreeSettings settings;
    settings.dim = 2;
    const auto grid = gridOf(*maskOf(CoordBBox(Coord(0, 0, 0), Coord(4, 3, 2))));
    try {
        buildSphereTree(*grid, settings);
        FAIL() << "a thick object was taken";
    } catch (const openvdb::ValueError& error) {
        EXPECT_NE(std::string(error.what()).find("5 x 4 x 3"), std::string::npos) << error.what();
    }
}

} // namespace
