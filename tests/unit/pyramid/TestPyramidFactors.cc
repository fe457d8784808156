// SPDX-License-Identifier: Apache-2.0
/// @file TestPyramidFactors.cc
/// @brief One step of the OR model for many factors, in two and three dimensions, from any origin,
/// against sets of coordinates; and its tiles.

#include "support/CoreStages.h"
#include "support/RandomObjects.h"
#include "support/Sanitizers.h"

#include <openvdb_spheretree/pyramid/OrPyramid.h>

#include <tbb/global_control.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Index64;
using openvdb::MaskTree;

const int kFactors[] = {2, 3, 4, 5, 6, 7, 8, 9, 12, 16, 17, 32, 100, 32768};

int naiveFloorDiv(int64_t a, int64_t b)
{
    int64_t quotient = a / b;
    while (quotient * b > a) --quotient;
    return int(quotient);
}

Voxels parentsOf(const Voxels& voxels, const PyramidStep& step)
{
    Voxels parents;
    for (const Coord& voxel : voxels) {
        const Coord at = voxel - step.origin;
        const Coord parent(naiveFloorDiv(at[0], step.factor), naiveFloorDiv(at[1], step.factor),
            step.dim == 2 ? at[2] : naiveFloorDiv(at[2], step.factor));
        if (parents.empty() || parents.back() != parent) parents.push_back(parent);
    }
    sortVoxels(parents);
    return parents;
}

/// As many tiles as there can be, and no empty leaves.
bool isTidy(const MaskTree& tree)
{
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
        if (leaf->isDense() || leaf->isEmpty()) return false;
    }
    return true;
}

TEST(PyramidFactors, AStepMatchesSetsOfCoordinatesFromAnyOrigin)
{
    for (const Coord& origin : {Coord(0, 0, 0), Coord(-8, 16, -4096), Coord(64, -8, 8),
             Coord(3, 1, -5), Coord(-1, -7, 4)}) {
        for (const int factor : kFactors) {
            for (uint32_t seed = 0; seed < 11; ++seed) {
                const PyramidStep step{origin, factor, seed % 3 == 0 ? 2 : 3};
                const RandomObject object = randomObject(100 + seed);
                const auto mask = maskOf(object.voxels);
                if (seed % 2) mask->prune();
                const auto parents = coarsen(*mask, step);
                ASSERT_EQ(voxelsOf(*parents), parentsOf(object.voxels, step))
                    << object.name << ", factor " << factor << ", origin " << origin;
                ASSERT_TRUE(isTidy(*parents)) << object.name << ", factor " << factor;
            }
        }
    }
}

TEST(PyramidFactors, EveryVoxelOfALeafGoesToItsParentWhateverThePhase)
{
    const int phases =
        kSanitized ? 2 : 20; // with a sanitizer each tree takes a hundred times as long
    for (const int factor : kFactors) {
        for (int phase = 0; phase < std::min(factor, phases); ++phase) {
            const PyramidStep step{Coord(phase, -phase, 2 * phase), factor, 2 + phase % 2};
            for (const Coord& voxel : voxelsOfBox(CoordBBox(Coord(-8, 0, 8), Coord(-1, 7, 15)))) {
                ASSERT_EQ(
                    voxelsOf(*coarsen(*maskOf(Voxels{voxel}), step)), parentsOf({voxel}, step))
                    << voxel << ", factor " << factor << ", phase " << phase;
            }
        }
    }
}

TEST(PyramidFactors, PyramidsMatchSetsOfCoordinatesInBothDimensions)
{
    for (uint32_t seed = 0; seed < 132; ++seed) {
        const RandomObject object = randomObject(500 + seed);
        const int factor = kFactors[seed / 11];
        Voxels flat = object.voxels;
        for (Coord& voxel : flat) voxel[2] = object.voxels[0][2];
        sortVoxels(flat);
        for (const int dim : {2, 3}) {
            const Voxels& voxels = dim == 2 ? flat : object.voxels;
            const auto expected = naiveOrPyramid(voxels, factor, dim);
            const OrPyramid pyramid = buildOrPyramid(*gridOf(voxels), factor, dim);
            ASSERT_EQ(pyramid.levels.size(), expected.size()) << object.name << ", " << factor;
            for (std::size_t k = 0; k < expected.size(); ++k) {
                ASSERT_EQ(
                    voxelsOf(*pyramid.levels[k]), Voxels(expected[k].begin(), expected[k].end()))
                    << object.name << ", factor " << factor << ", dim " << dim << ", level " << k;
            }
        }
    }
}

