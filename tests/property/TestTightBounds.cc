// SPDX-License-Identifier: Apache-2.0
/// @file TestTightBounds.cc
/// @brief Tight trees within a bound of error or distance: the fewest spheres that are.

#include "support/CheckedTrees.h"
#include "support/Messages.h"
#include "support/TightObjects.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/measure/LevelErrors.h>

#include <openvdb/openvdb.h>

#include <optional>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

bool isWithin(const SphereTree& tree, const openvdb::BoolGrid& grid, const SphereBudget& budget)
{
    SphereTree measured = tree;
    computeLevelErrors(measured, grid);
    const LevelError& error = measured.levels[0].error.value();
    const StoredError& stored = measured.levels[0].stored.value();
    const bool padded = budget.bounds == BoundOf::Stored;
    const double percent = padded ? stored.hammingPercent : error.hammingPercent;
    const double reach = padded ? stored.reachWorld : error.hausdorff * tree.voxelSize();
    return (!budget.error || percent <= *budget.error)
        && (!budget.distance || reach <= *budget.distance);
}

SphereTreeSettings bounded(Quality quality, std::optional<double> error,
    std::optional<double> distance, BoundOf bounds = BoundOf::Unpadded)
{
    SphereTreeSettings settings = tightSettings(quality);
    settings.budgeted().budget = SphereBudget();
    settings.budgeted().budget.error = error;
    settings.budgeted().budget.distance = distance;
    settings.budgeted().budget.bounds = bounds;
    return settings;
}

/// Spheres of the trees within bounds, and of the cuts of merges alone that are within them.
struct Fewest {
    int64_t found = 0, ofCuts = 0;
};

/// @return the fewest spheres, @a least or more, of a cut within the bounds.
int32_t fewestOfCuts(const openvdb::BoolGrid& grid, SphereTreeSettings settings, int32_t least)
{
    const SphereBudget bounds = settings.budgeted().budget;
    settings.budgeted().budget = SphereBudget();
    settings.budgeted().cuts = true;
    const SphereTree all = buildSphereTree(grid, settings);
    int32_t count = std::max(1, least);
    while (count < all.levels[0].size() && !isWithin(cutTree(all, count), grid, bounds)) ++count;
    return count;
}

void expectFewest(const openvdb::BoolGrid& grid, const SphereTreeSettings& settings, Fewest& fewest)
{
    const SphereTree tree = buildSphereTree(grid, settings);
    ASSERT_EQ(tree.levels.size(), 1u);
    ASSERT_TRUE(isWithin(tree, grid, settings.budgeted().budget)) << tree.size() << " spheres";
    ASSERT_EQ(sentencesOf(checkSphereTree(tree, grid)), "");
    if (settings.tight().quality == Quality::Best) return; // has no cuts of what was searched
    fewest.found += tree.size();
    constexpr int32_t kBelow = 8;
    fewest.ofCuts += fewestOfCuts(grid, settings, tree.size() - kBelow);
}

/// Voxels of 1/2.
void expectFewestOf(const RandomObject& object, const SphereTreeSettings& settings, Fewest& fewest)
{
    const auto grid = gridOf(object.voxels);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    const SphereBudget& budget = settings.budgeted().budget;
    SCOPED_TRACE(object.name + ": " + describeTight(settings) + ", error "
        + std::to_string(budget.error.value_or(-1)) + ", distance "
        + std::to_string(budget.distance.value_or(-1)));
    ASSERT_NO_FATAL_FAILURE(expectFewest(*grid, settings, fewest));
}

TEST(TightBounds, TakeFewerSpheresThanCuts)
{
    int turn = 0;
    Fewest fewest;
    for (const RandomObject& object : smallObjects()) {
        if (object.name == "far apart") continue; // its errors take long to count
        const Quality quality = ++turn % 2 ? Quality::Fast : Quality::Normal;
        for (const double error : {0.0, 20.0, 120.0}) {
            ASSERT_NO_FATAL_FAILURE(expectFewestOf(object, bounded(quality, error, {}), fewest));
        }
        for (const double distance : {0.0, 0.5, 0.9, 2.0}) {
            ASSERT_NO_FATAL_FAILURE(expectFewestOf(object, bounded(quality, {}, distance), fewest));
        }
        ASSERT_NO_FATAL_FAILURE(expectFewestOf(object, bounded(quality, 60.0, 0.9), fewest));
    }
    EXPECT_LT(fewest.found, fewest.ofCuts);
}

