// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/input/ObjectMask.h>

#include "support/Messages.h"

#include <openvdb/points/PointConversion.h>
#include <openvdb/points/PointDataGrid.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/PointIndexGrid.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <set>
#include <vector>

using namespace openvdb_spheretree;
using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;
using openvdb::Int64Grid;
using spheretree_test::mentions;
using spheretree_test::messageOf;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

ObjectMaskSettings threshold(double value)
{
    ObjectMaskSettings settings;
    settings.threshold = value;
    return settings;
}

ObjectMaskSettings iso(double value)
{
    ObjectMaskSettings settings;
    settings.iso = value;
    return settings;
}

ObjectMaskSettings trueValues()
{
    ObjectMaskSettings settings;
    settings.values = true;
    return settings;
}

std::set<Coord> voxelsOf(const BoolGrid& grid)
{
    std::set<Coord> voxels;
    for (auto it = grid.cbeginValueOn(); it; ++it) {
        CoordBBox box;
        it.getBoundingBox(box);
        for (const Coord& ijk : box) voxels.insert(ijk);
    }
    return voxels;
}

std::string whyNot(const openvdb::GridBase& grid, const ObjectMaskSettings& settings = {})
{
    return messageOf<openvdb::ValueError>([&] { objectMask(grid, settings); });
}

template <typename GridT>
typename GridT::Ptr named(const char* name, const typename GridT::ValueType& background)
{
    const auto grid = GridT::create(background);
    grid->setName(name);
    return grid;
}

/// A BoolGrid of one voxel under the given transform.
BoolGrid::Ptr dotWith(const openvdb::math::Transform::Ptr& transform)
{
    const auto grid = named<BoolGrid>("dot", false);
    grid->tree().setValueOn(Coord(1, 2, 3), true);
    grid->setTransform(transform);
    return grid;
}

openvdb::math::Transform::Ptr mapped(const openvdb::math::MapBase::Ptr& map)
{
    return std::make_shared<openvdb::math::Transform>(map);
}

openvdb::points::PointDataGrid::Ptr pointsAt(const std::vector<openvdb::Vec3d>& positions)
{
    openvdb::initialize();
    const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
    const auto grid = openvdb::points::createPointDataGrid<openvdb::points::NullCodec,
        openvdb::points::PointDataGrid>(positions, *transform);
    grid->setName("points");
    return grid;
}

class AlwaysInterrupted : public openvdb::util::NullInterrupter {
public:
    bool wasInterrupted(int = -1) override { return true; }
};

} // namespace

// ---- Bool and mask grids

TEST(ObjectMask, TheActiveVoxelsOfABoolGridCountWhateverTheirValue)
{
    const auto grid = named<BoolGrid>("g", false);
    grid->tree().setValueOn(Coord(0, 0, 0), true);
    grid->tree().setValueOn(Coord(-1, 5, 9), false);
    grid->tree().setValueOff(Coord(3, 3, 3), true);
    const auto object = objectMask(*grid);
    EXPECT_EQ(voxelsOf(*object), (std::set<Coord>{{0, 0, 0}, {-1, 5, 9}}));
    EXPECT_TRUE(object->tree().getValue(Coord(-1, 5, 9))) << "every object voxel has value true";
}

TEST(ObjectMask, WithValuesTheActiveVoxelsOfValueTrueCount)
{
    const auto grid = named<BoolGrid>("g", false);
    grid->tree().setValueOn(Coord(0, 0, 0), true);
    grid->tree().setValueOn(Coord(-1, 5, 9), false);
    grid->tree().setValueOff(Coord(3, 3, 3), true);
    grid->tree().addTile(1, Coord(64, 0, 0), true, true);
    grid->tree().addTile(1, Coord(72, 0, 0), false, true);
    grid->tree().addTile(1, Coord(80, 0, 0), true, false);
    const auto object = objectMask(*grid, trueValues());
    EXPECT_EQ(object->activeVoxelCount(), 513u);
    EXPECT_TRUE(object->tree().isValueOn(Coord(0, 0, 0)));
    EXPECT_TRUE(object->tree().isValueOn(Coord(71, 7, 7)));
}

