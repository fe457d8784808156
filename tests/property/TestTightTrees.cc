// SPDX-License-Identifier: Apache-2.0
/// @file TestTightTrees.cc
/// @brief What holds for every tight tree, whatever it is asked for: chains of spheres by brute
/// force, the check, counts, cuts, bounds, threads, moves.

#include "support/BuiltTrees.h"
#include "support/Messages.h"
#include "support/NaiveChains.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/measure/LevelErrors.h>

#include <tbb/global_control.h>

#include <atomic>
#include <numeric>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

Voxels joined(const Voxels& a, const Voxels& b)
{
    Voxels both = a;
    both.insert(both.end(), b.begin(), b.end());
    sortVoxels(both);
    return both;
}

Voxels slantedLine(const Coord& step, int count)
{
    Voxels voxels;
    for (int i = 0; i < count; ++i) voxels.emplace_back(i * step[0], i * step[1], i * step[2]);
    return voxels;
}

/// A tenth of a box, but never nothing.
Voxels dust(int side, Random& random)
{
    return joined({Coord(0, 0, 0)}, shapes::noise(Coord(side), 0.1, random));
}

/// Small enough for brute force; across the borders of leaves and of the sign of coordinates.
std::vector<RandomObject> smallObjects()
{
    Random random(7);
    std::vector<RandomObject> objects{
        {"one voxel", {Coord(-3, 8, 7)}},
        {"ball", translated(shapes::ball(20), Coord(-2, 7, 130))},
        {"blob", translated(shapes::noise(Coord(7, 6, 8), 0.8, random), Coord(-4, 125, -3))},
        {"components", translated(shapes::noise(Coord(7, 7, 6), 0.35, random), Coord(5, -9, -4))},
        {"dust", translated(dust(8, random), Coord(-1000, 4, 4))},
        {"sheet", translated(shapes::box(Coord(11, 1, 12)), Coord(-5, -1, 3))},
        {"line", translated(shapes::box(Coord(1, 1, 25)), Coord(0, 0, -13))},
        {"slanted line", slantedLine(Coord(1, -1, 1), 15)},
        {"box", translated(shapes::box(Coord(9, 5, 6)), Coord(-1, -1, -1))},
        {"shell", translated(shapes::ball(20, 10), Coord(8, 8, 8))},
        {"far apart", joined(shapes::ball(8), translated(shapes::ball(6), Coord(700, -90, 31)))},
    };
    for (RandomObject& object : objects) sortVoxels(object.voxels);
    return objects;
}

SphereTreeSettings tightSettings(Quality quality)
{
    SphereTreeSettings settings;
    settings.tight().quality = quality;
    settings.topology = false;
    settings.budgeted().budget.branching = 3;
    if (quality == Quality::Best) {
        settings.budgeted().budget = SphereBudget();
        settings.budgeted().budget.spheres = {1, 4};
    }
    return settings;
}

/// What a tree is to cover, made of which leaves, with cuts, padded.
std::vector<SphereTreeSettings> tightVariants(Quality quality)
{
    std::vector<SphereTreeSettings> all;
    for (int i = 0; i < 16; ++i) {
        SphereTreeSettings settings = tightSettings(quality);
        settings.tight().cover = i % 2 ? Cover::Balls : Cover::Voxels;
        settings.tight().leaves = i / 2 % 2 ? Leaves::Medial : Leaves::Pruned;
        settings.budgeted().cuts = i / 4 % 2 && quality != Quality::Best; // which refuses them
        settings.padding = i / 8 % 2 ? 0 : SphereTreeSettings::kPadCubes;
        all.push_back(settings);
    }
    return all;
}

std::string describeTight(const SphereTreeSettings& s)
{
    return std::string("quality=") + toString(s.tight().quality)
        + " cover=" + toString(s.tight().cover) + " leaves=" + toString(s.tight().leaves)
        + " cuts=" + (s.tight().cuts ? "1" : "0") + " dim=" + std::to_string(s.dim)
        + " padding=" + paddingToString(s.padding);
}

int64_t sumOf(const std::vector<int64_t>& counts)
{
    return std::accumulate(counts.begin(), counts.end(), int64_t(0));
}

std::string failuresOf(const SphereTree& tree, const openvdb::BoolGrid& grid)
{
    std::string text;
    for (const std::string& failure : checkSphereTree(tree, grid)) text += failure + "\n";
    return text;
}

/// Level 0 of a tree whose leaves are digital balls.
Voxels rebuilt(const SphereTree& tree)
{
    Voxels voxels;
    for (int32_t id = tree.levels[0].begin; id < tree.levels[0].end; ++id) {
        for (const Coord& v : shapes::ball(tree.radiusSq[id])) {
            const bool inPlane = tree.settings.dim == 3 || v[tree.flatAxis] == 0;
            if (inPlane) voxels.push_back(v + tree.ijk[id]);
        }
    }
    sortVoxels(voxels);
    return voxels;
}

