// SPDX-License-Identifier: Apache-2.0
/// @file TestOrPyramid.cc
/// @brief The OR pyramid against sets of coordinates, its sparseness, and what it refuses.

#include "support/CoreStages.h"
#include "support/Messages.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>

#include <openvdb/tools/Morphology.h>

#include <string>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Index64;
using openvdb::MaskTree;
using openvdb::ValueError;

testing::AssertionResult agree(
    const std::vector<std::set<Coord>>& expected, const OrPyramid& pyramid)
{
    if (pyramid.levels.size() != expected.size()) {
        return testing::AssertionFailure()
            << pyramid.levels.size() << " levels, should be " << expected.size();
    }
    for (std::size_t k = 0; k < expected.size(); ++k) {
        if (voxelsOf(*pyramid.levels[k]) == Voxels(expected[k].begin(), expected[k].end()))
            continue;
        return testing::AssertionFailure()
            << "level " << k << " has " << pyramid.levels[k]->activeVoxelCount()
            << " voxels, should have " << expected[k].size() << " or others";
    }
    return testing::AssertionSuccess();
}

/// Leaves whose 512 voxels are all on.
int fullLeaves(const MaskTree& tree)
{
    int count = 0;
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) count += leaf->isDense();
    return count;
}

/// A cube of 4096^3 voxels as one tile, without any voxel stored.
openvdb::BoolGrid::Ptr hugeTile(const Coord& origin)
{
    auto grid = openvdb::BoolGrid::create(false);
    grid->tree().addTile(3, origin, true, true);
    return grid;
}

std::string refusal(const openvdb::BoolGrid& object)
{
    try {
        buildOrPyramid(object);
    } catch (const ValueError& error) {
        return error.what();
    }
    return "";
}

TEST(OrPyramid, MatchesSetsOfCoordinatesForManyFactorsAndBothDimensions)
{
    for (uint32_t seed = 0; seed < 330; ++seed) {
        const RandomObject object = randomObject(seed);
        const int factor = std::array<int, 5>{2, 2, 3, 5, 8}[seed / 11 % 5];
        const auto mask = maskOf(object.voxels);
        if (seed % 2) mask->prune();
        ASSERT_TRUE(
            agree(naiveOrPyramid(object.voxels, factor), buildOrPyramid(*gridOf(*mask), factor)))
            << object.name << ", factor " << factor;

        Voxels flat = object.voxels;
        for (Coord& voxel : flat) voxel[2] = object.voxels[0][2];
        sortVoxels(flat);
        ASSERT_TRUE(
            agree(naiveOrPyramid(flat, factor, 2), buildOrPyramid(*gridOf(flat), factor, 2)))
            << object.name << " flattened, factor " << factor;
    }
}

TEST(OrPyramid, MatchesSetsOfCoordinatesOnEveryMaskOf2x2x3AcrossALeafCorner)
{
    const Voxels cells = voxelsOfBox(CoordBBox(Coord(7, -1, 6), Coord(8, 0, 8)));
    for (uint32_t mask = 1; mask < 1 << 12; ++mask) {
        Voxels voxels;
        for (uint32_t bit = 0; bit < 12; ++bit) {
            if (mask >> bit & 1) voxels.push_back(cells[bit]);
        }
        ASSERT_TRUE(agree(naiveOrPyramid(voxels, 2), buildOrPyramid(*gridOf(voxels)))) << mask;
    }
}

TEST(OrPyramid, ASingleVoxelIsTheOnlyLevel)
{
    const OrPyramid pyramid = buildOrPyramid(*gridOf(Voxels{Coord(-1, 7, 4096)}));
    ASSERT_EQ(pyramid.levels.size(), 1u);
    EXPECT_EQ(pyramid.origin, Coord(-8, 0, 4096));
    EXPECT_EQ(voxelsOf(*pyramid.levels[0]), (Voxels{Coord(-1, 7, 4096)}));
}