TEST(ObjectMask, ABoolGridOfBackgroundTrueIsBoundedAllTheSame)
{
    const auto grid = named<BoolGrid>("g", true);
    grid->tree().setValueOn(Coord(1, 1, 1), true);
    EXPECT_EQ(objectMask(*grid)->activeVoxelCount(), 1u);
    EXPECT_EQ(objectMask(*grid, trueValues())->activeVoxelCount(), 1u);
    EXPECT_FALSE(objectMask(*grid)->background());
}

TEST(ObjectMask, TheActiveVoxelsOfAMaskGridCount)
{
    const auto grid = openvdb::MaskGrid::create();
    grid->tree().setValueOn(Coord(-8, -9, 10));
    grid->tree().addTile(2, Coord(128, 0, 0), true, true);
    const auto object = objectMask(*grid);
    EXPECT_EQ(object->activeVoxelCount(), 1u + 128 * 128 * 128);
    EXPECT_EQ(object->tree().leafCount(), 1u);
}

TEST(ObjectMask, LaterChangesOfTheSourceLeaveTheObjectAlone)
{
    const auto grid = named<BoolGrid>("g", false);
    grid->tree().setValueOn(Coord(0, 0, 0), true);
    const auto object = objectMask(*grid);
    grid->tree().setValueOn(Coord(1, 0, 0), true);
    grid->transform().preScale(3.0);
    grid->setName("other");
    EXPECT_EQ(object->activeVoxelCount(), 1u);
    EXPECT_EQ(object->voxelSize()[0], 1.0);
    EXPECT_EQ(object->getName(), "g");
}

TEST(ObjectMask, KeepsNameAndTransform)
{
    const auto transform = openvdb::math::Transform::createLinearTransform(0.25);
    transform->postRotate(0.7, openvdb::math::Y_AXIS);
    transform->postTranslate({1, 2, 3});
    const auto object = objectMask(*dotWith(transform));
    EXPECT_EQ(object->getName(), "dot");
    EXPECT_EQ(object->transform(), *transform);
    EXPECT_EQ(object->getGridClass(), openvdb::GRID_UNKNOWN);
}

TEST(ObjectMask, TilesStayTilesOnEveryNodeLevel)
{
    const auto grid = named<FloatGrid>("g", 0.0f);
    grid->tree().addTile(1, Coord(0, 0, 0), 1.0f, true);
    grid->tree().addTile(2, Coord(-128, 0, 0), 1.0f, true);
    grid->tree().addTile(3, Coord(8192, 0, 0), 1.0f, false);
    grid->tree().addTile(1, Coord(16, 0, 0), -1.0f, true);
    const auto object = objectMask(*grid);
    const int64_t lower = 128, upper = 4096;
    EXPECT_EQ(
        object->activeVoxelCount(), uint64_t(512 + lower * lower * lower + upper * upper * upper));
    EXPECT_EQ(object->tree().leafCount(), 0u);
    EXPECT_EQ(object->tree().activeTileCount(), 3u);
    EXPECT_LT(object->memUsage(), uint64_t(1) << 24);
}

// ---- Scalar grids

TEST(ObjectMask, ValuesAboveTheThresholdCountAndOthersDoNot)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->setGridClass(openvdb::GRID_FOG_VOLUME);
    grid->tree().setValueOn(Coord(0, 0, 0), 0.5f);
    grid->tree().setValueOn(Coord(1, 0, 0), std::nextafter(0.5f, 1.0f));
    grid->tree().setValueOn(Coord(-2, 0, 0), 1.0f);
    grid->tree().setValueOn(Coord(-3, 0, 0), -1.0f);
    EXPECT_EQ(voxelsOf(*objectMask(*grid)), (std::set<Coord>{{0, 0, 0}, {1, 0, 0}, {-2, 0, 0}}));
    EXPECT_EQ(
        voxelsOf(*objectMask(*grid, threshold(0.5))), (std::set<Coord>{{1, 0, 0}, {-2, 0, 0}}));
}

