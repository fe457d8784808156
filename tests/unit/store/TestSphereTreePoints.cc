// SPDX-License-Identifier: Apache-2.0
/// @file TestSphereTreePoints.cc
/// @brief A tree becomes a grid of points and comes back; and what other programs see of it.

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/tree/GivenTree.h>
#include <openvdb_spheretree/tree/SphereTracks.h>

#include "support/CoreStages.h"
#include "support/Messages.h"
#include "support/PointsFiles.h"
#include "support/TreeSettings.h"
#include "support/SampleTrees.h"

#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointCount.h>
#include <openvdb/points/PointGroup.h>

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
namespace math = openvdb::math;
namespace points = openvdb::points;

std::vector<math::Transform::Ptr> transformsOfEveryKind()
{
    using namespace openvdb::math;
    std::vector<Transform::Ptr> transforms;
    const auto add = [&](MapBase* map) {
        transforms.push_back(std::make_shared<Transform>(MapBase::Ptr(map)));
    };
    add(new ScaleMap({0.1, 0.1, 0.1}));
    add(new ScaleMap({0.1, 0.1 + 1e-9, -0.1}));
    add(new UniformScaleMap(1.0 / 3));
    add(new TranslationMap({0.1, 2e10, -7}));
    add(new UnitaryMap(openvdb::Vec3d(1, 2, 3), 0.7));
    add(new ScaleTranslateMap({0.1, -0.1, 0.1}, {1.0 / 7, 0, 5}));
    add(new UniformScaleTranslateMap(1e-4, {1.0 / 7, 1e9, 5}));
    transforms.push_back(Transform().copy()); // OpenVDB simplifies every map that it copies
    transforms.push_back(Transform::createLinearTransform(0.07));
    transforms.back()->postRotate(0.3, X_AXIS);
    transforms.back()->postRotate(1.3, Z_AXIS);
    transforms.push_back(transforms.back()->copy());
    transforms.back()->postTranslate({0.1, 0.2, 0.3});
    transforms.push_back(Transform::createLinearTransform(1.0));
    transforms.back()->preRotate(0.3, Y_AXIS);
    return transforms;
}

// ---- Round trips

TEST(SphereTreePoints, EveryFieldComesBackFromMemory)
{
    for (const SphereTree& tree :
        {sampleTree(), oneVoxelTree(), randomTree(1, 1), randomTree(5000, 2)}) {
        expectSameTree(fromPoints(*toPoints(tree), dagToPoints(tree).get()), tree);
    }
}

/// As of a later frame of a sequence.
SphereTree trackedTree()
{
    SphereTree tree = randomTree(500, 4);
    startTracks(tree);
    std::reverse(tree.track.begin(), tree.track.end());
    tree.nextTrack += 1000;
    return tree;
}

TEST(SphereTreePoints, TracksComeBack)
{
    const SphereTree tree = trackedTree();
    expectSameTree(fromPoints(*toPoints(tree)), tree);
    SphereTree released = tree;
    expectSameTree(fromPoints(*releaseToPoints(released)), tree);
    const auto read = throughFile({toPoints(tree)});
    expectSameTree(fromPoints(*read.at(0)), tree);
}

TEST(SphereTreePoints, DamagedTracksAreRefused)
{
    const SphereTree tree = trackedTree();
    const auto refused = [&](const std::function<void(points::PointDataGrid&)>& damage) {
        const auto grid = toPoints(tree);
        damage(*grid);
        return messageOf<openvdb::Exception>([&] { fromPoints(*grid); });
    };
    const auto set = [](int32_t value) {
        return [value](points::PointDataGrid& grid) {
            for (auto leaf = grid.tree().beginLeaf(); leaf; ++leaf) {
                points::AttributeWriteHandle<int32_t> handle(leaf->attributeArray("track"));
                handle.set(0, value);
                return;
            }
        };
    };
    EXPECT_TRUE(mentions(refused(set(int32_t(1e6))), "tracks"));
    EXPECT_TRUE(mentions(refused(set(tree.nextTrack - 1)), "track"));
    EXPECT_TRUE(mentions(
        refused([](points::PointDataGrid& grid) { points::dropAttribute(grid.tree(), "track"); }),
        "'track'"));
    EXPECT_TRUE(mentions(refused([](points::PointDataGrid& grid) {
        grid.insertMeta("spheretree_next_track", openvdb::Int32Metadata(0));
    }),
        "metadata"));
}

