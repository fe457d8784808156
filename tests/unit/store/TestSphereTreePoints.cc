// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/store/SphereTreePoints.h>

#include "support/Messages.h"
#include "support/SampleTrees.h"

#include <openvdb/io/Stream.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointConversion.h>
#include <openvdb/points/PointCount.h>
#include <openvdb/points/PointGroup.h>

#include <gtest/gtest.h>

#include <functional>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

using namespace openvdb_spheretree;
using namespace spheretree_test;
namespace math = openvdb::math;
namespace points = openvdb::points;
using openvdb::points::PointDataGrid;

namespace {

std::string testFile()
{
    const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    return (std::filesystem::temp_directory_path() / ("spheretree_" + name + ".vdb")).string();
}

/// Writes the grids to a file as people do, and reads them back.
std::vector<PointDataGrid::Ptr> throughFile(const openvdb::GridCPtrVec& grids)
{
    openvdb::initialize();
    const std::string path = testFile();
    openvdb::io::File out(path);
    out.setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
    out.write(grids);
    out.close();

    std::vector<PointDataGrid::Ptr> read;
    openvdb::io::File in(path);
    in.open(/*delayLoad=*/false);
    const openvdb::GridPtrVec stored = *in.getGrids();
    for (const openvdb::GridBase::Ptr& grid : stored) {
        read.push_back(openvdb::gridPtrCast<PointDataGrid>(grid));
    }
    in.close();
    std::filesystem::remove(path);
    return read;
}

/// The grid as bytes, without the random number that every file starts with.
std::string bytesOf(const PointDataGrid::Ptr& grid)
{
    std::ostringstream out(std::ios::binary);
    openvdb::io::Stream stream(out);
    stream.write(openvdb::GridCPtrVec{grid});
    constexpr std::size_t kUuidBegin = 21, kUuidSize = 36;
    return out.str().erase(kUuidBegin, kUuidSize);
}

/// Sets an attribute of the node with that id.
template <typename T>
void damage(PointDataGrid& grid, const char* attribute, int32_t id, const T& value)
{
    for (auto leaf = grid.tree().beginLeaf(); leaf; ++leaf) {
        const points::AttributeHandle<int32_t> ids(leaf->constAttributeArray("id"));
        std::vector<openvdb::Index> found;
        for (openvdb::Index n = 0; n < ids.size(); ++n) {
            if (ids.get(n) == id) found.push_back(n);
        }
        points::AttributeWriteHandle<T> handle(leaf->attributeArray(attribute));
        for (openvdb::Index n : found) handle.set(n, value);
    }
}

std::string whyDamaged(const PointDataGrid& grid, const PointDataGrid* dag = nullptr)
{
    const std::string why = messageOf<openvdb::ValueError>([&] { fromPoints(grid, dag); });
    EXPECT_TRUE(mentions(why, "'" + grid.getName())) << "the message must name the grid";
    return why;
}

/// What fromPoints() says of the sample tree after one value of one node was changed.
template <typename T>
std::string whyDamaged(const char* attribute, int32_t id, const T& value)
{
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    damage<T>(*grid, attribute, id, value);
    return whyDamaged(*grid);
}

template <typename T>
std::string whyDamagedMeta(const char* key, const T& value)
{
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    grid->removeMeta(key);
    grid->insertMeta(key, openvdb::TypedMetadata<T>(value));
    return whyDamaged(*grid);
}

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

} // namespace

// ---- Round trips

TEST(SphereTreePoints, EveryFieldComesBackFromMemory)
{
    for (const SphereTree& tree :
        {sampleTree(), oneVoxelTree(), randomTree(1, 1), randomTree(5000, 2)}) {
        expectSameTree(fromPoints(*toPoints(tree), dagToPoints(tree).get()), tree);
    }
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
            tree.settings.tree = type;
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
    tree.settings.center = Center::Miniball;
    expectSameTree(fromPoints(*toPoints(tree)), tree);
    tree.settings.center = Center::Medial;
    tree.settings.tree = TreeType::Tight;
    tree.settings.budget.branching = 5;
    tree.settings.budget.error = 1.0 / 3;
    expectSameTree(fromPoints(*toPoints(tree)), tree);
    tree.settings.budget = {};
    tree.settings.budget.distance = 1e-300;
    tree.settings.quality = Quality::Fast;
    expectSameTree(fromPoints(*toPoints(tree)), tree);
}

