// SPDX-License-Identifier: Apache-2.0
/// @file TestSphereTree.cc
/// @brief What buildSphereTree() promises apart from the spheres themselves: order,
/// ids, world radii, records, errors, and that every tree ends.

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/base/StageSeconds.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/medial/DistanceTransform.h>
#include <openvdb_spheretree/medial/MedialAxis.h>
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/paper/IntersectionDag.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include "support/BuiltTrees.h"
#include "support/Messages.h"

#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

constexpr int kFar = 1000000;

openvdb::BoolGrid::Ptr someGrid(uint32_t seed = 8) { return gridOf(randomObject(seed).voxels); }

/// A box that is no ball: its tree has several levels.
Voxels block() { return translated(shapes::box(Coord(17, 9, 12)), Coord(3, -20, 6)); }

std::string messageOfBuild(const openvdb::BoolGrid& grid, const SphereTreeSettings& settings = {})
{
    return messageOf<openvdb::ValueError>([&] { buildSphereTree(grid, settings); });
}

TEST(SphereTree, RejectsAnEmptyObject)
{
    const auto grid = openvdb::BoolGrid::create();
    grid->setName("nothing");
    EXPECT_TRUE(mentions(messageOfBuild(*grid), "nothing"));
    EXPECT_TRUE(mentions(messageOfBuild(*grid), "no voxels"));
}

TEST(SphereTree, RejectsVoxelsThatAreNotUniform)
{
    const auto grid = gridOf(block());
    grid->setName("flat");
    const auto transform = openvdb::math::Transform::createLinearTransform(1.0);
    transform->preScale(openvdb::Vec3d(1, 1, 0.5));
    grid->setTransform(transform);
    EXPECT_TRUE(mentions(messageOfBuild(*grid), "flat"));
    EXPECT_TRUE(mentions(messageOfBuild(*grid), "uniform"));
    EXPECT_TRUE(mentions(messageOfBuild(*grid), "1 x 1 x 0.5"));
}

TEST(SphereTree, RejectsAFrustum)
{
    const auto grid = gridOf(block());
    grid->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(100)), 0.5, 100, 1));
    EXPECT_TRUE(mentions(messageOfBuild(*grid), "frustum"));
}

TEST(SphereTree, RejectsTwoDimensionsForAThickObject)
{
    SphereTreeSettings settings;
    settings.dim = 2;
    EXPECT_TRUE(mentions(messageOfBuild(*gridOf(block()), settings), "dim=2"));
    EXPECT_TRUE(mentions(messageOfBuild(*gridOf(block()), settings), "12 voxels"));
    EXPECT_NO_THROW(buildSphereTree(*gridOf(flattened(block())), settings));
}

TEST(SphereTree, RejectsSettingsOutOfRange)
{
    for (int factor : {1, 0, -2, 32769}) {
        SphereTreeSettings settings = ExtendedOptions();
        settings.pyramid().factor = factor;
        EXPECT_TRUE(
            mentions(messageOfBuild(*someGrid(), settings), "factor=" + std::to_string(factor)));
    }
    SphereTreeSettings settings;
    settings.dim = 4;
    EXPECT_TRUE(mentions(messageOfBuild(*someGrid(), settings), "dim=4"));
}

TEST(SphereTree, RejectsAnObjectThatIsTooWide)
{
    const Voxels voxels{Coord(0, 0, 0), Coord(0, int(kMaxExtent), 0)};
    EXPECT_FALSE(messageOfBuild(*gridOf(voxels)).empty());
}

TEST(SphereTree, ParentsStandBeforeTheirChildrenAndLevelsAreRangesOfIds)
{
    for (const SphereTreeSettings& settings : bothTypes()) {
        const SphereTree tree = buildSphereTree(*someGrid(), settings);
        ASSERT_GT(tree.levels.size(), 2u);
        int32_t begin = 0;
        for (int level = int(tree.levels.size()) - 1; level >= 0; --level) {
            const SphereTreeLevel& range = tree.levels[level];
            EXPECT_EQ(range.level, level);
            EXPECT_EQ(range.begin, begin);
            EXPECT_GT(range.size(), 0);
            begin = range.end;
            for (int32_t id = range.begin; id < range.end; ++id) {
                EXPECT_EQ(tree.levelOf(id), level);
                EXPECT_LT(tree.spheres.parent[id], range.begin);
                if (id > range.begin) {
                    EXPECT_LT(tree.ijk[id - 1], tree.ijk[id]);
                }
            }
        }
        EXPECT_EQ(begin, tree.size());
        EXPECT_EQ(&tree.root(), &tree.levels.back());
        EXPECT_THROW(tree.levelOf(tree.size()), openvdb::LookupError);
        EXPECT_THROW(tree.levelOf(-1), openvdb::LookupError);
    }
}