TEST(ObjectMask, InactiveValuesAboveTheThresholdCountAsWell)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->tree().setValueOff(Coord(0, 0, 0), 1.0f);
    grid->tree().addTile(1, Coord(8, 0, 0), 1.0f, false);
    EXPECT_EQ(objectMask(*grid)->activeVoxelCount(), 513u);
}

TEST(ObjectMask, ABackgroundAboveTheThresholdIsAnUnboundedObject)
{
    const auto grid = named<FloatGrid>("fog", 0.25f);
    grid->tree().setValueOn(Coord(0, 0, 0), 1.0f);
    const std::string why = whyNot(*grid);
    EXPECT_TRUE(mentions(why, "'fog'"));
    EXPECT_TRUE(mentions(why, "0.25"));
    EXPECT_TRUE(mentions(why, "threshold=0"));
    EXPECT_EQ(objectMask(*grid, threshold(0.25))->activeVoxelCount(), 1u);
}

TEST(ObjectMask, AThresholdThatIsNoFiniteNumberIsAnError)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->tree().setValueOn(Coord(0, 0, 0), 1.0f);
    for (double value : {std::nan(""), kInfinity, -kInfinity}) {
        EXPECT_TRUE(mentions(whyNot(*grid, threshold(value)), "threshold="));
    }
}

TEST(ObjectMask, NanIsOutsideAndInfinityIsNot)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->tree().setValueOn(Coord(0, 0, 0), std::numeric_limits<float>::quiet_NaN());
    grid->tree().setValueOn(Coord(1, 0, 0), std::numeric_limits<float>::infinity());
    grid->tree().setValueOn(Coord(2, 0, 0), -std::numeric_limits<float>::infinity());
    EXPECT_EQ(voxelsOf(*objectMask(*grid)), (std::set<Coord>{{1, 0, 0}}));
}

TEST(ObjectMask, DoublesKeepTheirPrecision)
{
    const auto grid = named<openvdb::DoubleGrid>("d", 0.0);
    grid->tree().setValueOn(Coord(0, 0, 0), 1.0);
    grid->tree().setValueOn(Coord(1, 0, 0), std::nextafter(1.0, 2.0));
    EXPECT_EQ(voxelsOf(*objectMask(*grid, threshold(1.0))), (std::set<Coord>{{1, 0, 0}}));
}

