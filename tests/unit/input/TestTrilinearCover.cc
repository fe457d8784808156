// SPDX-License-Identifier: Apache-2.0
/// @file TestTrilinearCover.cc
/// @brief Voxels by their cubes: against all sums of all voxels of small grids, as whole numbers;
/// and against samples of the interpolation between them.

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/input/MeanOrder.h>
#include <openvdb_spheretree/input/Object.h>

#include "support/CoreStages.h"
#include "support/Messages.h"
#include "support/ObjectGrids.h"
#include "support/TemporaryFolder.h"

#include <openvdb/io/File.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Int32Grid;
using openvdb::Int64Grid;

using VoxelSet = std::set<Coord>;

ObjectSettings covering(ObjectSettings settings, Coverage coverage)
{
    settings.coverage = coverage;
    return settings;
}

ObjectSettings range(std::optional<ValueBound> above, std::optional<ValueBound> below)
{
    ObjectSettings settings;
    settings.above = above;
    settings.below = below;
    return settings;
}

VoxelSet objectVoxels(const openvdb::GridBase& grid, const ObjectSettings& settings)
{
    try {
        return spheretree_test::voxelsOf(*objectOf(grid, settings));
    } catch (const openvdb::ValueError& error) {
        EXPECT_TRUE(mentions(error.what(), "holds no object"));
        return {};
    }
}

const CoordBBox kAll(Coord(-12, -8, -12), Coord(12, 24, 20));

/// Of each voxel of kAll, eight times the interpolation at the 27 points of its cube, of a grid of whole
/// numbers.
template <typename GridT>
std::map<Coord, std::vector<int64_t>> cubeValues(const GridT& grid)
{
    CoordBBox padded = kAll;
    padded.expand(1);
    openvdb::tools::Dense<int64_t> dense(padded);
    for (const Coord& ijk : padded) dense.setValue(ijk, int64_t(grid.tree().getValue(ijk)));
    std::map<Coord, std::vector<int64_t>> all;
    for (const Coord& ijk : kAll) {
        auto& values = all[ijk];
        for (int point = 0; point < 27; ++point) {
            const int x = point / 9 - 1, y = point / 3 % 3 - 1, z = point % 3 - 1;
            int64_t sum = 0; // of eight: those of an axis without a step count twice
            for (int i = 0; i < 8; ++i) {
                sum += dense.getValue(ijk.offsetBy(x * (i & 1), y * (i >> 1 & 1), z * (i >> 2)));
            }
            values.push_back(sum);
        }
    }
    return all;
}

/// The voxels where any, or all, of these are wanted.
VoxelSet cubesOf(const std::map<Coord, std::vector<int64_t>>& all, bool any,
    const std::function<bool(int64_t)>& isWanted)
{
    VoxelSet voxels;
    for (const auto& [ijk, values] : all) {
        const bool on = any ? std::any_of(values.begin(), values.end(), isWanted)
                            : std::all_of(values.begin(), values.end(), isWanted);
        if (on) voxels.insert(ijk);
    }
    return voxels;
}

/// Whole numbers of -4 to 4 in a few blobs across the borders of nodes, tiles among them.
template <typename GridT>
typename GridT::Ptr randomNumbers(uint32_t seed, int background)
{
    using ValueT = typename GridT::ValueType;
    std::mt19937 random(seed);
    const auto grid = named<GridT>("numbers", ValueT(background));
    grid->tree().addTile(1, Coord(0, 8, 0), ValueT(int(random() % 9) - 4), true);
    grid->tree().addTile(1, Coord(-8, 0, 8), ValueT(int(random() % 9) - 4), false);
    for (int n = 0; n < 900; ++n) {
        const Coord ijk(int(random() % 14) - 7, int(random() % 20) - 3, int(random() % 14) - 7);
        grid->tree().setValueOnly(ijk, ValueT(int(random() % 9) - 4));
    }
    return grid;
}

// ---- Against all sums

template <typename GridT>
class TrilinearSums : public testing::Test {};

using NumberGrids = testing::Types<FloatGrid, openvdb::DoubleGrid, Int32Grid, Int64Grid>;
TYPED_TEST_SUITE(TrilinearSums, NumberGrids);