TEST(OrPyramid, EndsAtOneVoxelWhenTheObjectStraddlesTheOrigin)
{
    for (int factor : {2, 3, 5}) {
        const OrPyramid pyramid = buildOrPyramid(*gridOf(shapes::ball(50)), factor);
        EXPECT_EQ(pyramid.levels.back()->activeVoxelCount(), 1u);
        EXPECT_LE(pyramid.levels.size(), 5u);
    }
}

TEST(OrPyramid, TheOriginIsTheBoxMinimumRoundedDownToALeaf)
{
    EXPECT_EQ(pyramidOrigin(CoordBBox(Coord(0, 7, 8), Coord(9, 9, 9))), Coord(0, 0, 8));
    EXPECT_EQ(pyramidOrigin(CoordBBox(Coord(-1, -8, -9), Coord(9, 9, 9))), Coord(-8, -8, -16));
}

TEST(OrPyramid, ParentsAreRoundedDownAlsoBelowZero)
{
    const PyramidStep step{Coord(-8, 0, 8), 3, 3};
    EXPECT_EQ(step.parentVoxel(Coord(-8, 0, 8)), Coord(0, 0, 0));
    EXPECT_EQ(step.parentVoxel(Coord(-9, -1, 7)), Coord(-1, -1, -1));
    EXPECT_EQ(step.parentVoxel(Coord(-11, -3, 5)), Coord(-1, -1, -1));
    EXPECT_EQ(step.parentVoxel(Coord(-12, -4, 4)), Coord(-2, -2, -2));
    EXPECT_EQ(step.parentVoxel(Coord(-5, 3, 11)), Coord(1, 1, 1));
    const PyramidStep flat{Coord(-8, 0, 8), 2, 2};
    EXPECT_EQ(flat.parentVoxel(Coord(-9, 5, 11)), Coord(-1, 2, 3));
}

TEST(OrPyramid, CoarsenWorksFromAnyOriginAndBelowZero)
{
    for (const Coord& origin :
        {Coord(0, 0, 0), Coord(64, -8, 8), Coord(3, 1, -5), Coord(1024, 8, 0)}) {
        for (int factor : {2, 3}) {
            const PyramidStep step{origin, factor, 3};
            for (uint32_t seed = 0; seed < 22; ++seed) {
                const RandomObject object = randomObject(seed);
                std::set<Coord> expected;
                for (const Coord& voxel : object.voxels) expected.insert(step.parentVoxel(voxel));
                ASSERT_EQ(voxelsOf(*coarsen(*maskOf(object.voxels), step)),
                    Voxels(expected.begin(), expected.end()))
                    << object.name << ", origin " << origin;
            }
        }
    }
}

TEST(OrPyramid, TilesGiveTheLevelsOfTheirVoxels)
{
    struct {
        int size;
        openvdb::Index level;
    } const tiles[] = {{8, 1}, {128, 2}};
    for (const auto& tile : tiles) {
        for (int factor : {2, 3}) {
            auto asTile = openvdb::BoolGrid::create(false);
            asTile->tree().addTile(tile.level, Coord(-tile.size, 0, tile.size), true, true);
            asTile->tree().setValueOn(
                Coord(-tile.size - 9, -5, 0)); // the origin then cuts the tile
            auto asVoxels = asTile->deepCopy();
            asVoxels->tree().voxelizeActiveTiles(false);
            const OrPyramid a = buildOrPyramid(*asTile, factor),
                            b = buildOrPyramid(*asVoxels, factor);
            ASSERT_EQ(a.levels.size(), b.levels.size());
            for (std::size_t k = 0; k < a.levels.size(); ++k) {
                ASSERT_EQ(voxelsOf(*a.levels[k]), voxelsOf(*b.levels[k]))
                    << tile.size << ", level " << k;
            }
        }
    }
}