TEST(SphereTreePoints, ATightTreeWithItsCutsComesBack)
{
    const SphereTree tree = tightSampleTree();
    const PointDataGrid::Ptr nodes = toPoints(tree), cuts = cutsToPoints(tree);
    EXPECT_TRUE(isCutsOf(*cuts, "tight tree"));
    EXPECT_FALSE(isCutsOf(*cuts, "tight"));
    EXPECT_FALSE(isCutsOf(*nodes, "tight tree"));
    EXPECT_FALSE(isSphereTree(*cuts));
    EXPECT_FALSE(isDagOf(*cuts, "tight tree"));
    expectSameTree(fromPoints(*nodes, nullptr, cuts.get()), tree);
    const auto grids = throughFile({nodes, cuts});
    ASSERT_EQ(grids.size(), 2u);
    const bool inOrder = isSphereTree(*grids[0]);
    expectSameTree(
        fromPoints(*grids[inOrder ? 0 : 1], nullptr, grids[inOrder ? 1 : 0].get()), tree);
}

TEST(SphereTreePoints, ATreeReadWithoutItsCutsSaysThatItHasNone)
{
    const SphereTree read = fromPoints(*toPoints(tightSampleTree()));
    EXPECT_TRUE(read.cuts.empty());
    EXPECT_FALSE(read.settings.cuts);
    EXPECT_EQ(read.subdivision, 16);
    EXPECT_FALSE(cutsToPoints(read));
}

TEST(SphereTreePoints, AFileFromBeforeTightTreesIsReadAsItWas)
{
    SphereTree tree = randomTree(50, 3);
    fillDescription(tree);
    tree.settings.dag = false; // without a grid of edges
    const PointDataGrid::Ptr grid = toPoints(tree);
    for (const char* key : {"subdivision", "quality", "spheres", "branching", "cover", "leaves",
             "side", "cuts", "center"}) {
        EXPECT_TRUE((*grid)["spheretree_" + std::string(key)]) << key;
        grid->removeMeta("spheretree_" + std::string(key));
    }
    expectSameTree(fromPoints(*grid), tree);
}

TEST(SphereTreePoints, CentresFarOutAndBetweenVoxelsAreExact)
{
    SphereTree tree = oneVoxelTree();
    tree.subdivision = 16;
    for (double far : {0.0, 1e6, -1e9, 2e9}) {
        for (double part : {0.5, -0.5, 0.25, 1.0 / 16, -15.0 / 16}) {
            tree.center[0] = openvdb::Vec3d(far + part, -far - part, part);
            EXPECT_EQ(fromPoints(*toPoints(tree)).center[0], tree.center[0]);
        }
    }
    tree = randomTree(2000, 6);
    tree.subdivision = 16;
    for (openvdb::Vec3d& center : tree.center) center += openvdb::Vec3d(1e9, 0.0625, -0.4375);
    EXPECT_EQ(fromPoints(*toPoints(tree)).center, tree.center);
}