TEST(ObjectMask, IntegersAreComparedWithoutRounding)
{
    const int64_t big = (int64_t(1) << 53); // the last of the integers that doubles hold
    const auto grid = named<Int64Grid>("labels", std::numeric_limits<int64_t>::lowest());
    grid->tree().setValueOn(Coord(0, 0, 0), big);
    grid->tree().setValueOn(Coord(1, 0, 0), big + 1);
    grid->tree().setValueOn(Coord(2, 0, 0), std::numeric_limits<int64_t>::max());
    grid->tree().setValueOn(Coord(3, 0, 0), -5);
    using Voxels = std::set<Coord>;
    EXPECT_EQ(voxelsOf(*objectMask(*grid, threshold(double(big)))), (Voxels{{1, 0, 0}, {2, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectMask(*grid, threshold(-5.5))),
        (Voxels{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
    EXPECT_EQ(
        voxelsOf(*objectMask(*grid, threshold(-5))), (Voxels{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectMask(*grid, threshold(-std::ldexp(1.0, 63)))).size(), 4u);
    EXPECT_TRUE(mentions(whyNot(*grid, threshold(std::ldexp(1.0, 63))), "threshold="));
    EXPECT_TRUE(mentions(whyNot(*grid, threshold(-1e30)), "no bounds"));
}

TEST(ObjectMask, TakesThresholdsBeyondTheRangeOfTheGrid)
{
    const auto grid = named<openvdb::Int32Grid>("i", 0);
    grid->tree().setValueOn(Coord(0, 0, 0), std::numeric_limits<int32_t>::max());
    EXPECT_EQ(objectMask(*grid, threshold(0.5))->activeVoxelCount(), 1u);
    EXPECT_EQ(objectMask(*grid, threshold(2147483646.5))->activeVoxelCount(), 1u);
    EXPECT_TRUE(mentions(whyNot(*grid, threshold(2147483647.0)), "no value above"));
    EXPECT_TRUE(mentions(whyNot(*grid, threshold(1e300)), "no value above"));
}

TEST(ObjectMask, AgreesWithAVoxelByVoxelScanOfARandomGrid)
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
    EXPECT_EQ(voxelsOf(*objectMask(*grid, threshold(0.2))), expected);
}

// ---- Level sets

TEST(ObjectMask, TheInteriorOfALevelSetIsWhereItsValueIsBelowTheIso)
{
    const auto grid = openvdb::tools::createLevelSetSphere<FloatGrid>(
        20.0f, openvdb::Vec3f(0.3f, -5.2f, 7.1f), 0.5f);
    for (double value : {0.0, 0.6, -0.6}) {
        const auto object = objectMask(*grid, iso(value));
        std::size_t wrong = 0;
        for (const Coord& ijk : CoordBBox(Coord(-60), Coord(60))) {
            wrong += object->tree().isValueOn(ijk) != (grid->tree().getValue(ijk) < value);
        }
        EXPECT_EQ(wrong, 0u) << "iso " << value;
    }
}

TEST(ObjectMask, AVoxelOfJustTheIsoIsOutside)
{
    const auto grid = named<FloatGrid>("set", 3.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->tree().setValueOn(Coord(0, 0, 0), 0.5f);
    grid->tree().setValueOn(Coord(1, 0, 0), std::nextafter(0.5f, 0.0f));
    EXPECT_EQ(voxelsOf(*objectMask(*grid, iso(0.5))), (std::set<Coord>{{1, 0, 0}}));

    const auto doubles = named<openvdb::DoubleGrid>("doubles", 3.0);
    doubles->setGridClass(openvdb::GRID_LEVEL_SET);
    doubles->tree().setValueOn(Coord(0, 0, 0), 0.5);
    doubles->tree().setValueOn(Coord(1, 0, 0), std::nextafter(0.5, 0.0));
    EXPECT_EQ(voxelsOf(*objectMask(*doubles, iso(0.5))), (std::set<Coord>{{1, 0, 0}}));
}

TEST(ObjectMask, ALevelSetMayBeOfIntegers)
{
    const auto grid = named<openvdb::Int32Grid>("set", 3);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    for (int x = -2; x <= 2; ++x) grid->tree().setValueOn(Coord(x, 0, 0), x);
    using Voxels = std::set<Coord>;
    EXPECT_EQ(voxelsOf(*objectMask(*grid, iso(-1))), (Voxels{{-2, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectMask(*grid, iso(-0.5))), (Voxels{{-2, 0, 0}, {-1, 0, 0}}));
    EXPECT_EQ(voxelsOf(*objectMask(*grid, iso(0.5))), (Voxels{{-2, 0, 0}, {-1, 0, 0}, {0, 0, 0}}));
}

TEST(ObjectMask, TilesCountByTheirValueOnEveryNodeLevel)
{
    for (openvdb::Index level : {1, 2, 3}) {
        const auto grid = named<FloatGrid>("tiles", 0.0f);
        const Coord inactive(0, 0, 0), active(4096, 0, 0), below(8192, 0, 0);
        grid->tree().addTile(level, inactive, 1.0f, false);
        grid->tree().addTile(level, active, 1.0f, true);
        grid->tree().addTile(level, below, -1.0f, true);
        const auto object = objectMask(*grid);
        const uint64_t side = uint64_t(level == 1 ? 8 : level == 2 ? 128 : 4096);
        EXPECT_EQ(object->activeVoxelCount(), 2 * side * side * side);
        EXPECT_TRUE(object->tree().isValueOn(inactive) && object->tree().isValueOn(active));
    }
}

TEST(ObjectMask, TheDeepInteriorOfALevelSetStaysTiles)
{
    const auto grid =
        openvdb::tools::createLevelSetSphere<FloatGrid>(100.0f, openvdb::Vec3f(0), 1.0f);
    const auto object = objectMask(*grid);
    EXPECT_GT(object->tree().activeTileCount(), 100u);
    EXPECT_LE(object->tree().leafCount(), grid->tree().leafCount());
    EXPECT_NEAR(double(object->activeVoxelCount()), 4.0 / 3 * M_PI * 1e6, 4e4);
}

TEST(ObjectMask, InteriorTilesFarFromAnyLeafCount)
{
    const auto grid = named<FloatGrid>("huge", 3.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->tree().addTile(3, Coord(0, 0, 0), -3.0f, false);
    grid->tree().addTile(1, Coord(8192, 0, 0), -3.0f, false);
    grid->tree().addTile(1, Coord(8200, 0, 0), 3.0f, false);
    const uint64_t upper = 4096;
    EXPECT_EQ(objectMask(*grid)->activeVoxelCount(), upper * upper * upper + 512);
}

TEST(ObjectMask, AnIsoBeyondTheNarrowBandIsAnErrorThatNamesTheBand)
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
    EXPECT_NO_THROW(objectMask(*grid, iso(1.49)));
    EXPECT_NO_THROW(objectMask(*grid, iso(-1.49)));
}

TEST(ObjectMask, AFogVolumeMarkedAsLevelSetIsAnErrorThatSaysSo)
{
    const auto grid = named<FloatGrid>("fog", 0.0f);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    grid->tree().setValueOn(Coord(0, 0, 0), 1.0f);
    EXPECT_TRUE(mentions(whyNot(*grid), "change the grid's class"));
}

TEST(ObjectMask, ALevelSetThatIsNotMarkedAsOneIsAnErrorThatSaysSo)
{
    const auto grid =
        openvdb::tools::createLevelSetSphere<FloatGrid>(10.0f, openvdb::Vec3f(0), 0.5f);
    grid->setGridClass(openvdb::GRID_UNKNOWN);
    EXPECT_TRUE(mentions(whyNot(*grid), "'level set'"));
}

// ---- Points

TEST(ObjectMask, AVoxelOfAPointGridCountsWhenItHoldsAPoint)
{
    const auto grid = pointsAt({{0.2, 0, 0}, {0.1, 0.1, 0}, {-7, 3, 100}, {7, 7, 7}});
    auto& tree = grid->tree();
    tree.setActiveState(Coord(0, 0, 3), true); // active, without a point of its own
    tree.addTile(1, Coord(64, 64, 64), 0, true);
    EXPECT_EQ(voxelsOf(*objectMask(*grid)), (std::set<Coord>{{0, 0, 0}, {-7, 3, 100}, {7, 7, 7}}));
    tree.setActiveState(Coord(0, 0, 0), false);
    EXPECT_EQ(voxelsOf(*objectMask(*grid)), (std::set<Coord>{{-7, 3, 100}, {7, 7, 7}}));
}

TEST(ObjectMask, AVoxelOfAPointIndexGridCountsWhenItHoldsAPoint)
{
    const std::vector<openvdb::Vec3d> positions{{0.2, 0, 0}, {0.1, 0.1, 0}, {-7, 3, 100}};
    const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
    const auto grid = openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(
        openvdb::points::PointAttributeVector<openvdb::Vec3d>(positions), *transform);
    EXPECT_EQ(voxelsOf(*objectMask(*grid)), (std::set<Coord>{{0, 0, 0}, {-7, 3, 100}}));
}

// ---- What is no object

TEST(ObjectMask, EveryGridTypeOfOpenVdbEitherWorksOrIsATypeError)
{
    openvdb::initialize();
    int bounded = 0;
    openvdb::GridTypes::foreach ([&](auto sample) {
        using GridT = std::decay_t<decltype(sample)>;
        const typename GridT::Ptr grid = GridT::create();
        grid->setName("empty");
        const bool isVector = openvdb::VecTraits<typename GridT::ValueType>::IsVec;
        EXPECT_EQ(canBeObject(*grid), !isVector) << grid->type();
        if (isVector) {
            const std::string why = messageOf<openvdb::TypeError>([&] { objectMask(*grid); });
            EXPECT_TRUE(mentions(why, "'empty'"));
            EXPECT_TRUE(mentions(why, grid->type()));
        } else {
            EXPECT_TRUE(mentions(whyNot(*grid), "holds no object"));
            ++bounded;
        }
    });
    EXPECT_EQ(bounded, 8);
}

TEST(ObjectMask, AnEmptyObjectIsAnErrorThatNamesGridAndCriterion)
{
    const auto fog = named<FloatGrid>("smoke", 0.0f);
    fog->tree().setValueOn(Coord(0, 0, 0), 0.5f);
    EXPECT_TRUE(mentions(whyNot(*fog, threshold(0.75)), "grid 'smoke'"));
    EXPECT_TRUE(mentions(whyNot(*fog, threshold(0.75)), "no value above threshold=0.75"));
    const auto level = named<FloatGrid>("ls", 3.0f);
    level->setGridClass(openvdb::GRID_LEVEL_SET);
    EXPECT_TRUE(mentions(whyNot(*level, iso(0.5)), "no value below iso=0.5"));
    const auto bits = named<BoolGrid>("", false);
    EXPECT_TRUE(mentions(whyNot(*bits), "the grid without a name"));
    EXPECT_TRUE(mentions(whyNot(*bits), "no active voxel"));
    bits->tree().setValueOn(Coord(0, 0, 0), false);
    EXPECT_TRUE(mentions(whyNot(*bits, trueValues()), "no active voxel of value true"));
    EXPECT_TRUE(mentions(whyNot(*openvdb::points::PointDataGrid::create()), "holds a point"));
}

TEST(ObjectMask, LeavesWithoutObjectVoxelsAreDropped)
{
    const auto grid = named<FloatGrid>("g", 0.0f);
    grid->tree().setValueOn(Coord(0, 0, 0), 1.0f);
    grid->tree().setValueOn(Coord(100, 0, 0), -1.0f);
    grid->tree().setValueOn(Coord(9000, 0, 0), -1.0f);
    const auto object = objectMask(*grid);
    EXPECT_EQ(object->tree().leafCount(), 1u);
    EXPECT_EQ(object->tree().root().getTableSize(), 1u);
}

TEST(ObjectMask, AnInterrupterStopsTheWork)
{
    AlwaysInterrupted interrupter;
    const auto grid = dotWith(openvdb::math::Transform::createLinearTransform(1.0));
    EXPECT_THROW(objectMask(*grid, {}, &interrupter), Interrupted);
}

TEST(ObjectMask, VoxelsMustBeCubesAndTheTransformIsKept)
{
    using openvdb::math::MapBase;
    EXPECT_TRUE(
        mentions(whyNot(*dotWith(mapped(MapBase::Ptr(new openvdb::math::ScaleMap({1, 1, 2}))))),
            "resample"));
    const auto rotated = openvdb::math::Transform::createLinearTransform(2e-5);
    rotated->postRotate(0.4, openvdb::math::Z_AXIS);
    EXPECT_EQ(objectMask(*dotWith(rotated))->transform(), *rotated);
}

// ---- Files as people have them

TEST(ObjectMask, TakesTheGridsOfOtherPrograms)
{
    const char* data = std::getenv("SPHERETREE_DATA");
    if (!data) GTEST_SKIP() << "needs SPHERETREE_DATA";
    openvdb::initialize();
    for (const char* name : {"smoke.vdb", "sphere.vdb", "points.vdb", "geb079.vdb"}) {
        openvdb::io::File file(std::string(data) + "/vdb/" + name);
        file.open();
        const openvdb::GridPtrVec grids = *file.getGrids();
        bool any = false;
        for (const openvdb::GridBase::Ptr& grid : grids) {
            if (!canBeObject(*grid)) continue;
            any = true;
            EXPECT_GT(objectMask(*grid)->activeVoxelCount(), 0u) << name;
        }
        EXPECT_TRUE(any) << name;
    }
}
