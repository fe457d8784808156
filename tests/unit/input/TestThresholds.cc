// SPDX-License-Identifier: Apache-2.0
/// @file TestThresholds.cc
/// @brief Scalar grids as objects: the voxels of values above a threshold.

#include <openvdb_spheretree/input/Object.h>

#include "support/Messages.h"
#include "support/ObjectGrids.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

using openvdb::Int64Grid;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Thresholds, ValuesAboveTheThresholdCountAndOthersDoNot)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    grid->tree().setValueOn(Coord(0, 0, 0), 0.5f);
    grid->tree().setValueOn(Coord(1, 0, 0), std::nextafter(0.5f, 1.0f));
    grid->tree().setValueOn(Coord(-2, 0, 0), 1.0f);
    grid->tree().setValueOn(Coord(-3, 0, 0), -1.0f);
    EXPECT_EQ(voxelsOf(*objectOf(*grid)), (std::set<Coord>{{0, 0, 0}, {1, 0, 0}, {-2, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectOf(*grid, threshold(0.5))), (std::set<Coord>{{1, 0, 0}, {-2, 0, 0}}));
}

TEST(Thresholds, InactiveValuesAboveTheThresholdCountAsWell)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->tree().setValueOff(Coord(0, 0, 0), 1.0f);
    grid->tree().addTile(1, Coord(8, 0, 0), 1.0f, false);
    EXPECT_EQ(objectOf(*grid)->activeVoxelCount(), 513u);
}

TEST(Thresholds, ABackgroundAboveTheThresholdIsAnUnboundedObject)
{
    const auto grid = named<FloatGrid>("fog", 0.25f);
    grid->tree().setValueOn(Coord(0, 0, 0), 1.0f);
    const std::string why = whyNot(*grid);
    EXPECT_TRUE(mentions(why, "'fog'"));
    EXPECT_TRUE(mentions(why, "0.25"));
    EXPECT_TRUE(mentions(why, "threshold=0"));
    EXPECT_EQ(objectOf(*grid, threshold(0.25))->activeVoxelCount(), 1u);
}

TEST(Thresholds, AThresholdThatIsNoFiniteNumberIsAnError)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->tree().setValueOn(Coord(0, 0, 0), 1.0f);
    for (double value : {std::nan(""), kInfinity, -kInfinity}) {
        const std::string why = whyNot(*grid, threshold(value));
        EXPECT_TRUE(mentions(why, "threshold=") && mentions(why, "is not a finite number")) << why;
    }
}

TEST(Thresholds, NanIsOutsideAndInfinityIsNot)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->tree().setValueOn(Coord(0, 0, 0), std::numeric_limits<float>::quiet_NaN());
    grid->tree().setValueOn(Coord(1, 0, 0), std::numeric_limits<float>::infinity());
    grid->tree().setValueOn(Coord(2, 0, 0), -std::numeric_limits<float>::infinity());
    int64_t notNumbers = -1;
    EXPECT_EQ(voxelsOf(*objectOf(*grid, {}, nullptr, &notNumbers)), (std::set<Coord>{{1, 0, 0}}));
    EXPECT_EQ(notNumbers, 1);
}

TEST(Thresholds, ValuesThatAreNoNumbersAreCountedOnce)
{
    const double nan = std::nan("");
    const auto grid = named<openvdb::DoubleGrid>("fog", 0.0);
    grid->fill(openvdb::CoordBBox(Coord(0), Coord(15)), 1.0);
    grid->tree().setValueOff(Coord(3, 4, 5), nan); // inactive, and counts
    for (int i = 0; i < 8; ++i) grid->tree().setValueOn(Coord(i, 9, 2), nan);
    grid->tree().addTile(1, Coord(4096, 0, 0), nan, true);  // of 8^3 voxels
    grid->tree().addTile(2, Coord(8192, 0, 0), nan, false); // of 128^3
    ObjectSettings range;
    range.above = ValueBound(0.5);
    range.below = ValueBound(2.0);
    for (const Coverage coverage : {Coverage::Centers, Coverage::Cubes, Coverage::Whole}) {
        for (ObjectSettings settings : {threshold(0), range}) {
            settings.coverage = coverage;
            int64_t notNumbers = -1;
            objectOf(*grid, settings, nullptr, &notNumbers);
            EXPECT_EQ(notNumbers, 11);
        }
    }
}

TEST(Thresholds, AnObjectOfNothingButNanIsNone)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->tree().setValueOn(Coord(0, 0, 0), std::numeric_limits<float>::quiet_NaN());
    grid->tree().setValueOn(Coord(1, 0, 0), std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(mentions(whyNot(*grid), "2 are no numbers (NaN)")) << whyNot(*grid);
    EXPECT_FALSE(mentions(whyNot(*named<FloatGrid>("air", 0.0f)), "NaN"));
}