TEST(SphereTreePoints, EveryFieldComesBackFromAFile)
{
    for (const SphereTree& tree : {sampleTree(), randomTree(20000, 3)}) {
        openvdb::GridCPtrVec grids{toPoints(tree)};
        if (!tree.dag.empty()) grids.push_back(dagToPoints(tree));
        const auto read = throughFile(grids);
        ASSERT_EQ(read.size(), grids.size());
        expectSameTree(fromPoints(*read[0], read.size() > 1 ? read[1].get() : nullptr), tree);
    }
}

TEST(SphereTreePoints, ALevelThatStandsAloneComesBack)
{
    for (int level : {0, 1, 2}) {
        const SphereTree tree = oneLevelOf(sampleTree(), level);
        ASSERT_EQ(tree.levels[0].level, level);
        expectSameTree(fromPoints(*throughFile({toPoints(tree)})[0]), tree);
    }
}

TEST(SphereTreePoints, EveryKindOfTransformComesBackToTheLastBit)
{
    SphereTree tree = randomTree(500, 4); // enough nodes for points voxels larger than the source's
    for (const math::Transform::Ptr& transform : transformsOfEveryKind()) {
        SCOPED_TRACE(transform->mapType());
        tree.transform = transform;
        expectSameTree(fromPoints(*toPoints(tree)), tree);
        expectSameTransform(*fromPoints(*throughFile({toPoints(tree)})[0]).transform, *transform);
    }
}

TEST(SphereTreePoints, WhoMovesThePointsMovesTheTree)
{
    for (const math::Transform::Ptr& transform : transformsOfEveryKind()) {
        SCOPED_TRACE(transform->mapType());
        SphereTree tree = randomTree(500, 5);
        tree.transform = transform;
        const PointDataGrid::Ptr grid = toPoints(tree);
        grid->transform().postTranslate({10, 20, 30});
        EXPECT_THROW(fromPoints(*grid), openvdb::IoError) << "it may be damage";
        grid->removeMeta("spheretree_checksum_transform");
        const SphereTree moved = fromPoints(*grid);
        for (int32_t id : {0, 1, 100}) {
            const openvdb::Vec3d expected = tree.centerWorld(id) + openvdb::Vec3d(10, 20, 30);
            EXPECT_LE((moved.centerWorld(id) - expected).length(), 1e-12 * expected.length());
        }
    }
}

TEST(SphereTreePoints, SettingsOfEveryKindComeBack)
{
    SphereTree tree = oneVoxelTree();
    for (TreeType type : {TreeType::Reversible, TreeType::Extended}) {
        for (double padding : {SphereTreeSettings::kPadCubes, 0.0, 1.0 / 3}) {
            setType(tree.settings, type);
            tree.settings.padding = padding;
            tree.settings.dim = 5 - tree.settings.dim; // 2 and 3 in turn
            tree.settings.name = "";
            expectSameTree(fromPoints(*toPoints(tree)), tree);
        }
    }
}

