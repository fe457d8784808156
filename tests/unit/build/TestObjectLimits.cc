// SPDX-License-Identifier: Apache-2.0
/// @file TestObjectLimits.cc
/// @brief Objects near the ends of 32-bit coordinates: refused with a sentence, or right.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/measure/LevelErrors.h>

#include "support/BuiltTrees.h"
#include "support/Messages.h"

#include <openvdb/openvdb.h>

#include <optional>
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

constexpr int kSide = 8;

/// A cube of 8^3 voxels that lies @a apart voxels from the first or last coordinate of an axis.
struct CubeAtEnd {
    int axis;
    bool isLow;
    int64_t apart;

    openvdb::BoolGrid::Ptr grid() const
    {
        const int64_t from =
            isLow ? int64_t(INT32_MIN) + apart : int64_t(INT32_MAX) - apart - (kSide - 1);
        Coord corner(0, 0, 0);
        corner[axis] = int32_t(from);
        auto result = openvdb::BoolGrid::create();
        result->setName("cube");
        for (int x = 0; x < kSide; ++x) { // a loop over a box would step beyond the last coordinate
            for (int y = 0; y < kSide; ++y) {
                for (int z = 0; z < kSide; ++z) {
                    result->tree().setValueOn(corner.offsetBy(x, y, z), true);
                }
            }
        }
        return result;
    }
    std::string text() const
    {
        return std::to_string(apart) + " from the " + (isLow ? "first" : "last")
            + " coordinate along " + "xyz"[axis];
    }
};

std::vector<CubeAtEnd> cubesAtEnds(const std::vector<int64_t>& distances)
{
    std::vector<CubeAtEnd> cubes;
    for (const int64_t apart : distances) {
        for (int axis = 0; axis < 3; ++axis) {
            cubes.push_back({axis, true, apart});
            cubes.push_back({axis, false, apart});
        }
    }
    return cubes;
}

SphereTreeSettings tight(Quality quality, Cover cover = Cover::Voxels)
{
    SphereTreeSettings settings;
    TightOptions options;
    options.quality = quality;
    options.cover = cover;
    if (quality == Quality::Best) options.budget.spheres = {4};
    settings.kind = options;
    return settings;
}

template <typename Options>
SphereTreeSettings paper(int factor, const Distance& distance = {})
{
    SphereTreeSettings settings;
    Options options;
    options.factor = factor;
    options.dist = distance;
    settings.kind = options;
    return settings;
}

std::vector<SphereTreeSettings> everyKind()
{
    SphereTreeSettings inner;
    inner.kind = InnerOptions();
    return {tight(Quality::Fast), tight(Quality::Normal), tight(Quality::Best),
        tight(Quality::Fast, Cover::Balls), paper<ExtendedOptions>(2), paper<ExtendedOptions>(8),
        paper<ReversibleOptions>(2), paper<ReversibleOptions>(3, Distance::chamfer(3, 4, 5)),
        paper<ExtendedOptions>(2, Distance::l1()), inner};
}

/// @return why no tree is built; nothing if one is, which then is checked.
std::optional<std::string> refusal(
    const openvdb::BoolGrid& grid, const SphereTreeSettings& settings)
{
    SphereTree tree;
    try {
        tree = buildSphereTree(grid, settings);
    } catch (const openvdb::ValueError& error) {
        return error.what();
    }
    computeLevelErrors(tree, grid);
    for (const SphereTreeLevel& level : tree.levels) EXPECT_TRUE(level.error.has_value());
    for (const TreeFault& fault : checkSphereTree(tree, grid)) ADD_FAILURE() << fault.sentence;
    return std::nullopt;
}

void expectRefused(const CubeAtEnd& cube, const std::string& message)
{
    EXPECT_TRUE(mentions(message, "'cube'"));
    EXPECT_TRUE(mentions(
        message, std::to_string(cube.grid()->evalActiveVoxelBoundingBox().min()[cube.axis])));
    EXPECT_TRUE(mentions(message,
        std::string("too near the ") + (cube.isLow ? "first" : "last") + " coordinate along "
            + "xyz"[cube.axis]));
    EXPECT_TRUE(mentions(message, "move it towards voxel"));
}

TEST(ObjectLimits, ACubeNearTheEndsOfCoordinatesIsRefusedByEveryKindOfTree)
{
    for (const SphereTreeSettings& settings : everyKind()) {
        for (const CubeAtEnd& cube : cubesAtEnds({0, 1, 2, 4, 8, 16, 1 << 8, 1 << 12, 1 << 16})) {
            SCOPED_TRACE(cube.text() + " " + toString(settings.type()));
            const auto why = refusal(*cube.grid(), settings);
            ASSERT_TRUE(why.has_value());
            ASSERT_NO_FATAL_FAILURE(expectRefused(cube, *why));
        }
    }
}