TEST(SphereTree, HasAnEntryANodeInEveryArray)
{
    const SphereTree tree = buildSphereTree(*someGrid());
    const std::size_t size = tree.spheres.center.size();
    EXPECT_EQ(tree.spheres.radius.size(), size);
    EXPECT_EQ(tree.spheres.coverRadiusSq.size(), size);
    EXPECT_EQ(tree.spheres.radiusWorld.size(), size);
    EXPECT_EQ(tree.spheres.parent.size(), size);
    EXPECT_EQ(tree.ijk.size(), size);
    EXPECT_EQ(tree.radiusSq.size(), size);
}

TEST(SphereTree, CollectsTheDagOnlyWhenAsked)
{
    for (SphereTreeSettings settings : bothTypes()) {
        EXPECT_TRUE(buildSphereTree(*someGrid(), settings).dag.empty());
        settings.pyramid().parent = ParentRule::Dag;
        EXPECT_TRUE(buildSphereTree(*someGrid(), settings).dag.empty());
        settings.pyramid().dag = true;
        const SphereTree tree = buildSphereTree(*someGrid(), settings);
        EXPECT_FALSE(tree.dag.empty());
        EXPECT_TRUE(std::is_sorted(tree.dag.begin(), tree.dag.end()));
        EXPECT_EQ(std::adjacent_find(tree.dag.begin(), tree.dag.end()), tree.dag.end());
        for (const DagEdge& edge : tree.dag) {
            EXPECT_EQ(tree.levelOf(edge.parent), tree.levelOf(edge.child) + 1);
        }
    }
}

TEST(SphereTree, TheDagDoesNotChangeTheTree)
{
    for (SphereTreeSettings settings : allSettings()) {
        SphereTree with = buildSphereTree(*someGrid(), settings);
        settings.pyramid().dag = false;
        with.dag.clear();
        EXPECT_TRUE(sameNodes(with, buildSphereTree(*someGrid(), settings))) << describe(settings);
    }
}

TEST(SphereTree, RecordsSettingsObjectAndTransform)
{
    auto mask = maskOf(block());
    mask->fill(CoordBBox(Coord(64, 0, 0), Coord(71, 7, 7)), true); // a tile
    const auto grid = gridOf(*mask);
    grid->setName("bunny");
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    SphereTreeSettings settings = extendedTree();
    settings.pyramid().factor = 3;
    settings.extended().finalFit = false;
    settings.name = "my tree";
    settings.padding = 0.75;
    const SphereTree tree = buildSphereTree(*grid, settings);
    EXPECT_EQ(tree.settings.pyramid().factor, 3);
    EXPECT_FALSE(tree.settings.extended().finalFit);
    EXPECT_EQ(tree.settings.name, "my tree");
    EXPECT_EQ(tree.settings.padding, 0.75);
    EXPECT_EQ(tree.settings.type(), TreeType::Extended);
    EXPECT_EQ(tree.object.name, "bunny");
    EXPECT_EQ(tree.object.voxels, 17 * 9 * 12 + 512);
    EXPECT_EQ(tree.object.tiles, 1);
    EXPECT_EQ(tree.object.leaves, int64_t(grid->tree().leafCount()));
    EXPECT_EQ(tree.object.bbox, CoordBBox(Coord(3, -20, 0), Coord(71, 7, 17)));
    EXPECT_EQ(tree.origin, Coord(0, -24, 0));
    EXPECT_EQ(*tree.transform, grid->transform());
    EXPECT_EQ(tree.voxelSize(), 0.25);
    EXPECT_FALSE(tree.levels[0].error.has_value());
}