TEST(OrPyramid, EachTileOfACubeOfEightBecomesItsOwnEighth)
{
    for (int subset = 1; subset < 256; ++subset) {
        MaskTree tree(false);
        int tiles = 0;
        const auto corner = [](int i, int size) {
            return Coord(((i >> 2) - 2) * size, (i >> 1 & 1) * size, ((i & 1) + 2) * size);
        };
        for (int i = 0; i < 8; ++i) {
            if (!(subset >> i & 1)) continue;
            tree.addTile(2, corner(i, 128), true, true); // 128^3
            ++tiles;
        }
        const auto level = coarsen(tree, PyramidStep{Coord(0, 0, 0), 2, 3});
        ASSERT_EQ(level->activeVoxelCount(), Index64(tiles) * 64 * 64 * 64) << subset;
        for (int i = 0; i < 8; ++i) {
            const bool on = subset >> i & 1;
            ASSERT_EQ(level->isValueOn(corner(i, 64)), on) << subset;
            ASSERT_EQ(level->isValueOn(corner(i, 64).offsetBy(63)), on) << subset;
        }
    }
}

TEST(OrPyramid, ATileOf4096CubedStaysSparseOnEveryLevel)
{
    const OrPyramid pyramid = buildOrPyramid(*hugeTile(Coord(-4096, 4096, 0)));
    ASSERT_EQ(pyramid.levels.size(), 13u);
    for (std::size_t k = 0; k < pyramid.levels.size(); ++k) {
        const MaskTree& level = *pyramid.levels[k];
        const Index64 side = Index64(4096) >> k;
        EXPECT_EQ(level.activeVoxelCount(), side * side * side) << "level " << k;
        EXPECT_LE(level.leafCount(), 1u) << "level " << k;
        EXPECT_LE(level.activeTileCount(), 4096u) << "level " << k;
    }
}

TEST(OrPyramid, ATileThatTheOriginCutsIsFilledOutOnlyAtItsFaces)
{
    const auto object = hugeTile(Coord(0, 0, 0));
    object->tree().setValueOn(Coord(-1, -1, -1)); // the origin becomes (-8,-8,-8)
    const OrPyramid pyramid = buildOrPyramid(*object);
    EXPECT_EQ(pyramid.origin, Coord(-8, -8, -8));
    for (std::size_t k = 1; k < pyramid.levels.size(); ++k) {
        const Index64 leavesASide = ((Index64(4096 + 8) >> k) + 1) / 8 + 2;
        EXPECT_LE(pyramid.levels[k]->leafCount(), 6 * leavesASide * leavesASide) << "level " << k;
    }
    EXPECT_EQ(pyramid.levels[1]->activeVoxelCount(), Index64(2048) * 2048 * 2048 + 1);
    EXPECT_EQ(pyramid.levels.back()->activeVoxelCount(), 1u);
}

TEST(OrPyramid, FactorThreeKeepsTheInsideOfATileAsTiles)
{
    const OrPyramid pyramid = buildOrPyramid(*hugeTile(Coord(0, 0, 0)), 3);
    EXPECT_EQ(pyramid.levels.size(), 9u); // 3^7 < 4096 <= 3^8
    Index64 side = 4096;
    for (const auto& level : pyramid.levels) {
        EXPECT_EQ(level->activeVoxelCount(), side * side * side);
        const Index64 leavesASide = side / 8 + 1;
        EXPECT_LE(level->leafCount(), 3 * leavesASide * leavesASide);
        side = (side + 2) / 3;
    }
}

TEST(OrPyramid, CoarseningLeavesNoFullLeafWhereATileWouldDo)
{
    const Coord size(40, 56, 33);
    for (const Coord& origin : {Coord(0, 0, 0), Coord(-8, 8, 16), Coord(1, 2, 3)}) {
        for (int factor : {2, 3}) {
            const CoordBBox box(origin, origin + size);
            const PyramidStep step{origin, factor, 3};
            EXPECT_EQ(fullLeaves(*coarsen(*maskOf(voxelsOfBox(box)), step)), 0) << origin << factor;
            EXPECT_EQ(fullLeaves(*coarsen(*maskOf(box), step)), 0) << origin << factor;
        }
    }
}