TEST(PyramidFactors, TilesGiveTheParentsOfTheirVoxels)
{
    Random random(7);
    for (const int factor : kFactors) {
        for (const Coord& origin :
            {Coord(0, 0, 0), Coord(-128, 0, 128), Coord(8, -8, 64), Coord(1, 2, 3)}) {
            MaskTree tree(false);
            tree.addTile(2, Coord(0, -128, 0), true, true);
            for (int i = 0; i < 20; ++i) {
                const Coord at = random.coord(-3, 3);
                tree.addTile(1, Coord(8 * at[0], 8 * at[1], 8 * at[2] + 128), true, true);
                tree.setValueOn(random.coord(-30, 30));
            }
            MaskTree voxels(tree);
            voxels.voxelizeActiveTiles();
            const Voxels all = voxelsOf(voxels);
            for (const int dim : {2, 3}) {
                const PyramidStep step{origin, factor, dim};
                const auto a = coarsen(tree, step), b = coarsen(voxels, step);
                ASSERT_TRUE(a->hasSameTopology(*b))
                    << "factor " << factor << ", dim " << dim << ", origin " << origin;
                ASSERT_TRUE(isTidy(*a));
                ASSERT_TRUE(dim == 2 || voxelsOf(*a) == parentsOf(all, step));
            }
        }
    }
}

TEST(PyramidFactors, ALargeTileStaysTiles)
{
    for (const int factor : kFactors) {
        for (const int dim : {2, 3}) {
            MaskTree tree(false);
            tree.addTile(3, Coord(-4096, 0, 4096), true, true);
            const PyramidStep step{Coord(-4096, 0, 0), factor, dim};
            const auto parents = coarsen(tree, step);
            const CoordBBox box(
                step.parentVoxel(Coord(-4096, 0, 4096)), step.parentVoxel(Coord(-1, 4095, 8191)));
            CoordBBox found;
            parents->evalActiveVoxelBoundingBox(found);
            EXPECT_EQ(found, box) << factor;
            EXPECT_EQ(parents->activeVoxelCount(), box.volume()) << factor;
            EXPECT_TRUE(isTidy(*parents)) << factor;
            if ((factor & (factor - 1)) == 0 && factor <= 512) {
                EXPECT_EQ(parents->leafCount(), 0u) << factor;
            }
        }
    }
}

TEST(PyramidFactors, TilesThatFillACubeOfTheirSizeBecomeOneTile)
{
    for (const int factor : {2, 4, 8}) {
        MaskTree tree(false);
        tree.sparseFill(CoordBBox::createCube(Coord(0, 0, 0), 128 * factor), true);
        const auto whole = coarsen(tree, PyramidStep{Coord(), factor, 3});
        EXPECT_EQ(whole->activeTileCount(), 1u) << factor;
        EXPECT_EQ(whole->activeVoxelCount(), Index64(128) * 128 * 128) << factor;
        tree.setValueOff(Coord(1, 2, 3)); // its parent stays on, a tile does not
        EXPECT_TRUE(coarsen(tree, PyramidStep{Coord(), factor, 3})->hasSameTopology(*whole));
        tree.fill(CoordBBox::createCube(Coord(0, 0, 0), 8), false, false);
        const int side = 8 / factor;
        EXPECT_EQ(coarsen(tree, PyramidStep{Coord(), factor, 3})->activeVoxelCount(),
            Index64(128) * 128 * 128 - side * side * side);
    }
}

/// Tiles of 128 then have 8^3 parents, more than a factor would give: they overlap. Of 16^3 tiles the
/// parents are as many as the voxels of a cube of 128, which they do not fill.
TEST(PyramidFactors, TilesWithParentsInCommonFillNoCube)
{
    for (const int factor : {18, 20}) {
        MaskTree tree(false);
        tree.sparseFill(CoordBBox::createCube(Coord(0, 0, 0), 16 * 128), true);
        ASSERT_EQ(tree.activeTileCount(), 4096u);
        const auto parents = coarsen(tree, PyramidStep{Coord(), factor, 3});
        CoordBBox box;
        parents->evalActiveVoxelBoundingBox(box);
        EXPECT_EQ(box, CoordBBox::createCube(Coord(0, 0, 0), (16 * 128 - 1) / factor + 1));
        EXPECT_EQ(parents->activeVoxelCount(), box.volume()) << factor;
    }
}

TEST(PyramidFactors, AreTheSameForAnyNumberOfThreads)
{
    const RandomObject object = randomObject(3);
    Voxels voxels;
    for (int i = 0; i < 40; ++i) {
        for (const Coord& voxel : object.voxels) voxels.push_back(voxel + Coord(11 * i, -7 * i, i));
    }
    const auto grid = gridOf(voxels);
    for (const int factor : {2, 3, 4, 8}) {
        const OrPyramid expected = buildOrPyramid(*grid, factor);
        for (const int threads : {1, 2, 5}) {
            const tbb::global_control control(
                tbb::global_control::max_allowed_parallelism, std::size_t(threads));
            const OrPyramid pyramid = buildOrPyramid(*grid, factor);
            ASSERT_EQ(pyramid.levels.size(), expected.levels.size());
            for (std::size_t k = 0; k < expected.levels.size(); ++k) {
                EXPECT_TRUE(pyramid.levels[k]->hasSameTopology(*expected.levels[k]));
            }
        }
    }
}

} // namespace