TEST(SphereTree, CountsThePyramidFromTheOriginAskedFor)
{
    const Voxels object = translated(shapes::box(Coord(17, 9, 12)), Coord(13, 30, 6));
    const auto grid = gridOf(object);
    for (const int factor : {2, 3}) {
        for (const Coord& origin : {Coord(0), Coord(8, -16, 0)}) {
            for (const bool extended : {false, true}) {
                ExtendedOptions options;
                options.factor = factor;
                options.origin = origin;
                options.reconstruct = Reconstruction::None;
                ReversibleOptions reversible;
                static_cast<PyramidOptions&>(reversible) = options;
                const SphereTree tree =
                    extended ? buildSphereTree(*grid, options) : buildSphereTree(*grid, reversible);
                EXPECT_EQ(tree.origin, origin);
                EXPECT_EQ(tree.root().size(), 1);
                std::set<Coord> voxels(object.begin(), object.end());
                for (const SphereTreeLevel& level : tree.levels) {
                    EXPECT_EQ(level.pyramidVoxels, int64_t(voxels.size())) << level.level;
                    std::set<Coord> next;
                    for (const Coord& v : voxels) {
                        const Coord from = level.level == 0 ? v - origin : v; // never negative
                        next.insert(Coord(from[0] / factor, from[1] / factor, from[2] / factor));
                    }
                    voxels = next;
                }
                EXPECT_TRUE(checkSphereTree(tree, *grid).empty());
            }
        }
    }
}

TEST(SphereTree, RefusesAnOriginThatNoPyramidEndsWith)
{
    const auto grid = gridOf(block()); // from (3, -20, 6) on
    ReversibleOptions options;
    options.origin = Coord(0);
    EXPECT_TRUE(mentions(messageOfBuild(*grid, options), "origin=0,0,0"));
    options.origin = Coord(0, -28, 0);
    EXPECT_TRUE(mentions(messageOfBuild(*grid, options), "multiples of 8"));
    options.origin = Coord(0, -(1 << 28) - 64, 0);
    EXPECT_TRUE(mentions(messageOfBuild(*grid, options), "2^28"));
    options.origin = Coord(-8, -24, 0);
    EXPECT_EQ(buildSphereTree(*grid, options).origin, Coord(-8, -24, 0));
}

TEST(SphereTree, KeepsATransformOfItsOwn)
{
    const auto grid = someGrid();
    const SphereTree tree = buildSphereTree(*grid);
    grid->transform().postScale(2.0);
    EXPECT_EQ(tree.voxelSize(), 1.0);
}

TEST(SphereTree, CountsVoxelsOfTheOwnPyramidOnReversibleLevels)
{
    const Voxels voxels = randomObject(30).voxels;
    SphereTreeSettings settings = ReversibleOptions();
    const SphereTree tree = buildSphereTree(*gridOf(voxels), settings);
    const auto pyramid = naiveOrPyramid(voxels, 2);
    for (const SphereTreeLevel& level : tree.levels) {
        EXPECT_EQ(level.pyramidVoxels, int64_t(pyramid.at(level.level).size()));
    }
}

TEST(SphereTree, StoresRadiiPaddedInWorldUnitsRoundedUp)
{
    for (const SphereTreeSettings& type : bothTypes()) {
        for (double padding : {0.0, 1.25, SphereTreeSettings::kPadCubes}) {
            for (double voxelSize : {1.0, 0.1, 12.5}) {
                SphereTreeSettings settings = type;
                settings.padding = padding;
                const auto grid = someGrid();
                grid->setTransform(openvdb::math::Transform::createLinearTransform(voxelSize));
                const SphereTree tree = buildSphereTree(*grid, settings);
                const long double pad = padding < 0 ? std::sqrt(3.0L) / 2 : padding;
                for (int32_t id = 0; id < tree.size(); ++id) {
                    const long double exact = (tree.spheres.radius[id] + pad) * voxelSize;
                    ASSERT_GE((long double)(tree.spheres.radiusWorld[id]), exact * (1 - 0x1p-50L));
                    // A parent may hold its leaves' rounding as well as its own.
                    ASSERT_LE((long double)(tree.spheres.radiusWorld[id]), exact * (1 + 0x1p-21L));
                }
            }
        }
    }
}

/// As readers add it up, who have nothing but the stored numbers.
TEST(SphereTree, StoredSpheresContainTheStoredLeafSpheresBelow)
{
    for (const RandomObject& object : someObjects(1200, 22)) {
        for (const double padding : {0.0, SphereTreeSettings::kPadCubes}) {
            SphereTreeSettings settings = extendedTree();
            settings.padding = padding;
            const auto grid = gridOf(object.voxels);
            grid->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
            const SphereTree tree = buildSphereTree(*grid, settings);
            for (int32_t leaf = tree.levels[0].begin; leaf < tree.levels[0].end; ++leaf) {
                for (int32_t id = tree.spheres.parent[leaf]; id >= 0;
                     id = tree.spheres.parent[id]) {
                    const double apart = (tree.centerWorld(id) - tree.centerWorld(leaf)).length();
                    ASSERT_LE(apart + double(tree.spheres.radiusWorld[leaf]),
                        double(tree.spheres.radiusWorld[id]))
                        << object.name << ", node " << id << ", leaf " << leaf;
                }
            }
        }
    }
}