void expectChains(const SphereTree& tree, const Voxels& voxels)
{
    ASSERT_EQ(
        sumOf(naiveBrokenLevels(tree, voxels, holdsExactly(tree.spheres, tree.subdivision))), 0);
    ASSERT_EQ(sumOf(naiveBrokenLevels(tree, voxels, holdsStored(tree.spheres, tree))), 0);
}

void expectSound(const SphereTree& tree, const openvdb::BoolGrid& grid, const Voxels& voxels)
{
    ASSERT_NO_FATAL_FAILURE(expectChains(tree, voxels));
    ASSERT_EQ(failuresOf(tree, grid), "");
    ASSERT_TRUE(endsAtOneRoot(tree));
    if (tree.levels[0].pyramidVoxels > 0) {
        ASSERT_EQ(rebuilt(tree), voxels);
    }
}

/// Every number of spheres there is.
void expectCutsHold(const SphereTree& tree, const Voxels& voxels)
{
    const SphereCuts& cuts = tree.cuts;
    int32_t leaves = 0;
    for (const int32_t last : cuts.last) leaves = std::max(leaves, last);
    for (int32_t n = 1; n <= leaves; ++n) {
        ASSERT_EQ(cutNodes(cuts, n).size(), std::size_t(n));
        if (n > 12 && n % 7 != 0 && n < leaves - 3) continue;
        ASSERT_EQ(
            naiveBrokenCut(cuts, leaves, n, voxels, holdsExactly(cuts.spheres, tree.subdivision)),
            0)
            << n;
        ASSERT_EQ(naiveBrokenCut(cuts, leaves, n, voxels, holdsStored(cuts.spheres, tree)), 0) << n;
    }
}

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
    for (uint32_t seed = 2100; seed < 2133; ++seed) {
        const RandomObject object = randomObject(seed);
        if (object.voxels.size() < 40 || object.voxels.size() > 150) continue;
        SphereTreeSettings settings = tightSettings(Quality::Best);
        settings.budgeted().budget.spheres =
            seed % 2 ? std::vector<int64_t>{13, 8, 5, 3, 1} : std::vector<int64_t>{9, 4, 1};
        SCOPED_TRACE(object.name + ": " + describeTight(settings));
        const auto grid = gridOf(object.voxels);
        ASSERT_NO_FATAL_FAILURE(
            expectSound(buildSphereTree(*grid, settings), *grid, object.voxels));
    }
}

TEST(TightTrees, OfRandomObjectsKeepTheirChains)
{
    for (uint32_t seed = 2000; seed < 2066; ++seed) {
        const RandomObject object = randomObject(seed);
        const Quality quality = Quality(seed % 3);
        if (object.voxels.size() > (quality == Quality::Best ? 120 : 400)) continue;
        SphereTreeSettings settings = tightSettings(quality);
        settings.tight().cover = seed % 5 ? Cover::Voxels : Cover::Balls;
        settings.budgeted().budget.spheres = {1, 5};
        settings.budgeted().budget.branching = 0;
        SCOPED_TRACE(object.name + ": " + describeTight(settings));
        const auto grid = gridOf(object.voxels);
        ASSERT_NO_FATAL_FAILURE(
            expectSound(buildSphereTree(*grid, settings), *grid, object.voxels));
    }
}

