// SPDX-License-Identifier: Apache-2.0
/// @file TestChainsOracle.cc
/// @brief Chains of spheres in random tight trees, sound and damaged, against their definition.

#include <openvdb_spheretree/check/ChainCheck.h>

#include "support/CheckedTrees.h"
#include "support/CoreStages.h"
#include "support/NaiveChains.h"
#include "support/TightSamples.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/check/TreeCheck.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <set>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using detail::brokenChains;
using detail::ChainForest;
using detail::ChainLoss;

/// Ids turned around, so that children come first; a section a level.
ChainForest forestOf(const SphereTree& tree)
{
    ChainForest forest;
    forest.sectionCount = int(tree.levels.size());
    for (int32_t id = tree.size() - 1; id >= 0; --id) {
        ExactSphere sphere{{0, 0, 0}, tree.spheres.coverRadiusSq[id]};
        for (int a = 0; a < 3; ++a) sphere.center[a] = int64_t(16 * tree.spheres.center[id][a]);
        forest.spheres.push_back(sphere);
        forest.parent.push_back(
            tree.spheres.parent[id] < 0 ? -1 : tree.size() - 1 - tree.spheres.parent[id]);
        forest.sections.push_back(uint64_t(1) << tree.levelOf(id));
    }
    return forest;
}

std::vector<int64_t> counts(const std::vector<ChainLoss>& losses)
{
    std::vector<int64_t> result;
    for (const ChainLoss& loss : losses) result.push_back(loss.voxels);
    return result;
}

int64_t sum(const std::vector<int64_t>& numbers)
{
    int64_t result = 0;
    for (int64_t number : numbers) result += number;
    return result;
}

/// Smaller spheres, spheres elsewhere, and children with other parents.
void damage(SphereTree& tree, Random& random)
{
    for (int i = random.between(1, 3); i > 0; --i) {
        const int32_t id = random.between(0, tree.size() - 1);
        switch (random.between(0, 2)) {
        case 0:
            tree.spheres.coverRadiusSq[id] -=
                tree.spheres.coverRadiusSq[id] / random.between(1, 20);
            break;
        case 1:
            tree.spheres.center[id] += openvdb::Vec3d(random.coord(-24, 24).asVec3d()) / 16.0;
            break;
        default: {
            const int level = tree.levelOf(id);
            if (level + 1 == int(tree.levels.size())) break;
            const SphereTreeLevel& above = tree.levels[level + 1];
            tree.spheres.parent[id] = random.between(above.begin, above.end - 1);
        }
        }
    }
}

/// Of random trees of the object; @return how many voxels were without a chain in all of them.
int64_t expectLikeDefinition(const RandomObject& object, const openvdb::BoolGrid& grid, int seed)
{
    Random random(uint32_t(1000 + seed));
    const Hierarchy hierarchy(object.voxels, random.between(1, 30), random);
    SphereTree tree = randomTightTree(grid, hierarchy, random);
    const openvdb::MaskTree mask(grid.tree(), false, openvdb::TopologyCopy());
    const auto losses = [&] {
        return counts(brokenChains(forestOf(tree), {{}, 16}, mask, nullptr));
    };
    EXPECT_EQ(sum(losses()), 0) << "of a sound tree";
    int64_t lost = 0;
    for (int i = 0; i < 6; ++i) {
        damage(tree, random);
        const auto expected =
            naiveBrokenLevels(tree, object.voxels, holdsExactly(tree.spheres, tree.subdivision));
        EXPECT_EQ(losses(), expected);
        lost += sum(expected);
    }
    return lost;
}

TEST(ChainsOracle, BrokenChainsOfLevelsMatchTheDefinition)
{
    int64_t lost = 0;
    for (int seed = 0; seed < 80; ++seed) {
        const RandomObject object = randomObject(uint32_t(seed));
        SCOPED_TRACE(object.name);
        lost += expectLikeDefinition(object, *gridOf(object.voxels), seed);
    }
    EXPECT_GT(lost, 10000) << "the damage does too little to show anything";
}