TEST(SphereTreePoints, SettingsOfTightTreesComeBack)
{
    SphereTree tree = oneVoxelTree();
    tree.settings.pyramid().center = Center::Miniball;
    expectSameTree(fromPoints(*toPoints(tree)), tree);
    tree.settings.pyramid().center = Center::Medial;
    setType(tree.settings, TreeType::Tight);
    tree.settings.budgeted().budget.branching = 5;
    tree.settings.budgeted().budget.error = 1.0 / 3;
    expectSameTree(fromPoints(*toPoints(tree)), tree);
    tree.settings.budgeted().budget = {};
    tree.settings.budgeted().budget.distance = 1e-300;
    tree.settings.tight().quality = Quality::Fast;
    expectSameTree(fromPoints(*toPoints(tree)), tree);
    tree.settings.budgeted().budget.bounds = BoundOf::Unpadded;
    expectSameTree(fromPoints(*toPoints(tree)), tree);
}

TEST(SphereTreePoints, WhatABoundIsOfIsRecordedWithItAndWasUnpaddedBefore)
{
    const char* const key = "spheretree_bounds";
    SphereTree tree = oneVoxelTree();
    setType(tree.settings, TreeType::Tight);
    EXPECT_FALSE((*toPoints(tree))[key]) << "no bound";
    tree.settings.budgeted().budget.error = 10;
    const PointDataGrid::Ptr grid = toPoints(tree);
    ASSERT_TRUE((*grid)[key]);
    EXPECT_EQ((*grid)[key]->str(), "stored");
    EXPECT_EQ(fromPoints(*grid).settings.tight().budget.bounds, BoundOf::Stored);
    removeChecksum(*grid);
    grid->removeMeta(key);
    EXPECT_EQ(fromPoints(*grid).settings.tight().budget.bounds, BoundOf::Unpadded);
}

TEST(SphereTreePoints, ADistanceInVoxelsIsStoredInWorldUnits)
{
    SphereTree tree = oneVoxelTree(); // voxels of 0.5
    setType(tree.settings, TreeType::Tight);
    tree.settings.budgeted().budget.distance = 3;
    tree.settings.budgeted().budget.distanceInVoxels = true;
    const SphereBudget back = fromPoints(*toPoints(tree)).settings.tight().budget;
    EXPECT_EQ(back.distance, 1.5);
    EXPECT_FALSE(back.distanceInVoxels);
}

TEST(SphereTreePoints, AFileFromBeforeTightTreesIsReadAsItWas)
{
    SphereTree tree = randomTree(50, 3);
    fillDescription(tree);
    tree.hasDag = false; // without a grid of edges
    const PointDataGrid::Ptr grid = toPoints(tree);
    removeChecksum(*grid);
    for (const char* key : {"subdivision", "quality", "spheres", "branching", "cover", "leaves",
             "side", "cuts", "center"}) {
        EXPECT_TRUE((*grid)["spheretree_" + std::string(key)]) << key;
        grid->removeMeta("spheretree_" + std::string(key));
    }
    expectSameTree(fromPoints(*grid), tree);
}

TEST(SphereTreePoints, AFileFromBeforeTopologyWasCountedHasNone)
{
    SphereTree tree = sampleTree();
    tree.dag.clear(); // which is a grid of its own
    tree.hasDag = false;
    tree.settings.topology = true;
    const PointDataGrid::Ptr grid = toPoints(tree);
    removeChecksum(*grid);
    for (const char* key :
        {"topology", "level_0_components", "level_0_tunnels", "level_0_cavities"}) {
        grid->removeMeta("spheretree_" + std::string(key));
    }
    tree.settings.topology = false;
    tree.levels[0].topology.reset();
    expectSameTree(fromPoints(*grid), tree);
}

/// Version 0.1 took and recorded settings of extended trees for reversible ones, without any use.
TEST(SphereTreePoints, AReversibleTreeMayRecordAnyReconstruction)
{
    SphereTree tree = oneVoxelTree();
    setType(tree.settings, TreeType::Reversible);
    const PointDataGrid::Ptr grid = toPoints(tree);
    removeChecksum(*grid);
    grid->insertMeta("spheretree_reconstruct", openvdb::StringMetadata("free"));
    grid->insertMeta("spheretree_final_fit", openvdb::BoolMetadata(false));
    expectSameTree(fromPoints(*grid), tree);
}