/// Some of these cannot be reached, and say so.
TEST(TightBounds, OfStoredSpheresTakeFewerThanCuts)
{
    int turn = 0, reached = 0;
    Fewest fewest;
    for (const RandomObject& object : smallObjects()) {
        if (object.name == "far apart") continue;
        const Quality quality = ++turn % 2 ? Quality::Fast : Quality::Normal;
        for (const double distance : {0.2, 0.7, 0.9, 1.5}) {
            SphereTreeSettings settings = bounded(quality, {}, distance, BoundOf::Stored);
            if (turn % 3 == 0) settings.padding = 0;
            const auto grid = gridOf(object.voxels);
            grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
            SCOPED_TRACE(object.name + ", distance " + std::to_string(distance));
            try {
                ASSERT_NO_FATAL_FAILURE(expectFewest(*grid, settings, fewest));
                ++reached;
            } catch (const openvdb::ValueError& error) {
                ASSERT_NE(std::string(error.what()).find("cannot be reached: padding="),
                    std::string::npos)
                    << error.what();
            }
        }
        ASSERT_NO_FATAL_FAILURE(
            expectFewestOf(object, bounded(quality, 1500.0, {}, BoundOf::Stored), fewest));
    }
    EXPECT_LT(fewest.found, fewest.ofCuts);
    EXPECT_GT(reached, turn);
}

/// A search for less excess may reach further out.
TEST(TightBounds, StayWithinABoundWhenSearched)
{
    const RandomObject components = smallObjects()[3];
    Fewest none;
    for (const double distance : {0.5, 0.9, 1.2}) {
        ASSERT_NO_FATAL_FAILURE(
            expectFewestOf(components, bounded(Quality::Best, {}, distance), none));
    }
    ASSERT_NO_FATAL_FAILURE(expectFewestOf(components, bounded(Quality::Best, 120.0, {}), none));
}

TEST(TightBounds, WithinABoundHaveTheLadderBelow)
{
    const auto grid = gridOf(smallObjects()[3].voxels);
    SphereTreeSettings settings = bounded(Quality::Normal, 30.0, std::nullopt);
    const int32_t fewest = buildSphereTree(*grid, settings).size();
    settings.budgeted().budget.branching = 2;
    const SphereTree tree = buildSphereTree(*grid, settings);
    ASSERT_EQ(tree.levels[0].size(), fewest);
    for (std::size_t k = tree.levels.size(); k-- > 1;) {
        EXPECT_LE(tree.levels[k].size(), 1 << (tree.levels.size() - 1 - k));
        EXPECT_LE(tree.levels[k].size(), tree.levels[k - 1].size());
    }
    EXPECT_LE(fewest, 2 * tree.levels[1].size());
}

TEST(TightBounds, SayWhenABoundCannotBeReached)
{
    const auto grid = gridOf(smallObjects()[2].voxels);
    SphereTreeSettings settings = bounded(Quality::Fast, 1.5, 0.25);
    const int32_t fewest = buildSphereTree(*grid, settings).size();
    ASSERT_GT(fewest, 2);
    settings.budgeted().budget.spheres = {fewest};
    EXPECT_EQ(buildSphereTree(*grid, settings).size(), fewest);
    settings.budgeted().budget.spheres = {fewest - 1};
    const std::string message =
        messageOf<openvdb::ValueError>([&] { buildSphereTree(*grid, settings); });
    EXPECT_TRUE(mentions(message, "error=1.5 and distance=0.25 cannot be reached with spheres="));
    EXPECT_TRUE(mentions(message, "found within it: " + std::to_string(fewest)));
}

} // namespace