TEST(ObjectLimits, ACubeFartherFromTheEndsIsRightInEveryKindOfTree)
{
    for (const SphereTreeSettings& settings : everyKind()) {
        for (const CubeAtEnd& cube : cubesAtEnds({1 << 17, 1 << 28})) {
            SCOPED_TRACE(cube.text() + " " + toString(settings.type()));
            const auto why = refusal(*cube.grid(), settings);
            EXPECT_FALSE(why.has_value()) << *why;
        }
    }
}

/// Levels of few spheres are made on a coarse object, which is small, and end on this one.
TEST(ObjectLimits, TilesOfTooManyLeavesAreRefusedBeforeATightTreeIsBegun)
{
    const auto object = openvdb::BoolGrid::create();
    for (int i = 0; i < 17; ++i) object->tree().root().addTile(Coord(4096 * i, 0, 0), true, true);
    SphereTreeSettings settings;
    settings.tight().budget.spheres = {8, 1};
    const std::string message =
        messageOf<openvdb::ValueError>([&] { buildSphereTree(*object, settings); });
    EXPECT_TRUE(mentions(message, "2281701376 leaf nodes")) << message;
}

/// The sphere around a voxel of 32768 is that wide, however small the object.
TEST(ObjectLimits, TheRoomThatIsAskedForGrowsWithTheFactor)
{
    for (const CubeAtEnd& cube : cubesAtEnds({1 << 17})) {
        SCOPED_TRACE(cube.text());
        EXPECT_FALSE(refusal(*cube.grid(), paper<ExtendedOptions>(1 << 6)).has_value());
    }
    const auto grid = CubeAtEnd{1, false, 1 << 17}.grid();
    EXPECT_TRUE(refusal(*grid, paper<ExtendedOptions>(1 << 15)).has_value());
}

TEST(ObjectLimits, AnObjectThatIsTooWideAnywhereIsNotSaidToLieAtTheEnd)
{
    auto grid = openvdb::BoolGrid::create();
    grid->tree().setValueOn(Coord(0), true);
    grid->tree().setValueOn(Coord((1 << 28) - 1), true);
    const auto why = refusal(*grid, tight(Quality::Fast));
    ASSERT_TRUE(why.has_value());
    EXPECT_TRUE(mentions(*why, "too wide for tree=tight"));
}

TEST(ObjectLimits, AnObjectThatIsTooWideForTheWeightsOfANormIsRefused)
{
    auto grid = openvdb::BoolGrid::create();
    grid->setName("wide");
    grid->tree().setValueOn(Coord(0), true);
    grid->tree().setValueOn(Coord(1 << 22, 0, 0), true);
    const auto settings = [](int weight) {
        return paper<ReversibleOptions>(2, Distance::chamfer(weight, weight, weight));
    };
    const std::string why =
        messageOf<openvdb::ValueError>([&] { buildSphereTree(*grid, settings(255)); });
    EXPECT_TRUE(mentions(why, "'wide' is too wide for dist="));
    EXPECT_TRUE(mentions(why, "use smaller weights, or larger voxels"));
    EXPECT_NO_THROW(buildSphereTree(*grid, settings(1)));
}

TEST(ObjectLimits, ABoxFromEndToEndIsTooWide)
{
    auto grid = openvdb::BoolGrid::create();
    grid->tree().setValueOn(Coord(INT32_MIN, 0, 0), true);
    grid->tree().setValueOn(Coord(INT32_MAX, 0, 0), true);
    const std::string why =
        messageOf<openvdb::ValueError>([&] { buildSphereTree(*grid, paper<ExtendedOptions>(2)); });
    EXPECT_TRUE(mentions(why, "4294967296 voxels wide along x"));
}

/// Whoever has a tree of an object may count errors against one at the end: nothing wraps around.
TEST(ObjectLimits, ErrorsAreCountedAtTheVeryEndsOfCoordinates)
{
    for (const CubeAtEnd& cube : cubesAtEnds({1, 2, 7})) {
        SCOPED_TRACE(cube.text());
        const auto grid = cube.grid();
        const CubeAtEnd inner{cube.axis, cube.isLow, 1 << 20};
        SphereTree tree = buildSphereTree(*inner.grid(), tight(Quality::Fast));
        const Coord shift = grid->evalActiveVoxelBoundingBox().min()
            - inner.grid()->evalActiveVoxelBoundingBox().min();
        SphereTree counted = tree;
        computeLevelErrors(counted, *inner.grid());
        for (openvdb::Vec3d& center : tree.spheres.center) center += shift.asVec3d();
        computeLevelErrors(tree, *grid);
        ASSERT_TRUE(tree.levels.front().error && counted.levels.front().error);
        EXPECT_EQ(tree.levels.front().error->covered, counted.levels.front().error->covered);
        EXPECT_EQ(tree.levels.front().error->missing, 0);
    }
}

} // namespace