TEST(SphereTreePoints, CentresFarOutAndBetweenVoxelsAreExact)
{
    SphereTree tree = oneVoxelTree();
    tree.subdivision = 16;
    for (double far : {0.0, 1e6, -1e9, 2e9}) {
        for (double part : {0.5, -0.5, 0.25, 1.0 / 16, -15.0 / 16}) {
            tree.spheres.center[0] = openvdb::Vec3d(far + part, -far - part, part);
            EXPECT_EQ(fromPoints(*toPoints(tree)).spheres.center[0], tree.spheres.center[0]);
        }
    }
    tree = randomTree(2000, 6);
    tree.subdivision = 16;
    for (openvdb::Vec3d& center : tree.spheres.center)
        center += openvdb::Vec3d(1e9, 0.0625, -0.4375);
    EXPECT_EQ(fromPoints(*toPoints(tree)).spheres.center, tree.spheres.center);
}

TEST(SphereTreePoints, SpheresThatWereReadComeBack)
{
    openvdb_spheretree::WorldSpheres spheres;
    spheres.name = "given";
    uint32_t random = 1;
    const auto next = [&] { return double(random = random * 1664525 + 1013904223) / 4294967296.0; };
    for (int i = 0; i < 500; ++i) { // far apart: points of a grid with wide voxels
        const double far = i % 2 ? 1e5 : 1;
        spheres.center.emplace_back(far * next(), -far * next(), next() / 3);
        spheres.radius.push_back(0.001 + next());
    }
    const SphereTree tree = openvdb_spheretree::givenTree(spheres);
    expectSameTree(fromPoints(*toPoints(tree)), tree);
}

TEST(SphereTreePoints, TheOriginAskedForComesBackAndIsLeftOutByDefault)
{
    SphereTree tree = oneVoxelTree();
    EXPECT_FALSE((*toPoints(tree))["spheretree_pyramid_origin"]);
    tree.settings.pyramid().origin = openvdb::Coord(-8, 0, 1024);
    const SphereTree back = fromPoints(*toPoints(tree));
    EXPECT_EQ(back.settings.pyramid().origin, openvdb::Coord(-8, 0, 1024));
    expectSameTree(back, tree);
}

TEST(SphereTreePoints, ACentreThatAFloatCannotHoldIsAnErrorAndNotRounded)
{
    SphereTree tree = oneVoxelTree();
    const double inf = std::numeric_limits<double>::infinity();
    tree.spheres.center[0] = {1, 2.25, 3};
    EXPECT_TRUE(
        mentions(messageOf<openvdb::ValueError>([&] { toPoints(tree); }), "multiple of 1/2 voxel"));
    tree.subdivision = 16;
    EXPECT_NO_THROW(toPoints(tree));
    tree.spheres.center[0] = {1, 2.03125, 3};
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([&] { toPoints(tree); }), "multiple of 1/16 voxel"));
    tree.subdivision = 2;
    for (double x : {0.1, 1e10, std::nan(""), inf, -inf}) {
        tree.spheres.center[0] = {0, x, 0};
        const std::string why = messageOf<openvdb::ValueError>([&] { toPoints(tree); });
        EXPECT_TRUE(mentions(why, x == 0.1 ? "no multiple of 1/2 voxel" : "which no"));
        EXPECT_TRUE(mentions(why, "node 0 has the position"));
    }
}

TEST(SphereTreePoints, TheGridDoesNotDependOnThreads)
{
    const SphereTree tree = randomTree(30000, 9);
    const std::string bytes = bytesOf(toPoints(tree));
    for (std::size_t threads : {1, 2, 7}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_TRUE(bytesOf(toPoints(tree)) == bytes) << threads << " threads";
    }
}