TEST(OrPyramid, ATileAndVoxelsThatFillALeafTogetherBecomeATile)
{
    // The pyramid's origin cuts the tile, so that a leaf of the next level is half tile, half
    // voxels.
    MaskTree tree(false);
    tree.addTile(2, Coord(128, 0, 0), true, true);
    for (const Coord& voxel : voxelsOfBox(CoordBBox(Coord(112, 0, 0), Coord(127, 31, 31)))) {
        tree.setValueOn(voxel);
    }
    const auto level = coarsen(tree, PyramidStep{Coord(8, 0, 0), 2, 3});
    EXPECT_EQ(fullLeaves(*level), 0);
    EXPECT_EQ(level->activeVoxelCount(), Index64(64) * 64 * 64 + 8 * 16 * 16);
}

TEST(OrPyramid, VoxelsFarApartMeetAtTheTop)
{
    const OrPyramid million = buildOrPyramid(*gridOf(Voxels{Coord(0, 0, 0), Coord(1000000, 0, 0)}));
    EXPECT_EQ(million.levels.size(), 21u);
    for (std::size_t k = 0; k < 20; ++k) EXPECT_EQ(million.levels[k]->activeVoxelCount(), 2u);
    const Voxels farthest{Coord(-(1 << 26), 0, 0), Coord(1 << 26, 1 << 27, -(1 << 27))};
    const OrPyramid pyramid = buildOrPyramid(*gridOf(farthest));
    EXPECT_EQ(pyramid.levels.back()->activeVoxelCount(), 1u);
    EXPECT_LE(pyramid.levels.size(), 29u);
}

TEST(OrPyramid, RefusesAnEmptyObject) { EXPECT_NE(refusal(*openvdb::BoolGrid::create()), ""); }

TEST(OrPyramid, RefusesASideOfMoreThan2To28VoxelsAndNamesIt)
{
    const int most = 1 << 28;
    for (int axis = 0; axis < 3; ++axis) {
        Coord low(0, 0, 0), high(0, 0, 0);
        low[axis] = -most / 2;
        high[axis] = most / 2 - 1;
        EXPECT_EQ(refusal(*gridOf(Voxels{low, high})), "");
        high[axis] += 1;
        const std::string message = refusal(*gridOf(Voxels{low, high}));
        EXPECT_NE(message.find("268435457"), std::string::npos) << message;
        EXPECT_NE(message.find(std::string("along ") + "xyz"[axis]), std::string::npos) << message;
    }
    const Coord lowest = Coord::min(), highest = Coord::max();
    EXPECT_THROW(pyramidOrigin(CoordBBox(lowest, highest)), ValueError);
}

/// OR, then everything within a step of it inside its own box.
MaskTree::Ptr dilatedOr(const MaskTree& level, const PyramidStep& step)
{
    MaskTree::Ptr next = coarsen(level, step);
    CoordBBox box;
    next->evalActiveVoxelBoundingBox(box);
    openvdb::tools::dilateActiveValues(*next, 1, openvdb::tools::NN_FACE_EDGE_VERTEX);
    MaskTree clip(false);
    clip.sparseFill(box, true);
    next->topologyIntersection(clip);
    return next;
}

TEST(OrPyramid, AnIncludingModelMayAddVoxels)
{
    const Voxels object{Coord(0, 0, 0), Coord(30, 30, 30), Coord(15, 2, 9)};
    const OrPyramid plain = buildOrPyramid(*gridOf(object));
    const OrPyramid dilated = buildOrPyramid(*gridOf(object), 2, 3, dilatedOr);
    ASSERT_EQ(plain.levels.size(), dilated.levels.size());
    EXPECT_GT(dilated.levels[1]->activeVoxelCount(), plain.levels[1]->activeVoxelCount());
    for (std::size_t k = 0; k < plain.levels.size(); ++k) {
        for (const Coord& voxel : voxelsOf(*plain.levels[k])) {
            EXPECT_TRUE(dilated.levels[k]->isValueOn(voxel)) << "level " << k;
        }
    }
}