TEST(SphereTreePoints, ACentreThatAFloatCannotHoldIsAnErrorAndNotRounded)
{
    SphereTree tree = oneVoxelTree();
    const double inf = std::numeric_limits<double>::infinity();
    tree.center[0] = {1, 2.25, 3};
    EXPECT_TRUE(
        mentions(messageOf<openvdb::ValueError>([&] { toPoints(tree); }), "multiple of 1/2 voxel"));
    tree.subdivision = 16;
    EXPECT_NO_THROW(toPoints(tree));
    tree.center[0] = {1, 2.03125, 3};
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([&] { toPoints(tree); }), "multiple of 1/16 voxel"));
    tree.subdivision = 2;
    for (double x : {0.1, 1e10, std::nan(""), inf, -inf}) {
        tree.center[0] = {0, x, 0};
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

// ---- The grid as other programs see it

TEST(SphereTreePoints, ATreeThatIsGivenUpMakesTheSameGridAndIsReleased)
{
    for (const SphereTree& tree : {sampleTree(), tightSampleTree()}) {
        SphereTree given = tree;
        const std::string expected = bytesOf(toPoints(tree));
        EXPECT_TRUE(bytesOf(toPoints(std::move(given))) == expected);
        EXPECT_EQ(given.center.capacity() + given.radius.capacity() + given.coverSq.capacity()
                + given.radiusWorld.capacity() + given.parent.capacity() + given.ijk.capacity()
                + given.radiusSq.capacity(),
            0u);
        EXPECT_EQ(given.levels.size(), tree.levels.size());
        EXPECT_EQ(given.cuts.size(), tree.cuts.size());
    }
}

TEST(SphereTreePoints, ATreeThatCannotBeWrittenIsNotReleased)
{
    SphereTree given = sampleTree();
    given.center[0][0] += 0.01;
    EXPECT_THROW(toPoints(std::move(given)), openvdb::ValueError);
    EXPECT_EQ(given.size(), sampleTree().size());
}

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
    tree.settings.tree = TreeType::Extended;
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
    EXPECT_EQ(text("spheretree_tree"), "reversible");
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

TEST(SphereTreePoints, OnlySphereTreesClaimToBeOne)
{
    EXPECT_TRUE(isSphereTree(*toPoints(oneVoxelTree())));
    EXPECT_FALSE(isSphereTree(*dagToPoints(sampleTree())));
    EXPECT_FALSE(isSphereTree(*PointDataGrid::create()));
    const auto mask = openvdb::BoolGrid::create();
    mask->insertMeta("spheretree_format", openvdb::Int32Metadata(1));
    EXPECT_FALSE(isSphereTree(*mask));
}

// ---- The DAG

TEST(SphereTreePoints, ATreeWithoutEdgesHasNoDagGrid) { EXPECT_FALSE(dagToPoints(oneVoxelTree())); }

TEST(SphereTreePoints, TheDagGridIsNamedAfterTheTreeAndHoldsAPointAnEdge)
{
    const SphereTree tree = sampleTree();
    const PointDataGrid::Ptr dag = dagToPoints(tree);
    EXPECT_EQ(dag->getName(), "sample tree_dag");
    EXPECT_EQ(points::pointCount(dag->tree()), tree.dag.size());
}

TEST(SphereTreePoints, WithoutItsDagGridATreeHasNoEdges)
{
    const SphereTree tree = fromPoints(*toPoints(sampleTree()));
    EXPECT_TRUE(tree.dag.empty());
    EXPECT_EQ(tree.size(), sampleTree().size());
}

TEST(SphereTreePoints, ADagOfAnotherTreeIsAnError)
{
    const PointDataGrid::Ptr dag = dagToPoints(sampleTree());
    const std::string why =
        messageOf<openvdb::ValueError>([&] { fromPoints(*toPoints(oneVoxelTree()), dag.get()); });
    EXPECT_TRUE(mentions(why, "sample tree_dag"));
    EXPECT_TRUE(mentions(why, "8 nodes"));
}

/// Puts @a edge in the place of the first one that is another.
static void replaceOneEdge(PointDataGrid& dag, const DagEdge& edge)
{
    for (auto leaf = dag.tree().beginLeaf(); leaf; ++leaf) {
        points::AttributeWriteHandle<int32_t> parents(leaf->attributeArray("parent"));
        points::AttributeWriteHandle<int32_t> children(leaf->attributeArray("child"));
        for (openvdb::Index n = 0; n < parents.size(); ++n) {
            if (parents.get(n) == edge.parent && children.get(n) == edge.child) continue;
            parents.set(n, edge.parent);
            children.set(n, edge.child);
            return;
        }
    }
}

TEST(SphereTreePoints, ADagEdgeThatSkipsALevelOrRepeatsIsAnError)
{
    for (const DagEdge& edge : {DagEdge{0, 3}, DagEdge{1, 2}, DagEdge{3, 1}, DagEdge{0, 8},
             DagEdge{0, -1}, DagEdge{0, 1}}) {
        SphereTree tree = sampleTree();
        const PointDataGrid::Ptr points = toPoints(tree), dag = dagToPoints(tree);
        replaceOneEdge(*dag, edge);
        const std::string read =
            messageOf<openvdb::ValueError>([&] { fromPoints(*points, dag.get()); });
        EXPECT_TRUE(mentions(read, "damaged Sphere-DAG"));
        EXPECT_TRUE(mentions(read, "from node " + std::to_string(edge.parent) + " to node "));
        tree.dag.push_back(edge);
        const std::string write = messageOf<openvdb::ValueError>([&] { dagToPoints(tree); });
        EXPECT_TRUE(mentions(write, "from node " + std::to_string(edge.parent) + " to node "));
    }
    const PointDataGrid::Ptr points = toPoints(sampleTree());
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { fromPoints(*points, points.get()); }),
        "spheretree_dag_format"));
}