TEST(SphereTree, StoresARadiusThatIsAFloatAsItIs)
{
    SphereTreeSettings settings = ReversibleOptions();
    settings.padding = 0;
    const SphereTree tree = buildSphereTree(*gridOf(Voxels{Coord(5, 6, 7)}), settings);
    EXPECT_EQ(tree.spheres.radiusWorld[0], 0.0f);
    settings.padding = 0.5;
    const auto grid = gridOf(shapes::ball(10)); // radius 3: radiusSq - 1 = 9
    const SphereTree ball = buildSphereTree(*grid, settings);
    ASSERT_EQ(ball.radiusSq.back(), 10);
    EXPECT_EQ(ball.spheres.radiusWorld.back(), 3.5f);
}

TEST(SphereTree, PadsCubesInTwoDimensionsByHalfASquaresDiagonal)
{
    SphereTreeSettings settings;
    settings.dim = 2;
    const SphereTree tree = buildSphereTree(*gridOf(Voxels{Coord(5, 6, 7)}), settings);
    EXPECT_NEAR(tree.spheres.radiusWorld[0], std::sqrt(2.0) / 2, 1e-6);
}

TEST(SphereTree, ATransformChangesOnlyTheWorldRadii)
{
    const auto grid = someGrid();
    for (const SphereTreeSettings& settings : bothTypes()) {
        SphereTree plain = buildSphereTree(*grid, settings);
        const auto moved = grid->deepCopy();
        const auto transform = openvdb::math::Transform::createLinearTransform(0.5);
        transform->postRotate(1.0, openvdb::math::Y_AXIS);
        transform->postTranslate(openvdb::Vec3d(10, 20, 30));
        moved->setTransform(transform);
        const SphereTree tree = buildSphereTree(*moved, settings);
        EXPECT_EQ(tree.centerWorld(0), transform->indexToWorld(plain.spheres.center[0]));
        plain.spheres.radiusWorld = tree.spheres.radiusWorld;
        EXPECT_TRUE(sameNodes(plain, tree));
    }
}

TEST(SphereTree, ASingleVoxelIsASingleNode)
{
    for (const SphereTreeSettings& settings : allSettings()) {
        const SphereTree tree = buildSphereTree(*gridOf(Voxels{Coord(-5, 6, 70000)}), settings);
        ASSERT_EQ(tree.size(), 1);
        EXPECT_EQ(tree.levels.size(), 1u);
        EXPECT_EQ(tree.spheres.center[0], openvdb::Vec3d(-5, 6, 70000));
        EXPECT_EQ(tree.spheres.radius[0], 0);
        EXPECT_EQ(tree.spheres.coverRadiusSq[0], 0);
        EXPECT_EQ(tree.spheres.parent[0], -1);
        EXPECT_EQ(tree.ijk[0], Coord(-5, 6, 70000));
        EXPECT_EQ(tree.radiusSq[0], 1);
        EXPECT_TRUE(tree.dag.empty());
    }
}

TEST(SphereTree, TwoVoxelsFarApartEndAtOneRootThatHoldsBoth)
{
    const Voxels voxels{Coord(-kFar / 2, 3, 0), Coord(kFar / 2, 3, 0)};
    for (const SphereTreeSettings& settings : allSettings()) {
        SCOPED_TRACE(describe(settings));
        const SphereTree tree = buildSphereTree(*gridOf(voxels), settings);
        EXPECT_TRUE(endsAtOneRoot(tree));
        EXPECT_TRUE(covers(tree, voxels));
        EXPECT_EQ(tree.levels.size(), settings.pyramid().factor == 2 ? 21u : 14u);
    }
}

