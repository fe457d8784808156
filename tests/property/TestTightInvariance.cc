// SPDX-License-Identifier: Apache-2.0
/// @file TestTightInvariance.cc
/// @brief Tight trees of flat objects, of moved ones, of tiles, at the ends of coordinates; for any number
/// of threads; and when they are interrupted.

#include "support/CheckedTrees.h"
#include "support/Messages.h"
#include "support/TightObjects.h"
#include "support/VectorTarget.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>

#include <tbb/global_control.h>

#include <atomic>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// The voxels with their flat z axis turned to @a axis.
Voxels turnedTo(int axis, const Voxels& flat)
{
    Voxels turned;
    for (const Coord& v : flat) {
        turned.push_back(axis == 2 ? v
                : axis == 1        ? Coord(v[0], v[2], v[1])
                                   : Coord(v[2], v[0], v[1]));
    }
    sortVoxels(turned);
    return turned;
}

void expectFlat(const Voxels& flat, SphereTreeSettings settings)
{
    settings.dim = 2;
    for (int axis = 0; axis < 3; ++axis) {
        const Voxels voxels = turnedTo(axis, flat);
        const auto grid = gridOf(voxels);
        const SphereTree tree = buildSphereTree(*grid, settings);
        ASSERT_NO_FATAL_FAILURE(expectSound(tree, *grid, voxels));
        if (tree.settings.budgeted().cuts) {
            ASSERT_NO_FATAL_FAILURE(expectCutsHold(tree, voxels));
        }
        const int along = tree.flatAxis;
        for (const openvdb::Vec3d& center : tree.spheres.center) {
            ASSERT_EQ(center[along], double(boxOf(voxels).min()[along]));
        }
    }
}

TEST(TightInvariance, InTwoDimensionsStayInThePlaneWhateverItsAxis)
{
    int turn = 0;
    for (const RandomObject& object : smallObjects()) {
        for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
            const SphereTreeSettings settings = tightVariants(quality)[std::size_t(++turn % 16)];
            SCOPED_TRACE(object.name + ": " + describeTight(settings));
            ASSERT_NO_FATAL_FAILURE(expectFlat(flattened(object.voxels), settings));
        }
    }
}

/// Large balls are compared on samples some 16 voxels apart; the plane is on none of them.
TEST(TightInvariance, InTwoDimensionsStayInThePlaneHoweverWideTheObject)
{
    const Voxels flat{Coord(0, 0, 5), Coord(3000, 100, 5), Coord(0, 7000, 5), Coord(1, 1, 5)};
    for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
        for (const Cover cover : {Cover::Voxels, Cover::Balls}) {
            SphereTreeSettings settings = tightSettings(quality);
            settings.tight().cover = cover;
            SCOPED_TRACE(describeTight(settings));
            ASSERT_NO_FATAL_FAILURE(expectFlat(flat, settings));
        }
    }
}

bool sameCuts(const SphereCuts& a, const SphereCuts& b)
{
    return a.spheres == b.spheres && a.first == b.first && a.last == b.last;
}

TEST(TightInvariance, AreTheSameForAnyNumberOfThreads)
{
    using Control = tbb::global_control;
    Random random(1);
    const auto many = gridOf(shapes::noise(Coord(14, 13, 9), 0.4, random));
    const auto few = gridOf(shapes::noise(Coord(6, 6, 6), 0.6, random));
    for (const Quality quality :
        {Quality::Fast, Quality::Normal}) { // by named counts, and to all leaves
        for (const std::vector<int64_t>& spheres : {std::vector<int64_t>{100, 20, 3}, {}}) {
            SphereTreeSettings settings = tightSettings(quality);
            settings.budgeted().budget = SphereBudget();
            settings.budgeted().budget.spheres = spheres;
            std::vector<SphereTree> trees;
            for (const std::size_t threads : {1u, 4u}) {
                const Control control(Control::max_allowed_parallelism, threads);
                trees.push_back(buildSphereTree(*many, settings));
            }
            EXPECT_EQ(trees[0].spheres, trees[1].spheres);
        }
    }
    for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
        const auto& grid = quality == Quality::Best ? few : many; // many at a time
        for (const Cover cover : {Cover::Voxels, Cover::Balls}) {
            SphereTreeSettings settings = tightSettings(quality);
            settings.tight().cover = cover;
            settings.budgeted().cuts = quality != Quality::Best;
            std::vector<SphereTree> trees;
            for (const std::size_t threads : {1, 2, 5}) {
                const Control control(Control::max_allowed_parallelism, threads);
                trees.push_back(buildSphereTree(*grid, settings));
            }
            SCOPED_TRACE(describeTight(settings));
            for (const std::size_t other : {1, 2}) {
                EXPECT_TRUE(sameNodes(trees[0], trees[other]));
                EXPECT_TRUE(sameCuts(trees[0].cuts, trees[other].cuts));
            }
        }
    }
}

/// A product and a sum are rounded one by one on all of them, also where the processor could do both at once.
TEST(TightInvariance, AreTheSameOnEveryVectorTarget)
{
    Random random(2);
    std::vector<Voxels> objects{shapes::noise(Coord(40, 40, 30), 0.5, random), shapes::ball(14)};
    for (const RandomObject& object : smallObjects()) objects.push_back(object.voxels);
    std::vector<SphereTree> first;
    for (const int64_t target : allTargets()) {
        forceTarget(target);
        SCOPED_TRACE(targetName(target));
        std::size_t turn = 0;
        for (const Voxels& voxels : objects) {
            SphereTreeSettings settings = tightSettings(Quality::Fast);
            settings.budgeted().budget = SphereBudget();
            settings.budgeted().budget.spheres = {100, 32, 8};
            const SphereTree tree = buildSphereTree(*gridOf(voxels), settings);
            if (first.size() == turn) first.push_back(tree);
            EXPECT_TRUE(sameNodes(tree, first[turn])) << turn;
            ++turn;
        }
    }
    forceTarget(0);
}