TEST(SphereTreePoints, ATreeThatIsGivenUpMakesTheSameGridAndIsReleased)
{
    for (const SphereTree& tree : {sampleTree(), tightSampleTree()}) {
        SphereTree given = tree;
        const std::string expected = bytesOf(toPoints(tree));
        EXPECT_TRUE(bytesOf(releaseToPoints(given)) == expected);
        EXPECT_EQ(given.spheres.center.capacity() + given.spheres.radius.capacity()
                + given.spheres.coverRadiusSq.capacity() + given.spheres.radiusWorld.capacity()
                + given.spheres.parent.capacity() + given.ijk.capacity()
                + given.radiusSq.capacity(),
            0u);
        EXPECT_EQ(given.levels.size(), tree.levels.size());
        EXPECT_EQ(given.cuts.size(), tree.cuts.size());
    }
}

TEST(SphereTreePoints, ATreeThatCannotBeWrittenIsNotReleased)
{
    SphereTree given = sampleTree();
    given.spheres.center[0][0] += 0.01;
    EXPECT_THROW(releaseToPoints(given), openvdb::ValueError);
    EXPECT_EQ(given.size(), sampleTree().size());
}

// ---- The grid as other programs see it

TEST(SphereTreePoints, WorldPositionsOfThePointsAreTheCentres)
{
    const SphereTree tree = sampleTree();
    const PointDataGrid::Ptr grid = toPoints(tree);
    int32_t seen = 0;
    for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf) {
        const points::AttributeHandle<openvdb::Vec3f> position(leaf->constAttributeArray("P"));
        const points::AttributeHandle<int32_t> ids(leaf->constAttributeArray("id"));
        for (auto it = leaf->beginIndexOn(); it; ++it, ++seen) {
            const openvdb::Vec3d world = grid->transform().indexToWorld(
                it.getCoord().asVec3d() + openvdb::Vec3d(position.get(*it)));
            EXPECT_LT((world - tree.centerWorld(ids.get(*it))).length(), 1e-9);
        }
    }
    EXPECT_EQ(seen, tree.size());
}

TEST(SphereTreePoints, SeveralPointsShareAVoxel)
{
    const SphereTree tree = randomTree(20000, 10);
    const PointDataGrid::Ptr grid = toPoints(tree);
    EXPECT_GE(uint64_t(tree.size()), 4 * grid->activeVoxelCount());
    const double ratio = grid->transform().voxelSize()[0] / tree.voxelSize();
    EXPECT_EQ(std::exp2(std::round(std::log2(ratio))), ratio);
}

TEST(SphereTreePoints, LevelsAreGroups)
{
    const SphereTree tree = randomTree(3000, 12);
    const PointDataGrid::Ptr grid = toPoints(tree);
    for (const SphereTreeLevel& level : tree.levels) {
        const std::string name = "level_" + std::to_string(level.level);
        const points::GroupFilter filter(name, grid->tree().cbeginLeaf()->attributeSet());
        EXPECT_EQ(points::pointCount(grid->tree(), filter), uint64_t(level.size())) << name;
    }
}

TEST(SphereTreePoints, ATreeOfMoreLevelsThanAGroupByteHoldsComesBack)
{
    SphereTree tree;
    setType(tree.settings, TreeType::Extended);
    tree.transform = math::Transform::createLinearTransform(1.0);
    for (int i = 0; i < 20; ++i) addLevel(tree, 1, 1);
    for (int i = 0; i < 20; ++i) addNode(tree, {0.5, 0.5, 0.5}, {0, 0, 0}, 20 - i, i - 1);
    expectSameTree(fromPoints(*throughFile({toPoints(tree)})[0]), tree);
}