/// A tree that holds both voxels, or an error that says why not.
void checkWideObject(const SphereTreeSettings& settings)
{
    SCOPED_TRACE(describe(settings));
    const Voxels voxels{Coord(-int(kMaxExtent / 2), 0, 0), Coord(int(kMaxExtent / 2) - 1, 5, 0)};
    const auto grid = gridOf(voxels);
    if (settings.pyramid().factor == 5 || settings.pyramid().factor == 11
        || settings.pyramid().factor == 64) {
        const std::string message = messageOfBuild(*grid, settings); // f^k would pass 2^29
        EXPECT_TRUE(mentions(message, "factor=" + std::to_string(settings.pyramid().factor)));
        return;
    }
    const SphereTree tree = buildSphereTree(*grid, settings);
    EXPECT_TRUE(endsAtOneRoot(tree));
    EXPECT_TRUE(covers(tree, voxels));
    const double fourRSq = 4 * tree.spheres.radius[0] * tree.spheres.radius[0];
    EXPECT_NEAR(double(tree.spheres.coverRadiusSq[0]), fourRSq, 1e-9 * fourRSq);
}

TEST(SphereTree, TheWidestObjectThereMayBeOverflowsNowhere)
{
    for (SphereTreeSettings settings : bothTypes()) {
        for (int i = 0; i < 4; ++i) {
            if (auto* options = settings.find<ExtendedOptions>()) options->finalFit = i % 2 == 0;
            settings.pyramid().scale = i / 2 ? RadiusScale::Paper : RadiusScale::Tight;
            for (int factor : {2, 3, 5, 6, 7, 11, 17, 64}) {
                settings.pyramid().factor = factor;
                checkWideObject(settings);
            }
        }
    }
}

TEST(SphereTree, AnObjectAcrossTheOriginEndsAtOneRoot)
{
    const Voxels voxels = translated(shapes::box(Coord(11, 10, 9)), Coord(-5, -5, -5));
    for (const SphereTreeSettings& settings : allSettings()) {
        SCOPED_TRACE(describe(settings));
        const SphereTree tree = buildSphereTree(*gridOf(voxels), settings);
        EXPECT_GT(tree.levels.size(), 1u);
        EXPECT_TRUE(endsAtOneRoot(tree));
        EXPECT_TRUE(covers(tree, voxels));
    }
}

TEST(SphereTree, EveryCombinationOfSettingsEndsAtOneRootAndCoversTheObject)
{
    for (uint32_t seed : {3u, 6u, 8u, 21u, 30u, 41u}) {
        const RandomObject object = randomObject(seed);
        const auto grid = gridOf(object.voxels);
        for (const SphereTreeSettings& settings : allSettings()) {
            SCOPED_TRACE(object.name + ": " + describe(settings));
            const SphereTree tree = buildSphereTree(*grid, settings);
            ASSERT_TRUE(endsAtOneRoot(tree));
            ASSERT_TRUE(covers(tree, object.voxels));
        }
    }
}

TEST(SphereTree, AnyFactorEndsAtOneRoot)
{
    const Voxels voxels = randomObject(8).voxels;
    for (SphereTreeSettings settings : bothTypes()) {
        for (int factor : {4, 5, 7, 8, 16, 33, 64}) {
            settings.pyramid().factor = factor;
            SCOPED_TRACE(describe(settings));
            const SphereTree tree = buildSphereTree(*gridOf(voxels), settings);
            EXPECT_TRUE(endsAtOneRoot(tree));
            EXPECT_TRUE(covers(tree, voxels));
        }
    }
}

/// Of tight trees what takes long: every quality, bounds, all numbers of spheres, inner ones.
std::vector<SphereTreeSettings> manyTypes()
{
    std::vector<SphereTreeSettings> types = bothTypes();
    for (const Quality quality : {Quality::Fast, Quality::Normal, Quality::Best}) {
        TightOptions options;
        options.quality = quality;
        types.push_back(options);
        options.budget.spheres = {8, 2};
        options.cuts = quality != Quality::Best;
        types.push_back(options);
        options.budget = {};
        options.budget.error = 300;
        options.cuts = false;
        types.push_back(options);
    }
    types.push_back(InnerOptions());
    return types;
}

TEST(SphereTree, StopsWhenInterruptedAtAnyQuestion)
{
    const auto grid = gridOf(shapes::box(Coord(9, 5, 6)));
    for (const SphereTreeSettings& settings : manyTypes()) {
        SCOPED_TRACE(describe(settings));
        int questions = 0;
        for (bool finished = false; !finished; questions = 1 + questions * 3 / 2) {
            ASSERT_LT(questions, 1000000);
            StopAfter stop(questions);
            try {
                finished = buildSphereTree(*grid, settings, nullptr, &stop).size() > 0;
            } catch (const Interrupted&) {}
        }
        EXPECT_GT(questions, 20) << "the build hardly asks";
    }
}