TEST(ChainsOracle, TilesAreAllOfTheirVoxels)
{
    for (int seed = 0; seed < 4; ++seed) {
        RandomObject object{
            "a block", voxelsOfBox(CoordBBox(Coord(-8, -16, 0), Coord(15, 15, 23)))};
        const auto grid = gridOf(object.voxels);
        grid->tree().prune();
        ASSERT_GT(grid->tree().activeTileCount(), 0u);
        expectLikeDefinition(object, *grid, seed);
    }
}

/// Nodes that hold all of a large tile, and one of whose leaves lacks a corner.
TEST(ChainsOracle, LargeTilesAreOnlyTakenApartWhereSpheresEnd)
{
    openvdb::MaskTree mask(false);
    mask.addTile(3, Coord(0), true, true);
    ChainForest forest;
    const int64_t middle = 16 * 4095 / 2, toCorner = 3 * middle * middle;
    forest.spheres = {{{middle, middle, middle}, 3 * (middle + 8) * (middle + 8)},
        {{middle, middle, middle}, 4 * toCorner}};
    forest.parent = {1, -1};
    forest.sections = {1, 2};
    forest.sectionCount = 2;
    EXPECT_EQ(counts(brokenChains(forest, {{}, 16}, mask, nullptr)), (std::vector<int64_t>{0, 0}));
    forest.spheres[0].radiusSq = toCorner - 1; // the eight corners are a whole number of units away
    const auto losses = brokenChains(forest, {{}, 16}, mask, nullptr);
    EXPECT_EQ(counts(losses), (std::vector<int64_t>{8, 0}));
    EXPECT_EQ(losses[0].first, Coord(0));
}

/// On a line through many leaves, of whose voxels one alone has a sphere.
TEST(ChainsOracle, TheFirstVoxelIsTheSmallestWhateverTheThreads)
{
    Voxels line;
    for (int i = -3000; i < 3000; ++i) line.push_back(Coord(i, -i, 7));
    const auto mask = maskOf(line);
    ChainForest forest;
    forest.spheres = {{{-3000 * 16, 3000 * 16, 7 * 16}, 255}};
    forest.parent = {-1};
    forest.sections = {1};
    forest.sectionCount = 1;
    for (int threads : {1, 2}) {
        tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        const auto losses = brokenChains(forest, {{}, 16}, *mask, nullptr);
        EXPECT_EQ(losses[0].first, Coord(-2999, 2999, 7));
        EXPECT_EQ(losses[0].voxels, 5999);
    }
}

TEST(ChainsOracle, StopsWhenInterrupted)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    ChainForest forest;
    forest.spheres = {{{0, 0, 0}, 0}};
    forest.parent = {-1};
    forest.sections = {1};
    forest.sectionCount = 1;
    EXPECT_THROW(brokenChains(forest, {{}, 16}, *maskOf({Coord(1)}), &stop), Interrupted);
}

TEST(ChainsOracle, NothingIsLostOfNoObject)
{
    EXPECT_EQ(counts(brokenChains({}, {}, openvdb::MaskTree(), nullptr)), std::vector<int64_t>());
}

/// Everything that the check of a whole tree says of a sound one: nothing.
TEST(ChainsOracle, TheCheckFindsNothingWrongWithSoundTrees)
{
    for (int seed = 0; seed < 60; ++seed) {
        const RandomObject object = randomObject(uint32_t(200 + seed));
        SCOPED_TRACE(object.name);
        Random random(uint32_t(2000 + seed));
        const auto grid = gridOf(object.voxels);
        grid->setTransform(
            openvdb::math::Transform::createLinearTransform(seed % 2 ? 0.1 : 1.0 / 3));
        const Hierarchy hierarchy(object.voxels, random.between(1, 30), random);
        SphereTree tree = randomTightTree(*grid, hierarchy, random);
        addRandomCuts(tree, hierarchy.levels[0], random.between(0, 3), random);
        EXPECT_EQ(sentencesOf(checkSphereTree(tree, *grid)), "");
        for (const SphereTreeLevel& level : tree.levels) {
            EXPECT_EQ(sentencesOf(checkSphereTree(keepLevel(tree, level.level), *grid)), "");
        }
        const SphereTree cut = cutTree(tree, random.between(1, 40));
        EXPECT_EQ(sentencesOf(checkSphereTree(cut, *grid)), "");
    }
}

