// SPDX-License-Identifier: Apache-2.0
/// @file TestTightTrees.cc
/// @brief What holds for every tight tree, whatever it is asked for: chains of spheres by brute force, the
/// check, counts, cuts.

#include "support/CheckedTrees.h"
#include "support/ChosenObjects.h"
#include "support/TightObjects.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/measure/LevelErrors.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// @param stride  every so many of the variants for an object, others for the next one
void expectAllSound(Quality quality, std::size_t stride)
{
    std::size_t turn = 0;
    for (const RandomObject& object : smallObjects()) {
        const auto grid = gridOf(object.voxels);
        ++turn;
        const auto variants = tightVariants(quality);
        for (std::size_t i = turn % stride; i < variants.size(); i += stride) {
            SCOPED_TRACE(object.name + ": " + describeTight(variants[i]));
            const SphereTree tree = buildSphereTree(*grid, variants[i]);
            ASSERT_NO_FATAL_FAILURE(expectSound(tree, *grid, object.voxels));
            ASSERT_EQ(tree.cuts.empty(), !variants[i].tight().cuts);
            if (variants[i].tight().cuts) {
                ASSERT_NO_FATAL_FAILURE(expectCutsHold(tree, object.voxels));
            }
        }
    }
}

TEST(TightTrees, OfQualityFastKeepTheirChains) { expectAllSound(Quality::Fast, 3); }

TEST(TightTrees, OfQualityNormalKeepTheirChains) { expectAllSound(Quality::Normal, 3); }

TEST(TightTrees, OfQualityBestKeepTheirChains) { expectAllSound(Quality::Best, 5); }

/// Levels above and below the one that is searched by itself, and groups of groups.
TEST(TightTrees, OfQualityBestKeepTheirChainsFromTheMiddleOut)
{
    const auto objects = chosenObjects(2100, 2133, 9, [](uint32_t, const RandomObject& object) {
        return object.voxels.size() >= 40 && object.voxels.size() <= 150;
    });
    bool odd = false;
    for (const RandomObject& object : objects) {
        SphereTreeSettings settings = tightSettings(Quality::Best);
        settings.budgeted().budget.spheres =
            odd ? std::vector<int64_t>{13, 8, 5, 3, 1} : std::vector<int64_t>{9, 4, 1};
        odd = !odd;
        SCOPED_TRACE(object.name + ": " + describeTight(settings));
        const auto grid = gridOf(object.voxels);
        ASSERT_NO_FATAL_FAILURE(
            expectSound(buildSphereTree(*grid, settings), *grid, object.voxels));
    }
}

TEST(TightTrees, OfRandomObjectsKeepTheirChains)
{
    for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
        const bool best = quality == Quality::Best; // which takes long
        const auto objects = objectsOfAtMost(best ? 120 : 400, 2000, 2066, best ? 12 : 35);
        for (std::size_t i = std::size_t(quality) % 2; i < objects.size(); i += 2) {
            SphereTreeSettings settings = tightSettings(quality);
            settings.tight().cover = i % 5 ? Cover::Voxels : Cover::Balls;
            settings.budgeted().budget.spheres = {1, 5};
            settings.budgeted().budget.branching = 0;
            SCOPED_TRACE(objects[i].name + ": " + describeTight(settings));
            const auto grid = gridOf(objects[i].voxels);
            ASSERT_NO_FATAL_FAILURE(
                expectSound(buildSphereTree(*grid, settings), *grid, objects[i].voxels));
        }
    }
}

/// A level of fewer spheres is a copy of a coarser one, than which it would have been worse.
TEST(TightTrees, HaveTheCountsAskedForAndErrorsThatFall)
{
    int searched = 0;
    for (const RandomObject& object : smallObjects()) {
        const auto grid = gridOf(object.voxels);
        for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
            if (quality == Quality::Best && object.voxels.size() > 70) continue; // takes long
            searched += quality == Quality::Best;
            SphereTreeSettings settings = tightSettings(quality);
            settings.budgeted().budget = SphereBudget();
            settings.budgeted().budget.spheres = {2, 7, 1000000, 1, 4};
            SCOPED_TRACE(object.name + ": " + describeTight(settings));
            SphereTree tree = buildSphereTree(*grid, settings);
            computeLevelErrors(tree, *grid);
            const int32_t leaves = tree.levels[0].size();
            ASSERT_EQ(rebuilt(tree), object.voxels);
            std::vector<int64_t> counts;
            for (const int32_t n : {1000000, 7, 4, 2, 1}) counts.push_back(std::min(n, leaves));
            counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
            ASSERT_EQ(tree.levels.size(), counts.size());
            for (std::size_t k = 0; k < counts.size(); ++k) {
                const SphereTreeLevel& level = tree.levels[k];
                ASSERT_LE(level.size(), counts[k]);
                if (k + 1 == counts.size()) continue;
                const SphereTreeLevel& coarser = tree.levels[k + 1];
                ASSERT_LE(level.error->hammingPercent, coarser.error->hammingPercent);
            }
        }
    }
    EXPECT_GE(searched, 4) << "objects small enough for the best quality";
}