TEST(OrPyramid, AnIncludingModelMayTakeMoreLevelsThanTheWidestObjectButNotForever)
{
    const auto object = gridOf(Voxels{Coord(0, 0, 0), Coord(1, 0, 0)});
    for (int levels : {28, 36, 1000}) {
        int level = 0;
        const auto model = [&](const MaskTree& finer, const PyramidStep& step) {
            const MaskTree::Ptr next = coarsen(finer, step);
            if (++level < levels) next->setValueOn(Coord(1, 0, 0));
            return next;
        };
        const auto build = [&] { return buildOrPyramid(*object, 2, 3, model); };
        if (levels < 1000) {
            EXPECT_EQ(build().levels.size(), std::size_t(levels + 1));
        } else EXPECT_THROW(build(), ValueError);
    }
}

TEST(OrPyramid, AModelThatIsTheOrModelGivesTheSame)
{
    const auto object = gridOf(randomObject(8).voxels);
    const auto model = [](const MaskTree& level, const PyramidStep& step) {
        return coarsen(level, step);
    };
    for (int factor : {2, 3}) {
        const OrPyramid plain = buildOrPyramid(*object, factor);
        const OrPyramid modelled = buildOrPyramid(*object, factor, 3, model);
        ASSERT_EQ(plain.levels.size(), modelled.levels.size());
        for (std::size_t k = 0; k < plain.levels.size(); ++k) {
            EXPECT_EQ(voxelsOf(*plain.levels[k]), voxelsOf(*modelled.levels[k]));
        }
    }
}

TEST(OrPyramid, AModelThatLosesAVoxelOnAnyLevelIsRefused)
{
    const auto object = gridOf(shapes::ball(60));
    for (int bad = 0; bad < 3; ++bad) {
        int level = 0;
        const auto model = [&](const MaskTree& finer, const PyramidStep& step) {
            MaskTree::Ptr next = coarsen(finer, step);
            if (level++ == bad) next->setValueOff(voxelsOf(*next).front());
            return next;
        };
        EXPECT_THROW(buildOrPyramid(*object, 2, 3, model), ValueError) << bad;
    }
    const auto nothing = [](const MaskTree&, const PyramidStep&) {
        return std::make_shared<MaskTree>(false);
    };
    EXPECT_THROW(buildOrPyramid(*object, 2, 3, nothing), ValueError);
}

TEST(OrPyramid, StopsWhenInterrupted)
{
    const auto object = gridOf(shapes::ball(200));
    for (int factor : {2, 3}) {
        StopAfter interrupter;
        EXPECT_THROW(buildOrPyramid(*object, factor, 3, {}, &interrupter), Interrupted);
        StopAfter later(2);
        EXPECT_THROW(buildOrPyramid(*object, factor, 3, {}, &later), Interrupted);
        StopAfter never(1 << 30);
        EXPECT_NO_THROW(buildOrPyramid(*object, factor, 3, {}, &never));
    }
}

TEST(OrPyramid, AnEndlessPyramidIsAnErrorRatherThanALoop)
{
    const auto object = gridOf(*maskOf(CoordBBox(Coord(0), Coord(20))));
    const std::string why = messageOf<ValueError>([&] { buildOrPyramid(*object, 1); });
    EXPECT_TRUE(mentions(why, "factor=1 is out of range: it must be 2 to 32768"));
    EXPECT_THROW(buildOrPyramid(*object, 2, 2), openvdb::ValueError); // 21 voxels thick along z
}

} // namespace