TEST(Thresholds, DoublesKeepTheirPrecision)
{
    const auto grid = named<openvdb::DoubleGrid>("d", 0.0);
    grid->tree().setValueOn(Coord(0, 0, 0), 1.0);
    grid->tree().setValueOn(Coord(1, 0, 0), std::nextafter(1.0, 2.0));
    EXPECT_EQ(voxelsOf(*objectOf(*grid, threshold(1.0))), (std::set<Coord>{{1, 0, 0}}));
}

TEST(Thresholds, IntegersAreComparedWithoutRounding)
{
    const int64_t big = (int64_t(1) << 53); // the last of the integers that doubles hold
    const auto grid = named<Int64Grid>("labels", std::numeric_limits<int64_t>::lowest());
    grid->tree().setValueOn(Coord(0, 0, 0), big);
    grid->tree().setValueOn(Coord(1, 0, 0), big + 1);
    grid->tree().setValueOn(Coord(2, 0, 0), std::numeric_limits<int64_t>::max());
    grid->tree().setValueOn(Coord(3, 0, 0), -5);
    using Voxels = std::set<Coord>;
    EXPECT_EQ(voxelsOf(*objectOf(*grid, threshold(double(big)))), (Voxels{{1, 0, 0}, {2, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectOf(*grid, threshold(-5.5))),
        (Voxels{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectOf(*grid, threshold(-5))), (Voxels{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectOf(*grid, threshold(-std::ldexp(1.0, 63)))).size(), 4u);
    EXPECT_TRUE(mentions(whyNot(*grid, threshold(std::ldexp(1.0, 63))), "threshold="));
    EXPECT_TRUE(mentions(whyNot(*grid, threshold(-1e30)), "no bounds"));
}

TEST(Thresholds, TakesThresholdsBeyondTheRangeOfTheGrid)
{
    const auto grid = named<openvdb::Int32Grid>("i", 0);
    grid->tree().setValueOn(Coord(0, 0, 0), std::numeric_limits<int32_t>::max());
    EXPECT_EQ(objectOf(*grid, threshold(0.5))->activeVoxelCount(), 1u);
    EXPECT_EQ(objectOf(*grid, threshold(2147483646.5))->activeVoxelCount(), 1u);
    EXPECT_TRUE(mentions(whyNot(*grid, threshold(2147483647.0)), "no value above"));
    EXPECT_TRUE(mentions(whyNot(*grid, threshold(1e300)), "no value above"));
}

TEST(Thresholds, AgreesWithAVoxelByVoxelScanOfARandomGrid)
{
    std::mt19937 random(11);
    const auto grid = named<FloatGrid>("r", -1.0f);
    std::set<Coord> expected;
    for (int n = 0; n < 3000; ++n) {
        const Coord ijk(int(random() % 60) - 30, int(random() % 60) - 30, int(random() % 60) - 30);
        const float value = float(int(random() % 200) - 100) / 100;
        grid->tree().setValueOnly(ijk, value);
        if (random() % 2) grid->tree().setActiveState(ijk, true);
        if (value > 0.2) expected.insert(ijk);
        else expected.erase(ijk);
    }
    EXPECT_EQ(voxelsOf(*objectOf(*grid, threshold(0.2))), expected);
}

// ---- Ranges and labels

ObjectSettings range(std::optional<ValueBound> above, std::optional<ValueBound> below)
{
    ObjectSettings settings;
    settings.above = above;
    settings.below = below;
    return settings;
}

ObjectSettings labels(const std::vector<int64_t>& values)
{
    ObjectSettings settings;
    settings.labels = values;
    return settings;
}

TEST(Ranges, ValuesBetweenTheBoundsCountAndTheBoundsDoNot)
{
    const auto grid = named<openvdb::Int32Grid>("scan", 0);
    for (int x = -9; x < 9; ++x) grid->tree().setValueOn(Coord(x, 0, 0), x);
    using Voxels = std::set<Coord>;
    EXPECT_EQ(voxelsOf(*objectOf(*grid, range(2, 5))), (Voxels{{3, 0, 0}, {4, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectOf(*grid, range(2.5, 4))), (Voxels{{3, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectOf(*grid, range(6, std::nullopt))), (Voxels{{7, 0, 0}, {8, 0, 0}}));
    EXPECT_EQ(
        voxelsOf(*objectOf(*grid, range(std::nullopt, -7))), (Voxels{{-9, 0, 0}, {-8, 0, 0}}));
    EXPECT_TRUE(mentions(whyNot(*grid, range(3, 4)), "no value above 3 and below 4"));
    EXPECT_TRUE(mentions(whyNot(*grid, range(5, 2)), "nothing lies between"));
    EXPECT_TRUE(mentions(whyNot(*grid, range(-1, 1)), "no bounds"));
    EXPECT_TRUE(mentions(whyNot(*grid, range(std::nullopt, 1)), "no bounds"));
    EXPECT_TRUE(mentions(whyNot(*grid, range(kInfinity, 1)), "above="));
}

TEST(Ranges, IntegersOf64BitsAreComparedWithoutRounding)
{
    const int64_t big = (int64_t(1) << 62) + 1, most = std::numeric_limits<int64_t>::max();
    const auto grid = named<Int64Grid>("labels", 0);
    for (int n = -2; n <= 2; ++n) grid->tree().setValueOn(Coord(n, 0, 0), big + n);
    grid->tree().setValueOn(Coord(5, 0, 0), most);
    grid->tree().setValueOn(Coord(6, 0, 0), most - 1);
    const auto bound = [](int64_t value) { return ValueBound::of(value); };
    using Voxels = std::set<Coord>;
    EXPECT_EQ(
        voxelsOf(*objectOf(*grid, range(bound(big - 1), bound(big + 1)))), (Voxels{{0, 0, 0}}));
    EXPECT_EQ(
        voxelsOf(*objectOf(*grid, range(bound(most - 1), std::nullopt))), (Voxels{{5, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectOf(*grid, range(bound(big + 2), bound(most)))), (Voxels{{6, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectOf(*grid, labels({big, most - 1}))), (Voxels{{0, 0, 0}, {6, 0, 0}}));
    EXPECT_TRUE(
        mentions(whyNot(*grid, range(bound(most), std::nullopt)), "above 9223372036854775807"));
    EXPECT_TRUE(mentions(whyNot(*grid, labels({7, -8})), "no value of label=7,-8"));
}

TEST(Ranges, ALabelOfAGridOfDoublesIsThatNumberAndNoneNextToIt)
{
    const int64_t big = (int64_t(1) << 53) + 1; // between two doubles
    const auto grid = named<openvdb::DoubleGrid>("labels", 0);
    grid->tree().setValueOn(Coord(0, 0, 0), double(big));
    grid->tree().setValueOn(Coord(1, 0, 0), 3.0);
    grid->tree().setValueOn(Coord(2, 0, 0), 3.5);
    EXPECT_EQ(voxelsOf(*objectOf(*grid, labels({3, big}))), (std::set<Coord>{{1, 0, 0}}));
    EXPECT_TRUE(mentions(whyNot(*grid, labels({0})), "no bounds"));
}

TEST(Ranges, ContradictionsAreErrorsThatSayWhatToDo)
{
    const auto fog = named<FloatGrid>("fog", 0.0f), level = named<FloatGrid>("ls", 3.0f);
    level->setGridClass(openvdb::GRID_LEVEL_SET);
    EXPECT_TRUE(mentions(whyNot(*level, range(1, 2)), "use iso"));
    EXPECT_TRUE(mentions(whyNot(*level, labels({1})), "use iso"));
    ObjectSettings settings = labels({1});
    settings.above = 2;
    EXPECT_TRUE(mentions(whyNot(*fog, settings), "leave out above and below"));
    settings = labels({1});
    settings.coverage = Coverage::Cubes;
    EXPECT_TRUE(mentions(whyNot(*fog, settings), "coverage"));
}

/// Voxels by their cubes take a value above and one below: not of an empty range.
TEST(Ranges, WithoutAValueBetweenAreRefused)
{
    const auto fog = named<FloatGrid>("fog", 0.0f);
    fog->tree().setValue(Coord(1, 2, 3), 9.0f);
    for (const Coverage coverage : {Coverage::Centers, Coverage::Cubes, Coverage::Whole}) {
        for (const auto& [above, below] : {std::pair(5.0, 5.0), {5.0, 3.0}}) {
            ObjectSettings settings = range(above, below);
            settings.coverage = coverage;
            EXPECT_TRUE(mentions(whyNot(*fog, settings), "nothing lies between"));
        }
    }
    const int64_t large = (int64_t(1) << 60) + 1; // the double next to it is one less
    EXPECT_TRUE(ValueBound::of(large) < ValueBound::of(large + 1));
    EXPECT_FALSE(ValueBound::of(large + 1) < ValueBound::of(large));
    EXPECT_FALSE(ValueBound::of(large) < ValueBound::of(large));
}

} // namespace