TEST(SphereTreePoints, ADagEdgeFromANodeThatDoesNotExistIsAnError)
{
    const SphereTree tree = sampleTree();
    const PointDataGrid::Ptr points = toPoints(tree);
    for (int32_t parent : {-1, 8, 1 << 30, std::numeric_limits<int32_t>::min()}) {
        const PointDataGrid::Ptr dag = dagToPoints(tree);
        for (auto leaf = dag->tree().beginLeaf(); leaf; ++leaf) {
            points::AttributeWriteHandle<int32_t> parents(leaf->attributeArray("parent"));
            for (openvdb::Index n = 0; n < parents.size(); ++n) parents.set(n, parent);
        }
        const std::string why =
            messageOf<openvdb::ValueError>([&] { fromPoints(*points, dag.get()); });
        EXPECT_TRUE(mentions(why, "from node " + std::to_string(parent) + " to node "));
    }
}

TEST(SphereTreePoints, ADagThatWasCutShortIsAnError)
{
    const SphereTree tree = sampleTree();
    const PointDataGrid::Ptr points = toPoints(tree), dag = dagToPoints(tree);
    dag->removeMeta("spheretree_edges");
    dag->insertMeta("spheretree_edges", openvdb::Int32Metadata(int32_t(tree.dag.size()) + 1));
    const std::string why = messageOf<openvdb::ValueError>([&] { fromPoints(*points, dag.get()); });
    EXPECT_TRUE(mentions(why, "9 edges of 8 nodes are expected"));
}

TEST(SphereTreePoints, DagEdgesComeBackSortedWhereverTheirPointsAre)
{
    SphereTree tree = sampleTree();
    std::reverse(tree.center.begin(), tree.center.end());
    const PointDataGrid::Ptr points = toPoints(tree), dag = dagToPoints(tree);
    EXPECT_EQ(fromPoints(*points, dag.get()).dag, tree.dag);
}

// ---- Damage

/// What fromPoints() says of the tight sample tree after one value of its cuts was changed.
template <typename T>
static std::string whyCutsDamaged(const char* attribute, int32_t id, const T& value)
{
    const PointDataGrid::Ptr grid = toPoints(tightSampleTree());
    const PointDataGrid::Ptr cuts = cutsToPoints(tightSampleTree());
    damage<T>(*cuts, attribute, id, value);
    const std::string why =
        messageOf<openvdb::ValueError>([&] { fromPoints(*grid, nullptr, cuts.get()); });
    EXPECT_TRUE(mentions(why, "'tight tree_cuts' is a damaged list of cuts"));
    return why;
}

TEST(SphereTreePoints, DamagedCutsAreErrorsThatNameTheNode)
{
    using Int = int32_t;
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("id", 3, 2), "two points have the id 2"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("id", 3, 6), "there is an id 6"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("parent", 3, 2), "node 3 has the parent 2"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("parent", 3, 3), "node 3 has the parent 3"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("parent", 3, 6), "node 3 has the parent 6"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("parent", 3, -2), "node 3 has the parent -2"));
    EXPECT_TRUE(
        mentions(whyCutsDamaged<Int>("parent", 0, 5), "its parent 5 begins with that of 1"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("first", 2, 0), "cuts of 0 to 4"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("first", 2, 5), "cuts of 5 to 4"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("first", 2, 2), "the cut of 2 spheres has 3"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("last", 2, 3), "node 2 has no child"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("last", 2, 1 << 30), "of 1073741824 spheres, but"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("last", 5, 0), "its parent 5 begins with that of 0"));
    EXPECT_TRUE(mentions(whyCutsDamaged<Int>("last", 4, 4), "node 0 ends with the cut of 4"));
    EXPECT_TRUE(mentions(whyCutsDamaged<double>("radius", 1, -1.0), "node 1 has the radius -1"));
    EXPECT_TRUE(mentions(whyCutsDamaged<float>("pscale", 1, -1.f), "node 1 has the pscale -1"));
    EXPECT_TRUE(mentions(whyCutsDamaged<int64_t>("cover_sq", 1, -1), "node 1 has the cover_sq -1"));
    SphereTree coarse = tightSampleTree();
    for (openvdb::Vec3d& center : coarse.center) center *= 16;
    coarse.subdivision = 2;
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { cutsToPoints(coarse); }),
        "cannot be stored: in its cuts, node 0 has the position"));
}