TYPED_TEST(TrilinearSums, OfALevelSetIsThatOfAllSums)
{
    for (uint32_t seed = 1; seed <= 4; ++seed) {
        const auto grid = randomNumbers<TypeParam>(seed, 4);
        grid->setGridClass(openvdb::GRID_LEVEL_SET);
        const auto all = cubeValues(*grid);
        for (const double level : {0.0, -1.0, 0.5, -1.25, 0.3}) {
            const auto isBelow = [&](int64_t eightfold) { return double(eightfold) < 8 * level; };
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", iso " << level);
            EXPECT_EQ(objectVoxels(*grid, covering(iso(level), Coverage::Cubes)),
                cubesOf(all, true, isBelow));
            EXPECT_EQ(objectVoxels(*grid, covering(iso(level), Coverage::Whole)),
                cubesOf(all, false, isBelow));
        }
    }
}

TYPED_TEST(TrilinearSums, OfAThresholdIsThatOfAllSums)
{
    for (uint32_t seed = 1; seed <= 4; ++seed) {
        const auto grid = randomNumbers<TypeParam>(seed, -4);
        const auto all = cubeValues(*grid);
        for (const double bound : {0.0, 1.0, -0.5, 1.25, 0.3}) {
            const auto isAbove = [&](int64_t eightfold) { return double(eightfold) > 8 * bound; };
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", threshold " << bound);
            EXPECT_EQ(objectVoxels(*grid, covering(threshold(bound), Coverage::Cubes)),
                cubesOf(all, true, isAbove));
            EXPECT_EQ(objectVoxels(*grid, covering(threshold(bound), Coverage::Whole)),
                cubesOf(all, false, isAbove));
        }
    }
}

/// A cube may meet a range that none of its 27 points is in: the interpolation passes through it.
TYPED_TEST(TrilinearSums, OfARangeIsThatOfAllSums)
{
    for (uint32_t seed = 1; seed <= 4; ++seed) {
        for (const int background : {-4, 4}) {
            const auto grid = randomNumbers<TypeParam>(seed, background);
            const auto all = cubeValues(*grid);
            for (const auto& [low, high] : {std::pair(0.0, 2.0), {-1.5, 1.125}, {0.25, 0.3}}) {
                const auto isAbove = [low = low](int64_t n) { return double(n) > 8 * low; };
                const auto isBelow = [high = high](int64_t n) { return double(n) < 8 * high; };
                const auto isBetween = [&](int64_t n) { return isAbove(n) && isBelow(n); };
                SCOPED_TRACE(
                    testing::Message() << "seed " << seed << ", " << low << " to " << high);
                VoxelSet met;
                const auto above = cubesOf(all, true, isAbove);
                const auto below = cubesOf(all, true, isBelow);
                std::set_intersection(above.begin(), above.end(), below.begin(), below.end(),
                    std::inserter(met, met.end()));
                const auto centers = objectVoxels(*grid, range(low, high));
                if (centers.empty()) continue; // refused before cubes are looked at
                EXPECT_EQ(objectVoxels(*grid, covering(range(low, high), Coverage::Cubes)), met);
                EXPECT_EQ(objectVoxels(*grid, covering(range(low, high), Coverage::Whole)),
                    cubesOf(all, false, isBetween));
            }
        }
    }
}

// ---- What it means

TEST(TrilinearCover, NoPointOfTheSolidLiesInACubeThatIsLeftOut)
{
    std::mt19937 random(5);
    const auto grid = randomNumbers<FloatGrid>(7, 4);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    const auto met = objectOf(*grid, covering(iso(0.3), Coverage::Cubes));
    const auto whole = objectOf(*grid, covering(iso(0.3), Coverage::Whole));
    const auto real = [&](int low, int high) {
        return low + double(random()) / 4294967295.0 * (high - low);
    };
    int inside = 0;
    for (int n = 0; n < 200000; ++n) {
        const openvdb::Vec3d point(real(-9, 9), real(-5, 20), real(-9, 16));
        const float value = openvdb::tools::BoxSampler::sample(grid->tree(), point);
        const Coord voxel = Coord::round(point);
        inside += value < 0.2999f;
        const bool isMet = met->tree().isValueOn(voxel), isWhole = whole->tree().isValueOn(voxel);
        EXPECT_TRUE(isMet || value > 0.2999f) << point;
        EXPECT_TRUE(!isWhole || value < 0.3001f) << point;
    }
    EXPECT_GT(inside, 10000);
}