/// Levels of named counts are made on a coarse level of the pyramid; and a ball has few leaf balls on each.
TEST(TightTrees, MadeOnACoarseLevelKeepTheirChains)
{
    Random random(5);
    Voxels ball = shapes::ball(70 * 70);
    for (Coord& voxel : ball) voxel.offset(3, -5, 1);
    const Voxels noise = shapes::noise(Coord(48, 40, 36), 0.08, random);
    const Voxels flat = shapes::noise(Coord(200, 180, 1), 0.3, random);
    struct Case {
        const Voxels& voxels;
        int dim;
        std::vector<int64_t> spheres;
    };
    for (const Case& some : {Case{ball, 3, {1}}, Case{ball, 3, {2, 1}}, Case{noise, 3, {64, 8, 2}},
             Case{noise, 3, {100, 20}}, Case{flat, 2, {30, 7, 1}}}) {
        for (const Quality quality : {Quality::Fast, Quality::Normal}) {
            SphereTreeSettings settings = tightSettings(quality);
            settings.dim = some.dim;
            settings.budgeted().budget = SphereBudget();
            settings.budgeted().budget.spheres = some.spheres;
            const auto grid = gridOf(some.voxels);
            SphereTree tree = buildSphereTree(*grid, settings);
            EXPECT_EQ(sentencesOf(checkSphereTree(tree, *grid)), "");
            ASSERT_LE(tree.levels.size(), some.spheres.size());
            computeLevelErrors(tree, *grid);
            for (std::size_t k = 0; k < tree.levels.size(); ++k) {
                EXPECT_LE(tree.levels[k].size(), some.spheres[k]);
                EXPECT_EQ(tree.levels[k].error->missing, 0);
                const double most = &some.voxels == &ball ? 2 : 1e4;
                EXPECT_LT(tree.levels[k].error->hammingPercent, most);
            }
        }
    }
}

/// @return the voxels between two circles in the plane z = 5, some of them missing.
Voxels flatRing(int inner, int outer, Random& random)
{
    Voxels voxels;
    for (int x = -outer; x <= outer; ++x) {
        for (int y = -outer; y <= outer; ++y) {
            const int sq = x * x + y * y;
            const bool isIn = sq >= inner * inner && sq <= outer * outer;
            if (isIn && !random.chance(0.005)) voxels.emplace_back(x, y, 5);
        }
    }
    return voxels;
}

/// The coarse levels of more quality are better, and the finer ones are bound to them.
TEST(TightTrees, OfFewSpheresHaveNoMoreErrorThanWithLessQuality)
{
    Random random(6);
    struct Case {
        Voxels voxels;
        int dim;
    };
    const std::vector<Case> cases{{flatRing(9, 18, random), 2}, {flatRing(14, 21, random), 2},
        {shapes::pricked(shapes::ball(120, 40), 0.02, random), 3},
        {shapes::pricked(shapes::box(Coord(26, 9, 13)), 0.01, random), 3}};
    for (const Case& some : cases) {
        const auto grid = gridOf(some.voxels);
        for (const std::vector<int64_t>& spheres :
            {std::vector<int64_t>{20, 9, 4}, std::vector<int64_t>{8}, std::vector<int64_t>{3}}) {
            std::vector<double> before;
            for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
                SphereTreeSettings settings = tightSettings(quality);
                settings.dim = some.dim;
                settings.budgeted().budget = SphereBudget();
                settings.budgeted().budget.spheres = spheres;
                SphereTree tree = buildSphereTree(*grid, settings);
                computeLevelErrors(tree, *grid);
                ASSERT_EQ(tree.levels.size(), spheres.size());
                std::vector<double> errors;
                for (const SphereTreeLevel& level : tree.levels) {
                    errors.push_back(level.error->hammingPercent);
                }
                for (std::size_t k = 0; k < before.size(); ++k) {
                    EXPECT_LE(errors[k], before[k])
                        << describeTight(settings) << ", level " << k << ", " << some.voxels.size();
                }
                before = errors;
            }
        }
    }
}

/// Counted in space, four discs of a ring would cost less than the one that holds it.
TEST(TightTrees, OfARingInTwoDimensionsAreNotWorseThanOneDisc)
{
    Random random(7);
    const auto grid = gridOf(flatRing(16, 31, random));
    for (const Quality quality : {Quality::Fast, Quality::Normal}) {
        std::vector<double> errors;
        for (const int64_t count : {1, 3, 4, 8}) {
            SphereTreeSettings settings = tightSettings(quality);
            settings.dim = 2;
            settings.budgeted().budget = SphereBudget();
            settings.budgeted().budget.spheres = {count};
            SphereTree tree = buildSphereTree(*grid, settings);
            computeLevelErrors(tree, *grid);
            errors.push_back(tree.levels.front().error->hammingPercent);
            EXPECT_LE(errors.back(), errors.front()) << count << " spheres";
        }
    }
}

TEST(TightTrees, PrunedLeavesAreFewerThanMedialOnes)
{
    for (const RandomObject& object : smallObjects()) {
        if (object.name == "far apart") continue; // too wide for the reference
        SphereTreeSettings settings = tightSettings(Quality::Fast);
        const SphereTree pruned = buildSphereTree(*gridOf(object.voxels), settings);
        settings.tight().leaves = Leaves::Medial;
        const SphereTree medial = buildSphereTree(*gridOf(object.voxels), settings);
        EXPECT_LE(pruned.levels[0].size(), medial.levels[0].size());
        EXPECT_EQ(medial.levels[0].size(), int32_t(NaiveReference(object.voxels).balls().size()));
    }
}

} // namespace