TEST(SphereTreePoints, CutsOfAnotherTreeOrCutShortAreAnError)
{
    const SphereTree tree = tightSampleTree();
    const PointDataGrid::Ptr points = toPoints(tree), cuts = cutsToPoints(tree);
    const auto why = [&] {
        return messageOf<openvdb::ValueError>([&] { fromPoints(*points, nullptr, cuts.get()); });
    };
    cuts->insertMeta("spheretree_nodes", openvdb::Int32Metadata(5));
    EXPECT_TRUE(mentions(why(), "beside a tree of 5 nodes"));
    cuts->insertMeta("spheretree_nodes", openvdb::Int32Metadata(4));
    EXPECT_NO_THROW(fromPoints(*points, nullptr, cuts.get()));
    cuts->insertMeta("spheretree_cuts_nodes", openvdb::Int32Metadata(7));
    EXPECT_TRUE(mentions(why(), "7 spheres beside 4 nodes are expected"));
    cuts->insertMeta("spheretree_cuts_format", openvdb::Int32Metadata(kPointsFormat + 1));
    EXPECT_TRUE(mentions(why(), "update openvdb_spheretree"));
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([&] { fromPoints(*points, nullptr, points.get()); }),
        "spheretree_cuts_format"));
}

TEST(SphereTreePoints, OrdinaryPointsAreNoSphereTree)
{
    openvdb::initialize();
    const auto grid = points::createPointDataGrid<points::NullCodec, PointDataGrid>(
        std::vector<openvdb::Vec3d>{{1, 2, 3}}, *math::Transform::createLinearTransform(1.0));
    grid->setName("dust");
    EXPECT_TRUE(mentions(whyDamaged(*grid), "is no sphere-tree"));
}

TEST(SphereTreePoints, ANewerFormatIsAnErrorThatSaysToUpdate)
{
    const std::string why = whyDamagedMeta<int32_t>("spheretree_format", 2);
    EXPECT_TRUE(mentions(why, "format 2"));
    EXPECT_TRUE(mentions(why, "update"));
    EXPECT_FALSE(mentions(why, "damaged"));
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_format", 0), "damaged"));
    EXPECT_TRUE(mentions(whyDamagedMeta<std::string>("spheretree_format", "1"), "type string"));
}

TEST(SphereTreePoints, AMissingAttributeIsNamed)
{
    for (const char* name :
        {"pscale", "id", "parent", "level", "radius_sq", "ijk", "radius", "cover_sq"}) {
        const PointDataGrid::Ptr grid = toPoints(sampleTree());
        points::dropAttribute(grid->tree(), name);
        EXPECT_TRUE(mentions(whyDamaged(*grid), "no attribute '" + std::string(name) + "'"));
    }
}

TEST(SphereTreePoints, AnAttributeOfAnotherTypeIsNamed)
{
    for (const char* name :
        {"pscale", "id", "parent", "level", "radius_sq", "ijk", "radius", "cover_sq"}) {
        const PointDataGrid::Ptr grid = toPoints(sampleTree());
        points::dropAttribute(grid->tree(), name);
        points::appendAttribute<int16_t>(grid->tree(), name);
        EXPECT_TRUE(
            mentions(whyDamaged(*grid), "attribute '" + std::string(name) + "' is of type"));
    }
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    points::dropAttribute(grid->tree(), "pscale");
    points::appendAttribute<float, points::TruncateCodec>(grid->tree(), "pscale");
    EXPECT_TRUE(mentions(whyDamaged(*grid), "float/trnc"));
    points::dropAttribute(grid->tree(), "pscale");
    points::appendAttribute<float>(grid->tree(), "pscale", 1.0f, /*stride=*/3);
    EXPECT_TRUE(mentions(whyDamaged(*grid), "3 values a point"));
}

