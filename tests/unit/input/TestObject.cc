// SPDX-License-Identifier: Apache-2.0
/// @file TestObject.cc
/// @brief Masks and points as objects; what is no object; what an object keeps of its grid.

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/base/EmptyObject.h>
#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/voxel/MakeGrid.h>

#include "support/Messages.h"
#include "support/ObjectGrids.h"
#include "support/PointGrids.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

ObjectSettings trueValues()
{
    ObjectSettings settings;
    settings.values = true;
    return settings;
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

class AlwaysInterrupted : public openvdb::util::NullInterrupter {
public:
    bool wasInterrupted(int = -1) override { return true; }
};

// ---- Bool and mask grids

TEST(Object, TheActiveVoxelsOfABoolGridCountWhateverTheirValue)
{
    const auto grid = named<BoolGrid>("g", false);
    grid->tree().setValueOn(Coord(0, 0, 0), true);
    grid->tree().setValueOn(Coord(-1, 5, 9), false);
    grid->tree().setValueOff(Coord(3, 3, 3), true);
    const auto object = objectOf(*grid);
    EXPECT_EQ(voxelsOf(*object), (std::set<Coord>{{0, 0, 0}, {-1, 5, 9}}));
    EXPECT_TRUE(object->tree().getValue(Coord(-1, 5, 9))) << "every object voxel has value true";
}

TEST(Object, WithValuesTheActiveVoxelsOfValueTrueCount)
{
    const auto grid = named<BoolGrid>("g", false);
    grid->tree().setValueOn(Coord(0, 0, 0), true);
    grid->tree().setValueOn(Coord(-1, 5, 9), false);
    grid->tree().setValueOff(Coord(3, 3, 3), true);
    grid->tree().addTile(1, Coord(64, 0, 0), true, true);
    grid->tree().addTile(1, Coord(72, 0, 0), false, true);
    grid->tree().addTile(1, Coord(80, 0, 0), true, false);
    const auto object = objectOf(*grid, trueValues());
    EXPECT_EQ(object->activeVoxelCount(), 513u);
    EXPECT_TRUE(object->tree().isValueOn(Coord(0, 0, 0)));
    EXPECT_TRUE(object->tree().isValueOn(Coord(71, 7, 7)));
}

TEST(Object, ABoolGridOfBackgroundTrueIsBoundedAllTheSame)
{
    const auto grid = named<BoolGrid>("g", true);
    grid->tree().setValueOn(Coord(1, 1, 1), true);
    EXPECT_EQ(objectOf(*grid)->activeVoxelCount(), 1u);
    EXPECT_EQ(objectOf(*grid, trueValues())->activeVoxelCount(), 1u);
    EXPECT_FALSE(objectOf(*grid)->background());
}

TEST(Object, TheActiveVoxelsOfAMaskGridCount)
{
    const auto grid = openvdb::MaskGrid::create();
    grid->tree().setValueOn(Coord(-8, -9, 10));
    grid->tree().addTile(2, Coord(128, 0, 0), true, true);
    const auto object = objectOf(*grid);
    EXPECT_EQ(object->activeVoxelCount(), 1u + 128 * 128 * 128);
    EXPECT_EQ(object->tree().leafCount(), 1u);
}

TEST(Object, LaterChangesOfTheSourceLeaveTheObjectAlone)
{
    const auto grid = named<BoolGrid>("g", false);
    grid->tree().setValueOn(Coord(0, 0, 0), true);
    const auto object = objectOf(*grid);
    grid->tree().setValueOn(Coord(1, 0, 0), true);
    grid->transform().preScale(3.0);
    grid->setName("other");
    EXPECT_EQ(object->activeVoxelCount(), 1u);
    EXPECT_EQ(object->voxelSize()[0], 1.0);
    EXPECT_EQ(object->getName(), "g");
}

TEST(Object, KeepsNameAndTransform)
{
    const auto transform = openvdb::math::Transform::createLinearTransform(0.25);
    transform->postRotate(0.7, openvdb::math::Y_AXIS);
    transform->postTranslate({1, 2, 3});
    const auto object = objectOf(*dotWith(transform));
    EXPECT_EQ(object->getName(), "dot");
    EXPECT_EQ(object->transform(), *transform);
    EXPECT_EQ(object->getGridClass(), openvdb::GRID_UNKNOWN);
}

TEST(Object, TilesStayTilesOnEveryNodeLevel)
{
    const auto grid = named<FloatGrid>("g", 0.0f);
    grid->tree().addTile(1, Coord(0, 0, 0), 1.0f, true);
    grid->tree().addTile(2, Coord(-128, 0, 0), 1.0f, true);
    grid->tree().addTile(3, Coord(8192, 0, 0), 1.0f, false);
    grid->tree().addTile(1, Coord(16, 0, 0), -1.0f, true);
    const auto object = objectOf(*grid);
    const int64_t lower = 128, upper = 4096;
    EXPECT_EQ(
        object->activeVoxelCount(), uint64_t(512 + lower * lower * lower + upper * upper * upper));
    EXPECT_EQ(object->tree().leafCount(), 0u);
    EXPECT_EQ(object->tree().activeTileCount(), 3u);
    EXPECT_LT(object->memUsage(), uint64_t(1) << 24);
}

// ---- Points

TEST(Object, AVoxelOfAPointGridCountsWhenItHoldsAPoint)
{
    const auto grid = pointsAt({{0.2, 0, 0}, {0.1, 0.1, 0}, {-7, 3, 100}, {7, 7, 7}});
    auto& tree = grid->tree();
    tree.setActiveState(Coord(0, 0, 3), true); // active, without a point of its own
    tree.addTile(1, Coord(64, 64, 64), 0, true);
    EXPECT_EQ(voxelsOf(*objectOf(*grid)), (std::set<Coord>{{0, 0, 0}, {-7, 3, 100}, {7, 7, 7}}));
    tree.setActiveState(Coord(0, 0, 0), false);
    EXPECT_EQ(voxelsOf(*objectOf(*grid)), (std::set<Coord>{{-7, 3, 100}, {7, 7, 7}}));
}

TEST(Object, AVoxelOfAPointIndexGridCountsWhenItHoldsAPoint)
{
    const std::vector<openvdb::Vec3d> positions{{0.2, 0, 0}, {0.1, 0.1, 0}, {-7, 3, 100}};
    const auto grid = pointIndicesOf(positions);
    EXPECT_EQ(voxelsOf(*objectOf(*grid)), (std::set<Coord>{{0, 0, 0}, {-7, 3, 100}}));
}

// ---- What is no object

TEST(Object, EveryGridTypeOfOpenVdbEitherWorksOrIsATypeError)
{
    openvdb::initialize();
    int bounded = 0;
    openvdb::GridTypes::foreach ([&](auto sample) {
        using GridT = std::decay_t<decltype(sample)>;
        const auto grid = openvdb_spheretree::detail::makeGrid<GridT>();
        grid->setName("empty");
        const bool isVector = openvdb::VecTraits<typename GridT::ValueType>::IsVec;
        EXPECT_EQ(isObjectGrid(*grid), !isVector) << grid->type();
        if (isVector) {
            const std::string why = messageOf<openvdb::TypeError>([&] { objectOf(*grid); });
            EXPECT_TRUE(mentions(why, "'empty'"));
            EXPECT_TRUE(mentions(why, grid->type()));
        } else {
            EXPECT_TRUE(mentions(whyNot(*grid), "holds no object"));
            ++bounded;
        }
    });
    EXPECT_EQ(bounded, 8);
}

TEST(Object, OnlyEmptyOnesAreRefusedAsEmpty)
{
    const auto fog = named<FloatGrid>("smoke", 0.0f);
    EXPECT_THROW(objectOf(*fog), openvdb_spheretree::EmptyObject);
    const auto unbounded = named<FloatGrid>("smoke", 1.0f);
    try {
        objectOf(*unbounded);
        FAIL() << "an object without bounds";
    } catch (const openvdb_spheretree::EmptyObject&) {
        FAIL() << "it is not empty";
    } catch (const openvdb::ValueError&) { // as it should be
    }
}

TEST(Object, AnEmptyObjectIsAnErrorThatNamesGridAndCriterion)
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

TEST(Object, LeavesWithoutObjectVoxelsAreDropped)
{
    const auto grid = named<FloatGrid>("g", 0.0f);
    grid->tree().setValueOn(Coord(0, 0, 0), 1.0f);
    grid->tree().setValueOn(Coord(100, 0, 0), -1.0f);
    grid->tree().setValueOn(Coord(9000, 0, 0), -1.0f);
    const auto object = objectOf(*grid);
    EXPECT_EQ(object->tree().leafCount(), 1u);
    EXPECT_EQ(object->tree().root().getTableSize(), 1u);
}

TEST(Object, AnInterrupterStopsTheWork)
{
    AlwaysInterrupted interrupter;
    const auto grid = dotWith(openvdb::math::Transform::createLinearTransform(1.0));
    EXPECT_THROW(objectOf(*grid, {}, &interrupter), Interrupted);
}

TEST(Object, VoxelsMustBeCubesAndTheTransformIsKept)
{
    using openvdb::math::MapBase;
    EXPECT_TRUE(
        mentions(whyNot(*dotWith(mapped(MapBase::Ptr(new openvdb::math::ScaleMap({1, 1, 2}))))),
            "resample"));
    const auto rotated = openvdb::math::Transform::createLinearTransform(2e-5);
    rotated->postRotate(0.4, openvdb::math::Z_AXIS);
    EXPECT_EQ(objectOf(*dotWith(rotated))->transform(), *rotated);
}

// ---- Files as people have them

TEST(Object, TakesTheGridsOfOtherPrograms)
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
            if (!isObjectGrid(*grid)) continue;
            any = true;
            EXPECT_GT(objectOf(*grid)->activeVoxelCount(), 0u) << name;
        }
        EXPECT_TRUE(any) << name;
    }
}

} // namespace