TEST(SphereTreePoints, AttributesAndMetadataHaveTheNamesAndTypesOfTheFormat)
{
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    const auto& descriptor = grid->tree().cbeginLeaf()->attributeSet().descriptor();
    for (const auto& [name, type] :
        std::vector<std::pair<std::string, std::string>>{{"P", "vec3s"}, {"pscale", "float"},
            {"id", "int32"}, {"parent", "int32"}, {"level", "int32"}, {"radius_sq", "int32"},
            {"ijk", "vec3i"}, {"radius", "double"}, {"cover_sq", "int64"}}) {
        ASSERT_NE(descriptor.find(name), points::AttributeSet::INVALID_POS) << name;
        EXPECT_EQ(descriptor.type(descriptor.find(name)), openvdb::NamePair(type, "null")) << name;
    }
    const auto text = [&](const char* key) { return (*grid)[key] ? (*grid)[key]->str() : "none"; };
    EXPECT_EQ(grid->getName(), "sample tree");
    EXPECT_EQ(grid->getGridClass(), openvdb::GRID_UNKNOWN);
    EXPECT_EQ(text("class"), "none") << "tools that take points look for grids without a class";
    EXPECT_EQ(text("spheretree_format"), "1");
    EXPECT_EQ(text("spheretree_tree"), "extended");
    EXPECT_EQ(text("spheretree_factor"), "3");
    EXPECT_EQ(text("spheretree_padding"), "0.1");
    EXPECT_EQ(text("spheretree_source"), "bunny, left ear");
    EXPECT_EQ(text("spheretree_origin"), "[-16, 8, -1024]");
    EXPECT_EQ(text("spheretree_object_voxels"), std::to_string(int64_t(1) << 40));
    EXPECT_EQ(text("spheretree_level_0_spheres"), "5");
    EXPECT_EQ(text("spheretree_level_0_excess"), "5");
    EXPECT_EQ(text("spheretree_topology"), "false");
    EXPECT_EQ(text("spheretree_level_0_components"), "3");
    EXPECT_EQ(text("spheretree_level_0_tunnels"), std::to_string(int64_t(1) << 33));
    EXPECT_EQ(text("spheretree_level_0_cavities"), "2");
    EXPECT_EQ(text("spheretree_level_1_components"), "none");
    EXPECT_EQ(text("spheretree_level_1_covered"), "none");
    EXPECT_EQ(text("spheretree_level_1_error_unknown"), "too many rows");
    EXPECT_EQ(text("spheretree_level_2_pyramid_voxels"), "3");
    EXPECT_EQ(text("spheretree_level_2_error_unknown"), "none");
}

TEST(SphereTreePoints, TheNameOfTheGridIsTheNameOfTheTree)
{
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    grid->setName("renamed");
    EXPECT_EQ(fromPoints(*grid).settings.name, "renamed");
}

TEST(SphereTreePoints, WritingAndReadingStopAtAnyQuestion)
{
    const SphereTree tree = sampleTree();
    const auto roundTrip = [&](openvdb::util::NullInterrupter* stop) {
        const auto nodes = toPoints(tree, stop), dag = dagToPoints(tree, stop);
        expectSameTree(fromPoints(*nodes, dag.get(), nullptr, stop), tree);
    };
    int questions = 0;
    for (bool finished = false; !finished; questions = 1 + questions * 5 / 4) {
        ASSERT_LT(questions, 1000000);
        StopAfter stop(questions);
        try {
            roundTrip(&stop);
            finished = true;
        } catch (const Interrupted&) {}
    }
    EXPECT_GT(questions, 20) << "they hardly ask";
}

TEST(SphereTreePoints, OnlySphereTreesClaimToBeOne)
{
    EXPECT_TRUE(isSphereTree(*toPoints(oneVoxelTree())));
    EXPECT_FALSE(isSphereTree(*dagToPoints(sampleTree())));
    EXPECT_FALSE(isSphereTree(*PointDataGrid::create()));
    const auto mask = openvdb::BoolGrid::create();
    mask->insertMeta("spheretree_format", openvdb::Int32Metadata(1));
    EXPECT_FALSE(isSphereTree(*mask));
}

} // namespace