/// Chains that the check reports broken, in exact or stored radii, are those by the definition.
TEST(ChainsOracle, TheCheckSaysWhichCutsBreakChains)
{
    int broken = 0;
    for (int seed = 0; seed < 60; ++seed) {
        const RandomObject object = randomObject(uint32_t(300 + seed));
        Random random(uint32_t(3000 + seed));
        const auto grid = gridOf(object.voxels);
        const Hierarchy hierarchy(object.voxels, random.between(2, 20), random);
        SphereTree tree = randomTightTree(*grid, hierarchy, random);
        addRandomCuts(tree, hierarchy.levels[0], random.between(0, 3), random);
        SphereCuts& cuts = tree.cuts;
        const int32_t leaves = *std::max_element(cuts.last.begin(), cuts.last.end());
        const int32_t node = random.between(0, cuts.size() - 1);
        const bool exact = seed % 2 == 0;
        if (exact) cuts.spheres.coverRadiusSq[node] /= 2;
        else cuts.spheres.radiusWorld[node] *= 0.6f;
        const std::string said = sentencesOf(checkSphereTree(tree, *grid));
        const HoldsVoxel holds =
            exact ? holdsExactly(cuts.spheres, tree.subdivision) : holdsStored(cuts.spheres, tree);
        int64_t before = 0;
        std::set<int32_t, std::greater<>> checked{leaves};
        for (int32_t spheres = 1; spheres < leaves; spheres *= 2) checked.insert(spheres);
        for (int32_t spheres : checked) {
            const int64_t lost = naiveBrokenCut(cuts, leaves, spheres, object.voxels, holds);
            const std::string sentence = "the cut of " + std::to_string(spheres)
                + " spheres breaks the chain of spheres of " + std::to_string(lost - before)
                + " voxel";
            EXPECT_EQ(said.find(sentence) != std::string::npos, lost > before)
                << object.name << ": " << sentence << "\n"
                << said;
            broken += lost > before;
            before = lost;
        }
    }
    EXPECT_GT(broken, 20) << "the damage does too little to show anything";
}

TEST(ChainsOracle, TheCheckSaysWhichLevelsBreakChainsInTheStoredRadii)
{
    int broken = 0;
    for (int seed = 0; seed < 40; ++seed) {
        const RandomObject object = randomObject(uint32_t(400 + seed));
        Random random(uint32_t(4000 + seed));
        const auto grid = gridOf(object.voxels);
        const Hierarchy hierarchy(object.voxels, random.between(2, 20), random);
        SphereTree tree = randomTightTree(*grid, hierarchy, random);
        tree.spheres.radiusWorld[random.between(0, tree.size() - 1)] *= 0.6f;
        const std::string said = sentencesOf(checkSphereTree(tree, *grid));
        EXPECT_EQ(said.find("in the exact radii"), std::string::npos) << said;
        const auto lost = naiveBrokenLevels(tree, object.voxels, holdsStored(tree.spheres, tree));
        for (std::size_t k = 0; k < lost.size(); ++k) {
            const std::string sentence = "level " + std::to_string(k)
                + " breaks the chain of spheres of " + std::to_string(lost[k]) + " voxel";
            EXPECT_EQ(said.find(sentence) != std::string::npos, lost[k] > 0)
                << object.name << ": " << sentence << "\n"
                << said;
            broken += lost[k] > 0;
        }
    }
    EXPECT_GT(broken, 20) << "the damage does too little to show anything";
}

} // namespace