TEST(SphereTreePoints, CompressedPositionsAreAnError)
{
    SphereTree tree = oneVoxelTree();
    tree.center[0] = {0, 0, 0};
    const PointDataGrid::Ptr grid = toPoints(tree);
    const auto lossy = points::createPointDataGrid<points::FixedPointCodec<false>, PointDataGrid>(
        std::vector<openvdb::Vec3d>{{0, 0, 0}}, grid->transform());
    lossy->insertMeta(*grid);
    points::appendAttribute<int32_t>(lossy->tree(), "id", 0);
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { fromPoints(*lossy); }), "'P'"));
}

TEST(SphereTreePoints, IdsThatAreNotEachOfThePossibleOnesOnceAreAnError)
{
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("id", 3, 4), "two points have the id 4"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("id", 3, 8), "there is an id 8"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("id", 3, -1), "there is an id -1"));
    const int32_t lowest = std::numeric_limits<int32_t>::min();
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("id", 3, lowest), "id -2147483648"));
}

TEST(SphereTreePoints, AParentThatDoesNotExistIsAnErrorThatNamesNodeAndParent)
{
    for (int32_t parent : {8, -2, -1, 1 << 30}) {
        const std::string why = whyDamaged<int32_t>("parent", 5, parent);
        EXPECT_TRUE(mentions(why, "node 5"));
        EXPECT_TRUE(mentions(why, "parent " + std::to_string(parent)));
        EXPECT_TRUE(mentions(why, "must be a node of the next level up"));
    }
    const std::string why = whyDamaged<int32_t>("parent", 0, -2);
    EXPECT_TRUE(mentions(why, "the top level has no parents"));
}

TEST(SphereTreePoints, AParentThatIsNotOnTheNextLevelUpIsAnError)
{
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("parent", 5, 0), "on level 2"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("parent", 5, 4), "on level 0"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("parent", 5, 5), "node 5")) << "its own parent";
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("parent", 1, 3), "node 1")) << "a cycle of 1 and 3";
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("parent", 0, 1), "top level")) << "a root with parent";
}

TEST(SphereTreePoints, ALevelThatIsMissingOrOutOfOrderIsAnError)
{
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("level", 0, 3), "level 3"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("level", 0, -1), "level -1"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("level", 0, 1), "level 1 has 3 nodes"));
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    damage<int32_t>(*grid, "level", 1, 0);
    damage<int32_t>(*grid, "level", 3, 1);
    EXPECT_TRUE(mentions(whyDamaged(*grid), "node 2 is on level 1"));
}

TEST(SphereTreePoints, RadiiThatNoSphereHasAreErrorsThatNameTheNode)
{
    const double inf = std::numeric_limits<double>::infinity();
    for (double bad : {std::nan(""), inf, -inf, -1.0}) {
        EXPECT_TRUE(mentions(whyDamaged<float>("pscale", 4, float(bad)), "node 4 has the pscale"));
        EXPECT_TRUE(mentions(whyDamaged<double>("radius", 4, bad), "node 4 has the radius"));
    }
    EXPECT_TRUE(mentions(whyDamaged<int64_t>("cover_sq", 4, -1), "node 4 has the cover_sq -1"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("radius_sq", 4, 0), "node 4 has the radius_sq 0"));
    EXPECT_TRUE(mentions(whyDamaged<int32_t>("radius_sq", 4, -2), "node 4 has the radius_sq -2"));
    EXPECT_TRUE(
        mentions(whyDamaged<openvdb::Vec3f>("P", 4, openvdb::Vec3f(0, float(std::nan("")), 0)),
            "node 4 has the position"));
}

TEST(SphereTreePoints, AnEmptyGridIsNotMistakenForATree)
{
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    grid->clear();
    EXPECT_TRUE(mentions(whyDamaged(*grid), "0 points, by its metadata 8"));
}

static int expectMissingMetadataIsNamed(const SphereTree& tree)
{
    const PointDataGrid::Ptr complete = toPoints(tree);
    const bool tight = tree.settings.tree == TreeType::Tight;
    int keys = 0;
    for (auto it = complete->beginMeta(); it != complete->endMeta(); ++it) {
        const std::string key = it->first;
        const bool optional = key == "spheretree_level_1_error_unknown"
            || key == "spheretree_level_0_covered" || key == "spheretree_level_0_components"
            || key == "spheretree_topology" || key == "spheretree_dist" || key == "spheretree_model"
            || (!tight && (key == "spheretree_quality" || key == "spheretree_subdivision"))
            || key.rfind("spheretree_", 0) != 0;
        if (optional || key == "spheretree_format") continue;
        const PointDataGrid::Ptr grid = toPoints(tree);
        grid->removeMeta(key);
        EXPECT_TRUE(mentions(whyDamaged(*grid), "'" + key + "'"));
        ++keys;
    }
    return keys;
}