TEST(TightTrees, HaveTheCountsAskedFor)
{
    for (const RandomObject& object : smallObjects()) {
        const auto grid = gridOf(object.voxels);
        for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
            if (quality == Quality::Best && object.voxels.size() > 70) continue;
            SphereTreeSettings settings = tightSettings(quality);
            settings.budgeted().budget = SphereBudget();
            settings.budgeted().budget.spheres = {2, 7, 1000000, 1, 4};
            SCOPED_TRACE(object.name + ": " + describeTight(settings));
            const SphereTree tree = buildSphereTree(*grid, settings);
            const int32_t leaves = tree.levels[0].size();
            ASSERT_EQ(rebuilt(tree), object.voxels);
            std::vector<int64_t> counts;
            for (const int32_t n : {1000000, 7, 4, 2, 1}) counts.push_back(std::min(n, leaves));
            counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
            ASSERT_EQ(tree.levels.size(), counts.size());
            for (std::size_t k = 0; k < counts.size(); ++k) {
                if (quality == Quality::Best) ASSERT_LE(tree.levels[k].size(), counts[k]);
                else ASSERT_EQ(tree.levels[k].size(), counts[k]);
            }
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

TEST(TightTrees, InTwoDimensionsStayInThePlaneWhateverItsAxis)
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
TEST(TightTrees, InTwoDimensionsStayInThePlaneHoweverWideTheObject)
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

TEST(TightTrees, AreTheSameForAnyNumberOfThreads)
{
    using Control = tbb::global_control;
    Random random(1);
    const auto many = gridOf(shapes::noise(Coord(14, 13, 9), 0.4, random));
    const auto few = gridOf(shapes::noise(Coord(6, 6, 6), 0.6, random));
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

/// Larger balls see samples that lie elsewhere: their trees may differ, but not these.
TEST(TightTrees, MoveWithObjectsMovedByMultiplesOf8)
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

TEST(TightTrees, OfTilesAndTheSameVoxelsWrittenOutAreTheSame)
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
        EXPECT_EQ(failuresOf(tree, *grid), "") << describeTight(settings);
    }
}

bool isWithin(const SphereTree& tree, const openvdb::BoolGrid& grid, const SphereBudget& budget)
{
    SphereTree measured = tree;
    computeLevelErrors(measured, grid);
    const LevelError& error = measured.levels[0].error.value();
    return (!budget.error || error.hammingPercent <= *budget.error)
        && (!budget.distance || error.hausdorff * tree.voxelSize() <= *budget.distance);
}

SphereTreeSettings bounded(
    Quality quality, std::optional<double> error, std::optional<double> distance)
{
    SphereTreeSettings settings = tightSettings(quality);
    settings.budgeted().budget = SphereBudget();
    settings.budgeted().budget.error = error;
    settings.budgeted().budget.distance = distance;
    return settings;
}

/// Of the cuts there are, the ones with fewer spheres are further off.
void expectFewest(const openvdb::BoolGrid& grid, const SphereTreeSettings& settings)
{
    const SphereTree tree = buildSphereTree(grid, settings);
    ASSERT_EQ(tree.levels.size(), 1u);
    ASSERT_TRUE(isWithin(tree, grid, settings.budgeted().budget)) << tree.size() << " spheres";
    ASSERT_EQ(failuresOf(tree, grid), "");
    SphereTreeSettings free = settings;
    free.budget = SphereBudget();
    free.cuts = true;
    if (settings.tight().quality == Quality::Best) return; // has no cuts of what was searched
    const SphereTree all = buildSphereTree(grid, free);
    for (int32_t n = tree.size() - 1; n > std::max(0, tree.size() - 9); --n) {
        ASSERT_FALSE(isWithin(cutTree(all, n), grid, settings.budgeted().budget))
            << n << " of " << tree.size();
    }
}

/// Voxels of 1/2.
void expectFewestOf(const RandomObject& object, const SphereTreeSettings& settings)
{
    const auto grid = gridOf(object.voxels);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    const SphereBudget& budget = settings.budgeted().budget;
    SCOPED_TRACE(object.name + ": " + describeTight(settings) + ", error "
        + std::to_string(budget.error.value_or(-1)) + ", distance "
        + std::to_string(budget.distance.value_or(-1)));
    ASSERT_NO_FATAL_FAILURE(expectFewest(*grid, settings));
}

TEST(TightTrees, HaveTheFewestSpheresWithinABound)
{
    int turn = 0;
    for (const RandomObject& object : smallObjects()) {
        if (object.name == "far apart") continue; // its errors take long to count
        const Quality quality = ++turn % 2 ? Quality::Fast : Quality::Normal;
        for (const double error : {0.0, 20.0, 120.0}) {
            ASSERT_NO_FATAL_FAILURE(expectFewestOf(object, bounded(quality, error, {})));
        }
        for (const double distance : {0.0, 0.5, 0.9, 2.0}) {
            ASSERT_NO_FATAL_FAILURE(expectFewestOf(object, bounded(quality, {}, distance)));
        }
        ASSERT_NO_FATAL_FAILURE(expectFewestOf(object, bounded(quality, 60.0, 0.9)));
    }
}

/// A search for less excess may reach further out.
TEST(TightTrees, StayWithinABoundWhenSearched)
{
    const RandomObject components = smallObjects()[3];
    for (const double distance : {0.5, 0.9, 1.2}) {
        ASSERT_NO_FATAL_FAILURE(expectFewestOf(components, bounded(Quality::Best, {}, distance)));
    }
    ASSERT_NO_FATAL_FAILURE(expectFewestOf(components, bounded(Quality::Best, 120.0, {})));
}

TEST(TightTrees, WithinABoundHaveTheLadderBelow)
{
    const auto grid = gridOf(smallObjects()[3].voxels);
    SphereTreeSettings settings = bounded(Quality::Normal, 30.0, std::nullopt);
    const int32_t fewest = buildSphereTree(*grid, settings).size();
    settings.budgeted().budget.branching = 2;
    const SphereTree tree = buildSphereTree(*grid, settings);
    ASSERT_EQ(tree.levels[0].size(), fewest);
    for (std::size_t k = tree.levels.size(); k-- > 1;) {
        EXPECT_EQ(tree.levels[k].size(), 1 << (tree.levels.size() - 1 - k));
    }
    EXPECT_LE(fewest, 2 * tree.levels[1].size());
}

TEST(TightTrees, SayWhenABoundCannotBeReached)
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
    EXPECT_TRUE(mentions(message, "it takes " + std::to_string(fewest)));
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

TEST(TightTrees, EndSoonWhenInterrupted)
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

TEST(TightTrees, OfObjectsTooWideForTheirUnitsAreRefused)
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

TEST(TightTrees, OfObjectsAtTheEndsOfCoordinatesKeepTheirChains)
{
    for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
        for (const int end : {INT32_MAX - 4000, INT32_MIN + 4000}) {
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
