// SPDX-License-Identifier: Apache-2.0
/// @file TestLevelSets.cc
/// @brief Level sets as objects: the voxels of values below the iso, tiles included.

#include <openvdb_spheretree/input/Object.h>

#include "support/Messages.h"
#include "support/ObjectGrids.h"

#include <openvdb/math/Math.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <gtest/gtest.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

TEST(LevelSets, TheInteriorOfALevelSetIsWhereItsValueIsBelowTheIso)
{
    const auto grid = openvdb::tools::createLevelSetSphere<FloatGrid>(
        20.0f, openvdb::Vec3f(0.3f, -5.2f, 7.1f), 0.5f);
    for (double value : {0.0, 0.6, -0.6}) {
        const auto object = objectOf(*grid, iso(value));
        std::size_t wrong = 0;
        for (const Coord& ijk : CoordBBox(Coord(-60), Coord(60))) {
            wrong += object->tree().isValueOn(ijk) != (grid->tree().getValue(ijk) < value);
        }
        EXPECT_EQ(wrong, 0u) << "iso " << value;
    }
}

TEST(LevelSets, AVoxelOfJustTheIsoIsOutside)
{
    const auto grid = named<FloatGrid>("set", 3.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->tree().setValueOn(Coord(0, 0, 0), 0.5f);
    grid->tree().setValueOn(Coord(1, 0, 0), std::nextafter(0.5f, 0.0f));
    EXPECT_EQ(voxelsOf(*objectOf(*grid, iso(0.5))), (std::set<Coord>{{1, 0, 0}}));

    const auto doubles = named<openvdb::DoubleGrid>("doubles", 3.0);
    doubles->setGridClass(openvdb::GRID_LEVEL_SET);
    doubles->tree().setValueOn(Coord(0, 0, 0), 0.5);
    doubles->tree().setValueOn(Coord(1, 0, 0), std::nextafter(0.5, 0.0));
    EXPECT_EQ(voxelsOf(*objectOf(*doubles, iso(0.5))), (std::set<Coord>{{1, 0, 0}}));
}

TEST(LevelSets, ALevelSetMayBeOfIntegers)
{
    const auto grid = named<openvdb::Int32Grid>("set", 3);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    for (int x = -2; x <= 2; ++x) grid->tree().setValueOn(Coord(x, 0, 0), x);
    using Voxels = std::set<Coord>;
    EXPECT_EQ(voxelsOf(*objectOf(*grid, iso(-1))), (Voxels{{-2, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectOf(*grid, iso(-0.5))), (Voxels{{-2, 0, 0}, {-1, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectOf(*grid, iso(0.5))), (Voxels{{-2, 0, 0}, {-1, 0, 0}, {0, 0, 0}}));
}

TEST(LevelSets, TilesCountByTheirValueOnEveryNodeLevel)
{
    for (openvdb::Index level : {1, 2, 3}) {
        const auto grid = named<FloatGrid>("tiles", 0.0f);
        const Coord inactive(0, 0, 0), active(4096, 0, 0), below(8192, 0, 0);
        grid->tree().addTile(level, inactive, 1.0f, false);
        grid->tree().addTile(level, active, 1.0f, true);
        grid->tree().addTile(level, below, -1.0f, true);
        const auto object = objectOf(*grid);
        const uint64_t side = uint64_t(level == 1 ? 8 : level == 2 ? 128 : 4096);
        EXPECT_EQ(object->activeVoxelCount(), 2 * side * side * side);
        EXPECT_TRUE(object->tree().isValueOn(inactive) && object->tree().isValueOn(active));
    }
}

TEST(LevelSets, TheDeepInteriorOfALevelSetStaysTiles)
{
    const auto grid =
        openvdb::tools::createLevelSetSphere<FloatGrid>(100.0f, openvdb::Vec3f(0), 1.0f);
    const auto object = objectOf(*grid);
    EXPECT_GT(object->tree().activeTileCount(), 100u);
    EXPECT_LE(object->tree().leafCount(), grid->tree().leafCount());
    EXPECT_NEAR(
        double(object->activeVoxelCount()), 4.0 / 3 * openvdb::math::pi<double>() * 1e6, 4e4);
}

TEST(LevelSets, InteriorTilesFarFromAnyLeafCount)
{
    const auto grid = named<FloatGrid>("huge", 3.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->tree().addTile(3, Coord(0, 0, 0), -3.0f, false);
    grid->tree().addTile(1, Coord(8192, 0, 0), -3.0f, false);
    grid->tree().addTile(1, Coord(8200, 0, 0), 3.0f, false);
    const uint64_t upper = 4096;
    EXPECT_EQ(objectOf(*grid)->activeVoxelCount(), upper * upper * upper + 512);
}

TEST(LevelSets, AnIsoBeyondTheNarrowBandIsAnErrorThatNamesTheBand)
{
    const auto grid =
        openvdb::tools::createLevelSetSphere<FloatGrid>(10.0f, openvdb::Vec3f(0), 0.5f);
    grid->setName("ball");
    for (double value : {1.5, -1.5, 2.0, -2.0}) {
        const std::string why = whyNot(*grid, iso(value));
        EXPECT_TRUE(mentions(why, "'ball'"));
        EXPECT_TRUE(mentions(why, "between -1.5 and 1.5"));
    }
    EXPECT_TRUE(mentions(whyNot(*grid, iso(std::nan(""))), "iso="));
    EXPECT_NO_THROW(objectOf(*grid, iso(1.49)));
    EXPECT_NO_THROW(objectOf(*grid, iso(-1.49)));
}

TEST(LevelSets, AFogVolumeMarkedAsLevelSetIsAnErrorThatSaysSo)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->tree().setValueOn(Coord(0, 0, 0), 1.0f);
    EXPECT_TRUE(mentions(whyNot(*grid), "change the grid's class"));
}

TEST(LevelSets, ALevelSetThatIsNotMarkedAsOneIsAnErrorThatSaysSo)
{
    const auto grid =
        openvdb::tools::createLevelSetSphere<FloatGrid>(10.0f, openvdb::Vec3f(0), 0.5f);
    grid->setGridClass(openvdb::GRID_UNKNOWN);
    EXPECT_TRUE(mentions(whyNot(*grid), "'level set'"));
}

} // namespace