TEST(SphereTreePoints, MissingMetadataIsNamed)
{
    SphereTree coarse = sampleTree(); // without its subdivision it is one in halves
    for (openvdb::Vec3d& center : coarse.center) center *= 8;
    EXPECT_GE(expectMissingMetadataIsNamed(coarse), 25);
    EXPECT_GE(expectMissingMetadataIsNamed(tightSampleTree()), 30);
}

TEST(SphereTreePoints, AFileFromBeforeTopologyWasCountedHasNone)
{
    SphereTree tree = sampleTree();
    tree.dag.clear(); // which is a grid of its own
    tree.settings.dag = false;
    tree.settings.topology = true;
    const PointDataGrid::Ptr grid = toPoints(tree);
    for (const char* key :
        {"topology", "level_0_components", "level_0_tunnels", "level_0_cavities"}) {
        grid->removeMeta("spheretree_" + std::string(key));
    }
    tree.settings.topology = false;
    tree.levels[0].topology.reset();
    expectSameTree(fromPoints(*grid), tree);
}

TEST(SphereTreePoints, MetadataOutOfRangeIsAnError)
{
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_factor", 1), "factor=1"));
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_dim", 4), "dim=4"));
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_subdivision", 3), "units of 1/3"));
    EXPECT_TRUE(
        mentions(whyDamagedMeta<std::string>("spheretree_spheres", "8,x"), "spheres='8,x'"));
    EXPECT_TRUE(mentions(whyDamagedMeta<std::string>("spheretree_side", "left"), "side='left'"));
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_branching", 1), "branching=1"));
    EXPECT_TRUE(mentions(whyDamagedMeta<bool>("spheretree_cuts", true), "cuts"));
    EXPECT_TRUE(mentions(whyDamagedMeta<std::string>("spheretree_tree", "oak"), "tree='oak'"));
    EXPECT_TRUE(mentions(whyDamagedMeta<std::string>("spheretree_padding", "x"), "padding='x'"));
    EXPECT_TRUE(mentions(whyDamagedMeta<bool>("spheretree_factor", true), "of type bool"));
    for (int32_t scale : {0, -1, 3, 8192}) {
        EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_point_scale", scale), "power of"));
    }
    for (int32_t count : {0, -1, 4, 1 << 30}) {
        EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_levels", count),
            count == 4 ? "level_3" : "it has " + std::to_string(count) + " levels"));
    }
    for (int32_t lowest : {-1, 1025}) {
        const PointDataGrid::Ptr grid = toPoints(oneLevelOf(sampleTree(), 0));
        grid->insertMeta("spheretree_lowest_level", openvdb::Int32Metadata(lowest));
        EXPECT_TRUE(mentions(whyDamaged(*grid), "from level " + std::to_string(lowest) + " on"));
    }
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_levels", 2), "by its metadata 7"));
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_lowest_level", 1), "from level 1 on"));
    EXPECT_TRUE(mentions(whyDamagedMeta<int32_t>("spheretree_level_0_spheres", 0), "level 0"));
    for (int32_t above : {0, 2}) { // three spheres stand on the levels above
        const int32_t spheres = std::numeric_limits<int32_t>::max() - above;
        EXPECT_TRUE(mentions(
            whyDamagedMeta<int32_t>("spheretree_level_0_spheres", spheres), "more than 2^31"));
    }
}

TEST(SphereTreePoints, AFrustumIsNoTransformOfATree)
{
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    grid->setTransform(math::Transform::createFrustumTransform(
        openvdb::BBoxd(openvdb::Vec3d(0), openvdb::Vec3d(10)), 0.5, 10.0, 1.0));
    EXPECT_TRUE(mentions(whyDamaged(*grid), "its transform is a frustum"));
}

TEST(SphereTreePoints, AMessageStaysOnOneShortLine)
{
    const std::string junk = std::string(100000, 'x') + "\n\n";
    const std::string why = whyDamagedMeta<std::string>("spheretree_tree", junk);
    EXPECT_LT(why.size(), 600u);
    EXPECT_EQ(why.find('\n'), std::string::npos);
}