/// Larger balls see samples that lie elsewhere: their trees may differ, but not these.
TEST(TightInvariance, MoveWithObjectsMovedByMultiplesOf8)
{
    int turn = 0;
    for (const RandomObject& object : smallObjects()) {
        if (object.name == "far apart") continue;
        for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
            const SphereTreeSettings settings = tightVariants(quality)[std::size_t(++turn % 16)];
            SCOPED_TRACE(object.name + ": " + describeTight(settings));
            SphereTree tree = buildSphereTree(*gridOf(object.voxels), settings);
            for (const Coord& by : {Coord(8, 0, -8), Coord(-512, 4104, 1 << 20)}) {
                const SphereTree moved =
                    buildSphereTree(*gridOf(translated(object.voxels, by)), settings);
                SphereTree expected = tree;
                for (openvdb::Vec3d& center : expected.spheres.center) center += by.asVec3d();
                for (Coord& ijk : expected.ijk) ijk += by;
                expected.spheres.radiusWorld =
                    moved.spheres.radiusWorld; // make up for rounding of positions
                ASSERT_TRUE(sameNodes(moved, expected));
                for (openvdb::Vec3d& center : expected.cuts.spheres.center) center += by.asVec3d();
                expected.cuts.spheres.radiusWorld = moved.cuts.spheres.radiusWorld;
                ASSERT_TRUE(sameCuts(moved.cuts, expected.cuts));
            }
        }
    }
}

TEST(TightInvariance, OfTilesAndTheSameVoxelsWrittenOutAreTheSame)
{
    const auto tiled = maskOf(CoordBBox(Coord(-8, 0, 8), Coord(7, 7, 15)));
    for (const Coord& v : shapes::ball(14)) tiled->setValueOn(v + Coord(8, 3, 11));
    tiled->prune();
    ASSERT_GT(tiled->activeTileCount(), 0);
    const auto written = std::make_shared<openvdb::MaskTree>(*tiled);
    written->voxelizeActiveTiles();
    for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
        const SphereTreeSettings settings = tightSettings(quality);
        const auto grid = gridOf(*tiled);
        const SphereTree tree = buildSphereTree(*grid, settings);
        EXPECT_TRUE(sameNodes(tree, buildSphereTree(*gridOf(*written), settings)));
        EXPECT_EQ(sentencesOf(checkSphereTree(tree, *grid)), "") << describeTight(settings);
    }
}

/// Says yes from some question on, and counts what is still asked after that.
class Stopper : public openvdb::util::NullInterrupter {
public:
    explicit Stopper(int after) : mAfter(after) {}
    bool wasInterrupted(int = -1) override { return mAsked++ >= mAfter; }
    int asked() const { return mAsked; }

private:
    int mAfter;
    std::atomic<int> mAsked{0};
};

TEST(TightInvariance, EndSoonWhenInterrupted)
{
    Random random(3);
    const auto grid = gridOf(shapes::noise(Coord(7, 6, 6), 0.6, random));
    for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
        SphereTreeSettings settings = tightSettings(quality);
        Stopper never(INT32_MAX);
        buildSphereTree(*grid, settings, nullptr, &never);
        ASSERT_GT(never.asked(), 100);
        for (int part = 0; part < 12; ++part) {
            const int after = int(int64_t(never.asked()) * part / 14);
            Stopper stop(after);
            EXPECT_THROW(buildSphereTree(*grid, settings, nullptr, &stop), Interrupted) << after;
            EXPECT_LT(stop.asked(), after + 40);
        }
    }
}

TEST(TightInvariance, OfObjectsTooWideForTheirUnitsAreRefused)
{
    for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
        SphereTreeSettings settings = tightSettings(quality);
        settings.budgeted().budget.spheres.clear();
        const Voxels fits{Coord(0, 0, 0), Coord(1 << 24, 0, 0)};
        const SphereTree tree = buildSphereTree(*gridOf(fits), settings);
        ASSERT_NO_FATAL_FAILURE(expectChains(tree, fits));
        EXPECT_LT(tree.spheres.radius[0], double(1 << 23) * 1.01);
        const Voxels wide{Coord(0, 0, 0), Coord(1 << 27, 0, 0)};
        EXPECT_TRUE(mentions(
            messageOf<openvdb::ValueError>([&] { buildSphereTree(*gridOf(wide), settings); }),
            "too wide for tree=tight"));
    }
}

TEST(TightInvariance, OfObjectsAtTheEndsOfCoordinatesKeepTheirChains)
{
    for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
        for (const int end : {INT32_MAX - (1 << 17), INT32_MIN + (1 << 17)}) {
            const Voxels voxels =
                joined(translated(shapes::ball(9), Coord(end, 0, end)), {Coord(end, 60, end + 9)});
            const auto grid = gridOf(voxels);
            SCOPED_TRACE(describeTight(tightSettings(quality)));
            ASSERT_NO_FATAL_FAILURE(
                expectSound(buildSphereTree(*grid, tightSettings(quality)), *grid, voxels));
        }
    }
}

} // namespace