/// A plate of half a voxel between the centers of two planes of voxels, where no value is inside.
TEST(TrilinearCover, APartThinnerThanAVoxelIsCoveredIfAVoxelIsInsideAndNoneIsLost)
{
    const auto grid = named<FloatGrid>("plate", 3.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    for (const Coord& ijk : CoordBBox(Coord(0, 0, -3), Coord(9, 9, 3))) {
        grid->tree().setValueOn(ijk, std::abs(float(ijk[2])) - 0.25f);
    }
    EXPECT_EQ(objectOf(*grid)->activeVoxelCount(), 100u);
    const auto cubes = objectOf(*grid, covering(iso(0), Coverage::Cubes));
    EXPECT_TRUE(cubes->tree().isValueOn(Coord(5, 5, 0)));
    EXPECT_FALSE(cubes->tree().isValueOn(Coord(5, 5, 1))) << "the plate ends below its cube";
    EXPECT_TRUE(mentions(whyNot(*grid, covering(iso(0), Coverage::Whole)), "whole cube"));
}

/// So the object by centers lacks no part of a level set or fog by more than that, and needs no warning.
TEST(TrilinearCover, EveryVoxelThatTheSolidMeetsTouchesOneWhoseCenterIsInside)
{
    std::size_t added = 0;
    for (uint32_t seed = 1; seed <= 20; ++seed) {
        const auto grid = randomNumbers<FloatGrid>(seed, 4);
        grid->setGridClass(openvdb::GRID_LEVEL_SET);
        const auto centers = objectVoxels(*grid, iso(-0.3));
        for (const Coord& met : objectVoxels(*grid, covering(iso(-0.3), Coverage::Cubes))) {
            const CoordBBox around(met.offsetBy(-1), met.offsetBy(1));
            int touched = 0;
            for (const Coord& ijk : around) touched += int(centers.count(ijk));
            EXPECT_GT(touched, 0) << met << ", seed " << seed;
            added += centers.count(met) == 0;
        }
    }
    EXPECT_GT(added, 2000u);
}

TEST(TrilinearCover, TheSphereIsCoveredAndCoversWhatIsWhole)
{
    const auto grid =
        openvdb::tools::createLevelSetSphere<FloatGrid>(100.0f, openvdb::Vec3f(0.3f, 0, 0), 1.0f);
    const auto centers = objectOf(*grid);
    const auto cubes = objectOf(*grid, covering(iso(0), Coverage::Cubes));
    const auto whole = objectOf(*grid, covering(iso(0), Coverage::Whole));
    EXPECT_GT(cubes->activeVoxelCount(), centers->activeVoxelCount());
    EXPECT_GT(centers->activeVoxelCount(), whole->activeVoxelCount());
    EXPECT_EQ(cubes->tree().activeTileCount(), centers->tree().activeTileCount());
    EXPECT_GE(whole->tree().activeTileCount(), centers->tree().activeTileCount());
    const int64_t unit = 1000000; // about 4 pi r^2 half diagonals on either side, in voxels
    const auto count = [](const auto& grid) { return int64_t(grid->activeVoxelCount()); };
    EXPECT_LT(count(cubes) - count(centers), unit / 8);
    EXPECT_LT(count(centers) - count(whole), unit / 8);
}

TEST(TrilinearCover, AMaskOrPointsHaveNothingBetweenTheirVoxels)
{
    const auto grid = named<BoolGrid>("bits", false);
    grid->tree().setValueOn(Coord(1, 2, 3));
    for (const Coverage coverage : {Coverage::Cubes, Coverage::Whole}) {
        EXPECT_EQ(objectVoxels(*grid, covering({}, coverage)), (VoxelSet{{1, 2, 3}}));
    }
}

// ---- Tiles

TEST(TrilinearCover, TilesOfEverySizeStayTilesAndGetASkin)
{
    for (const openvdb::Index level : {1, 2}) {
        const auto grid = named<FloatGrid>("tile", 1.0f);
        grid->setGridClass(openvdb::GRID_LEVEL_SET);
        grid->tree().addTile(level, Coord(0), -1.5f, false);
        const int side = level == 1 ? 8 : 128;
        const auto cubes = objectOf(*grid, covering(iso(0), Coverage::Cubes));
        EXPECT_EQ(cubes->tree().activeTileCount(), 1u);
        // The mean of -1.5 and 1 is inside, that of one or two -1.5 and more of 1 is not.
        EXPECT_EQ(cubes->activeVoxelCount(),
            uint64_t(side) * uint64_t(side) * uint64_t(side) + 6 * uint64_t(side) * uint64_t(side));
        const auto whole = objectOf(*grid, covering(iso(-0.9), Coverage::Whole));
        const uint64_t inner = uint64_t(side) - 2;
        EXPECT_EQ(whole->activeVoxelCount(), inner * inner * inner);
        EXPECT_EQ(whole->tree().activeTileCount() > 0, level == 2);
    }
}

TEST(TrilinearCover, TilesBesideTilesAreNotCut)
{
    const auto grid = named<FloatGrid>("tiles", 1.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    for (int x = 0; x < 2; ++x) {
        for (int y = 0; y < 2; ++y) {
            for (int z = 0; z < 2; ++z) {
                grid->tree().addTile(2, Coord(x * 128, y * 128, z * 128), -2.5f, false);
            }
        }
    }
    const auto whole = objectOf(*grid, covering(iso(-0.9), Coverage::Whole));
    EXPECT_EQ(whole->activeVoxelCount(), uint64_t(254) * 254 * 254);
    // Leaf nodes only where the cube of 32^3 of them ends.
    EXPECT_EQ(whole->tree().leafCount(), uint64_t(32 * 32 * 32 - 30 * 30 * 30));
    const auto cubes = objectOf(*grid, covering(iso(0.9), Coverage::Cubes));
    EXPECT_EQ(cubes->activeVoxelCount(), uint64_t(258) * 258 * 258);
    EXPECT_EQ(cubes->tree().activeTileCount(), 8u);
}

/// A leaf node beside a tile is no reason to leave the tile whole; nor are those around it.
TEST(TrilinearCover, TilesBesideLeafNodesThatAreNotFullAreCut)
{
    const auto grid = named<FloatGrid>("tile", 1.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->tree().addTile(2, Coord(0), -1.5f, false);
    for (const int y : {52, 60, 68}) {
        for (const int z : {52, 60, 68}) grid->tree().setValue(Coord(133, y, z), -1.5f);
    }
    const auto whole = objectOf(*grid, covering(iso(-0.9), Coverage::Whole));
    EXPECT_FALSE(whole->tree().isValueOn(Coord(127, 60, 60)));
    EXPECT_EQ(whole->activeVoxelCount(), uint64_t(126) * 126 * 126);
}

// ---- Values that are left in the file

TEST(TrilinearCover, ValuesInTheFileStayThere)
{
    openvdb::initialize();
    if (!openvdb::io::Archive::isDelayedLoadingEnabled()) GTEST_SKIP() << "no delayed loading";
    const TemporaryFolder folder;
    const std::string path = folder.path() + "/ball.vdb";
    const auto ball =
        openvdb::tools::createLevelSetSphere<FloatGrid>(30.0f, openvdb::Vec3f(0.3f, 5, 0), 1.0f);
    openvdb::io::File(path).write(openvdb::GridCPtrVec{ball});
    openvdb::io::File file(path);
    file.setCopyMaxBytes(0);
    file.open(/*delayLoad=*/true);
    const auto inFile = openvdb::gridPtrCast<FloatGrid>(file.readGrid(file.beginName().gridName()));
    for (const Coverage coverage : {Coverage::Cubes, Coverage::Whole}) {
        const auto settings = covering(iso(0.1), coverage);
        EXPECT_TRUE(
            objectOf(*inFile, settings)->tree().hasSameTopology(objectOf(*ball, settings)->tree()));
    }
    for (auto leaf = inFile->tree().cbeginLeaf(); leaf; ++leaf) {
        EXPECT_TRUE(leaf->buffer().isOutOfCore());
    }
}

// ---- What is refused

TEST(TrilinearCover, StopsWhenInterrupted)
{
    const auto ball =
        openvdb::tools::createLevelSetSphere<FloatGrid>(30.0f, openvdb::Vec3f(0), 1.0f);
    for (const Coverage coverage : {Coverage::Cubes, Coverage::Whole}) {
        for (int after = 0; after < 12; ++after) {
            StopAfter interrupter(after);
            EXPECT_THROW(objectOf(*ball, covering({}, coverage), &interrupter), Interrupted)
                << after;
        }
    }
}

TEST(TrilinearCover, AnObjectAtTheEndOfCoordinatesIsRefused)
{
    const auto grid = named<FloatGrid>("far", 1.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->tree().setValueOn(Coord(0, std::numeric_limits<int>::max() - 100, 0), -1.0f);
    EXPECT_TRUE(mentions(whyNot(*grid, covering({}, Coverage::Cubes)), "too near the end"));
    EXPECT_TRUE(mentions(whyNot(*grid, covering({}, Coverage::Cubes)), "'far'"));
}

// ---- Means, compared exactly

using detail::MeanOrder;
using detail::orderOfMean;

constexpr double kHuge = std::numeric_limits<double>::max();
constexpr double kTiny = std::numeric_limits<double>::denorm_min();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(OrderOfMean, CancellationAcrossAllOfTheRangeIsNoMatter)
{
    const std::vector<double> values = {kHuge, kTiny, -kHuge, 0};
    EXPECT_EQ(orderOfMean(values.data(), 4, 0), MeanOrder::Greater);
    EXPECT_EQ(orderOfMean(values.data(), 4, kTiny), MeanOrder::Less);
    const std::vector<double> sums = {kHuge, kHuge, kHuge, kHuge, kHuge, kHuge, kHuge, kHuge};
    EXPECT_EQ(orderOfMean(sums.data(), 8, kHuge), MeanOrder::Equal);
    EXPECT_EQ(orderOfMean(sums.data(), 8, std::nextafter(kHuge, 0)), MeanOrder::Greater);
    const std::vector<double> low = {-kHuge, -kHuge, 1, -1, -kTiny, kTiny, kHuge, kHuge};
    EXPECT_EQ(orderOfMean(low.data(), 8, 0), MeanOrder::Equal);
    EXPECT_EQ(orderOfMean(low.data(), 8, kTiny), MeanOrder::Less);
    EXPECT_EQ(orderOfMean(low.data(), 8, -kTiny), MeanOrder::Greater);
}

TEST(OrderOfMean, TheLastBitOfFloatsCounts)
{
    const float a = std::nextafter(0.1f, 1.0f);
    const std::vector<float> values = {0.1f, 0.1f, 0.1f, a};
    EXPECT_EQ(orderOfMean(values.data(), 4, double(0.1f)), MeanOrder::Greater);
    EXPECT_EQ(orderOfMean(values.data(), 2, double(0.1f)), MeanOrder::Equal);
    EXPECT_EQ(orderOfMean(values.data() + 2, 2, double(a)), MeanOrder::Less);
    const std::vector<float> apart = {1e30f, 1e-30f, -1e30f, -1e-30f};
    EXPECT_EQ(orderOfMean(apart.data(), 4, 0), MeanOrder::Equal);
    EXPECT_EQ(orderOfMean(apart.data(), 4, 1e-300), MeanOrder::Less);
    const std::vector<float> nearly = {1e30f, 1e-30f, -1e30f, 0};
    EXPECT_EQ(orderOfMean(nearly.data(), 4, 0), MeanOrder::Greater);
}

/// Values that are whole multiples of 2^-60 and large ones, against 128 bits.
TEST(OrderOfMean, AgreesWithWholeNumbersOnRandomDoubles)
{
    std::mt19937_64 random(3);
    int equal = 0;
    for (int n = 0; n < 20000; ++n) {
        const int count = 1 << random() % 4;
        std::vector<double> values;
        __int128 sum = 0;
        for (int i = 0; i < count; ++i) {
            const __int128 large =
                __int128(int64_t(random()) >> 12) * (__int128(1) << random() % 60);
            const __int128 small = int64_t(random()) >> (12 + random() % 52);
            const __int128 number = random() % 2 ? large : small;
            sum += i + 1 == count && random() % 2 ? -sum : number;
            values.push_back(std::ldexp(double(number), -60));
            if (i + 1 == count) { // what is left over, if a double holds it
                __int128 others = 0;
                for (int k = 0; k < i; ++k) others += __int128(std::ldexp(values[k], 60));
                if (double(sum - others) != values[i]) {
                    const double last = double(sum - others);
                    values[i] = std::ldexp(last, -60);
                    sum = others + __int128(last);
                }
            }
        }
        const double bound = random() % 2 ? 0 : std::ldexp(double(int64_t(random() % 9) - 4), -60);
        const __int128 most = __int128(std::ldexp(bound, 60)) * count;
        const MeanOrder expected = sum < most ? MeanOrder::Less
            : sum > most                      ? MeanOrder::Greater
                                              : MeanOrder::Equal;
        ASSERT_EQ(orderOfMean(values.data(), count, bound), expected) << n;
        equal += expected == MeanOrder::Equal;
    }
    EXPECT_GT(equal, 1000);
}

TEST(OrderOfMean, IntegersOf64BitsAreNotRounded)
{
    const int64_t most = std::numeric_limits<int64_t>::max();
    const std::vector<int64_t> values = {most, most, most, most - 1};
    EXPECT_EQ(orderOfMean(values.data(), 2, ValueBound::of(most)), MeanOrder::Equal);
    EXPECT_EQ(orderOfMean(values.data(), 4, ValueBound::of(most)), MeanOrder::Less);
    EXPECT_EQ(orderOfMean(values.data(), 4, ValueBound::of(most - 1)), MeanOrder::Greater);
    EXPECT_EQ(orderOfMean(values.data(), 4, 0x1p63), MeanOrder::Less);
    EXPECT_EQ(orderOfMean(values.data(), 4, kHuge), MeanOrder::Less);
    EXPECT_EQ(orderOfMean(values.data(), 4, -kHuge), MeanOrder::Greater);
    const std::vector<int64_t> small = {1, 2};
    EXPECT_EQ(orderOfMean(small.data(), 2, 1.5), MeanOrder::Equal);
    EXPECT_EQ(orderOfMean(small.data(), 2, 1.4999), MeanOrder::Greater);
    EXPECT_EQ(orderOfMean(small.data(), 2, 1.7), MeanOrder::Less);
    EXPECT_EQ(orderOfMean(small.data(), 2, -1.7), MeanOrder::Greater);
}

TEST(OrderOfMean, NanIsNowhereAndInfinitiesOfBothSignsAreNone)
{
    const std::vector<float> values = {
        1, std::numeric_limits<float>::quiet_NaN(), -float(kInfinity), 1, float(kInfinity), 1};
    EXPECT_EQ(orderOfMean(values.data(), 2, 0), MeanOrder::None);
    EXPECT_EQ(orderOfMean(values.data() + 2, 2, 0), MeanOrder::Less);
    EXPECT_EQ(orderOfMean(values.data() + 4, 2, kHuge), MeanOrder::Greater);
    EXPECT_EQ(orderOfMean(values.data() + 2, 4, 0), MeanOrder::None) << "-inf, 1, inf, 1";
}

TEST(TrilinearCover, ANanIsOutsideAndSoIsWhatItTakesPartIn)
{
    const auto grid = named<FloatGrid>("holes", 1.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->tree().fill(CoordBBox(Coord(0), Coord(4)), -1.5f);
    grid->tree().setValue(Coord(2), std::numeric_limits<float>::quiet_NaN());
    EXPECT_FALSE(objectVoxels(*grid, covering({}, Coverage::Cubes)).count(Coord(2)));
    EXPECT_EQ(objectVoxels(*grid, covering({}, Coverage::Cubes)).size(), 124u + 6 * 25);
    // The 26 voxels that are not at the border are all beside it; of those that are, nine a face have
    // no edge or corner of the solid in their cube.
    EXPECT_EQ(objectVoxels(*grid, covering({}, Coverage::Whole)).size(), 6u * 9);
}

} // namespace