TEST(SphereTreePoints, ATreeThatContradictsItselfIsNotWritten)
{
    const auto why = [](const SphereTree& tree) {
        return messageOf<openvdb::ValueError>([&] { toPoints(tree); });
    };
    EXPECT_TRUE(mentions(why(SphereTree()), "no nodes"));
    SphereTree tree = sampleTree();
    tree.subdivision = 4;
    EXPECT_TRUE(mentions(why(tree), "units of 1/4"));
    tree = sampleTree();
    tree.radius.pop_back();
    EXPECT_TRUE(mentions(why(tree), "length"));
    tree = sampleTree();
    tree.coverSq.pop_back();
    EXPECT_TRUE(mentions(why(tree), "length"));
    tree = sampleTree();
    tree.radiusWorld.push_back(1);
    EXPECT_TRUE(mentions(why(tree), "length"));
    tree = sampleTree();
    tree.parent.pop_back();
    EXPECT_TRUE(mentions(why(tree), "length"));
    tree = sampleTree();
    tree.ijk.pop_back();
    EXPECT_TRUE(mentions(why(tree), "length"));
    tree = sampleTree();
    tree.radiusSq.pop_back();
    EXPECT_TRUE(mentions(why(tree), "length"));
    tree = oneLevelOf(sampleTree(), 1);
    tree.levels[0].level = -1;
    EXPECT_TRUE(mentions(why(tree), "start at 0"));
    tree = sampleTree();
    for (SphereTreeLevel& level : tree.levels) ++level.level;
    EXPECT_TRUE(mentions(why(tree), "start at 0"));
    tree = sampleTree();
    tree.levels[1].end = 2;
    EXPECT_TRUE(mentions(why(tree), "divide")) << "node 2 is on no level";
    tree = sampleTree();
    tree.levels[1].begin = tree.levels[1].end = tree.levels[0].begin;
    tree.levels[2].end = tree.levels[0].begin;
    EXPECT_TRUE(mentions(why(tree), "divide")) << "level 1 is empty";
    tree = sampleTree();
    tree.transform.reset();
    EXPECT_TRUE(mentions(why(tree), "transform"));
    tree = sampleTree();
    tree.levels[1].level = 2;
    EXPECT_TRUE(mentions(why(tree), "levels"));
    tree = sampleTree();
    tree.levels.pop_back();
    EXPECT_TRUE(mentions(why(tree), "levels"));
    tree = sampleTree();
    tree.settings.factor = 1;
    EXPECT_TRUE(mentions(why(tree), "factor=1"));
    for (int32_t parent : {-1, 8, 99}) {
        tree = sampleTree();
        tree.dag.push_back({parent, 1});
        EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>([&] { dagToPoints(tree); }), "DAG"));
    }
}

TEST(SphereTreePoints, ATreeReadWithoutItsEdgesSaysThatItHasNone)
{
    const SphereTree tree = sampleTree();
    ASSERT_TRUE(tree.settings.dag);
    const SphereTree read = fromPoints(*toPoints(tree));
    EXPECT_TRUE(read.dag.empty());
    EXPECT_FALSE(read.settings.dag);
}

TEST(SphereTreePoints, WhatCouldNotBeReadBackIsNotWritten)
{
    const auto expectRefused = [](const std::function<void(SphereTree&)>& damage) {
        SphereTree tree = sampleTree();
        ASSERT_NO_THROW(toPoints(tree));
        damage(tree);
        EXPECT_THROW(toPoints(tree), openvdb::ValueError);
    };
    expectRefused([](SphereTree& t) { t.radiusWorld[2] = std::numeric_limits<float>::infinity(); });
    expectRefused([](SphereTree& t) { t.coverSq[2] = std::numeric_limits<int64_t>::max(); });
    expectRefused([](SphereTree& t) { t.center[2][1] = 1e10; });
    expectRefused([](SphereTree& t) { t.radius[2] = -1; });
    expectRefused([](SphereTree& t) { t.parent[5] = 1 << 30; });
    expectRefused([](SphereTree& t) { t.parent[5] = 4; });
    expectRefused([](SphereTree& t) { t.radiusSq[2] = 0; });
}