TEST(SphereTree, AddsTheTimesOfItsStages)
{
    StageSeconds seconds;
    seconds.pyramid = 1000;
    buildSphereTree(*gridOf(block()), extendedTree(), &seconds);
    EXPECT_GT(seconds.pyramid, 1000);
    EXPECT_GT(seconds.distance, 0);
    EXPECT_GT(seconds.power, 0);
    EXPECT_GT(seconds.medial, 0);
    EXPECT_GT(seconds.tree, 0);
    EXPECT_GT(seconds.topology, 0);
}

TEST(SphereTree, CountsTopologyUnlessToldNotTo)
{
    for (SphereTreeSettings settings : bothTypes()) {
        for (const bool topology : {true, false}) {
            settings.topology = topology;
            StageSeconds seconds;
            const SphereTree tree = buildSphereTree(*someGrid(), settings, &seconds);
            for (const SphereTreeLevel& level : tree.levels) {
                EXPECT_EQ(level.topology.has_value(), topology);
            }
            EXPECT_EQ(seconds.topology > 0, topology);
        }
    }
}

TEST(SphereTree, ARadiusThatFitsNoFloatIsAnError)
{
    const auto object = someGrid();
    object->setTransform(openvdb::math::Transform::createLinearTransform(1e31));
    SphereTreeSettings settings;
    settings.padding = 1e9;
    EXPECT_TRUE(mentions(messageOfBuild(*object, settings), "does not fit a float"));
}

/// Hears the names of stages, and the percents that each says of itself.
struct Listener : openvdb::util::NullInterrupter {
    std::vector<std::string> open;
    std::map<std::string, std::vector<int>> percents;
    void start(const char* name = nullptr) override
    {
        open.push_back(name);
        percents[name];
    }
    void end() override { open.pop_back(); }
    bool wasInterrupted(int percent = -1) override
    {
        if (percent != -1 && !open.empty()) percents[open.back()].push_back(percent);
        return false;
    }
};

/// By one thread, which is told everything in order.
TEST(SphereTree, StagesSayWhatTheyDoAndHowFarTheyAre)
{
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    Random random(1);
    const auto grid = gridOf(shapes::noise(Coord(50, 40, 30), 0.9, random));
    Listener listener;
    buildSphereTree(*grid, extendedTree(), nullptr, &listener);
    EXPECT_TRUE(listener.open.empty());
    for (const char* name :
        {"distances and power labels", "power labels along x", "medial balls", "pyramid"}) {
        EXPECT_TRUE(listener.percents.count(name)) << name;
    }
    for (const auto& [name, percents] : listener.percents) {
        for (const int percent : percents) {
            EXPECT_GE(percent, 0) << name;
            EXPECT_LE(percent, 100) << name;
        }
    }
    for (const char* name : {"power labels along x", "medial balls"}) {
        const std::vector<int>& percents = listener.percents[name];
        const std::set<int> different(percents.begin(), percents.end());
        ASSERT_GE(different.size(), 2u) << name;
        EXPECT_EQ(*different.begin(), 0) << name;
        EXPECT_GE(*different.rbegin(), 25) << name;
    }
}

TEST(SphereTree, StagesRefuseADimensionThatIsNone)
{
    const auto object = someGrid();
    EXPECT_THROW(distanceTransform(*object, 1), openvdb::ValueError);
    EXPECT_THROW(distanceTransform(*object, 4), openvdb::ValueError);
    EXPECT_THROW(medialBalls(*object, 7), openvdb::ValueError);
    EXPECT_THROW(buildOrPyramid(*object, 2, -1), openvdb::ValueError);
    const openvdb::MaskTree mask(object->tree(), false, openvdb::TopologyCopy());
    EXPECT_THROW(MedialLevel(mask, 4, Distance(), nullptr), openvdb::ValueError);
    EXPECT_THROW(MedialLevel(mask, 4, Distance::l1(), nullptr), openvdb::ValueError);
}

TEST(SphereTree, ParentsByTheDagLeaveNoEdgesBehindUnlessAsked)
{
    for (SphereTreeSettings settings : bothTypes()) {
        settings.pyramid().parent = ParentRule::Dag;
        EXPECT_TRUE(buildSphereTree(*someGrid(), settings).dag.empty());
        settings.pyramid().dag = true;
        settings.pyramid().edges = DagEdges::Intersecting;
        const SphereTree tree = buildSphereTree(*someGrid(), settings);
        EXPECT_TRUE(tree.dag == intersectionDag(tree));
    }
}

} // namespace
