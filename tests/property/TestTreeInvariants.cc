// SPDX-License-Identifier: Apache-2.0
/// @file TestTreeInvariants.cc
/// @brief What holds for every sphere-tree, each by its own test: on random objects with every
/// combination of settings, and on real ones (SPHERETREE_DATA).

#include "support/BuiltTrees.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/input/vol/VolFile.h>

#include <tbb/global_control.h>

#include <cstdlib>
#include <functional>
#include <numeric>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// An object, and the grid it came in.
struct Object {
    std::string name;
    openvdb::BoolGrid::Ptr grid;
    Voxels voxels;
};

std::vector<Object> randomObjects(uint32_t firstSeed, uint32_t count)
{
    std::vector<Object> objects;
    for (const RandomObject& object : someObjects(firstSeed, count)) {
        objects.push_back({object.name, gridOf(object.voxels), object.voxels});
    }
    return objects;
}

/// Empty where the data are missing.
std::vector<Object> realObjects()
{
    const char* folder = std::getenv("SPHERETREE_DATA");
    if (!folder) return {};
    openvdb::initialize();
    std::vector<Object> objects;
    for (const char* name : {"Al.100", "dragon-128"}) {
        const auto path = std::string(folder) + "/vol/" + name + ".vol";
        const auto grid = objectOf(*readVolFile(path));
        openvdb::MaskTree mask(grid->tree(), false, openvdb::TopologyCopy());
        objects.push_back({name, grid, voxelsOf(mask)});
    }
    return objects;
}

/// Types and paddings, for objects that are too large for every combination.
std::vector<SphereTreeSettings> someSettings()
{
    std::vector<SphereTreeSettings> all = bothTypes();
    for (SphereTreeSettings settings : bothTypes()) {
        settings.pyramid().factor = 3;
        settings.pyramid().parent = ParentRule::Dag;
        if (auto* options = settings.find<ExtendedOptions>()) options->finalFit = false;
        settings.padding = 0;
        all.push_back(settings);
    }
    return all;
}

using Check = std::function<void(const Object&, const SphereTreeSettings&, const SphereTree&)>;

/// Builds every tree of every object and hands it on, until one fails.
void forEachTree(const std::vector<Object>& objects,
    const std::vector<SphereTreeSettings>& allOfThem, const Check& check)
{
    for (const Object& object : objects) {
        for (const SphereTreeSettings& settings : allOfThem) {
            SCOPED_TRACE(object.name + ": " + describe(settings));
            check(object, settings, buildSphereTree(*object.grid, settings));
            if (testing::Test::HasFailure()) return;
        }
    }
}

/// A world that rounds: voxels of 0.1, turned, far from the origin.
openvdb::math::Transform::Ptr roughTransform()
{
    const auto transform = openvdb::math::Transform::createLinearTransform(0.1);
    transform->postRotate(0.7, openvdb::math::X_AXIS);
    transform->postRotate(-1.1, openvdb::math::Z_AXIS);
    transform->postTranslate(openvdb::Vec3d(1e5, -1e5, 1e5 / 3));
    return transform;
}

std::vector<Object> inRoughWorld(std::vector<Object> objects)
{
    for (Object& object : objects) object.grid->setTransform(roughTransform());
    return objects;
}

std::vector<SphereTreeSettings> withPadding(std::vector<SphereTreeSettings> all, double padding)
{
    for (SphereTreeSettings& settings : all) settings.padding = padding;
    return all;
}

/// The object's voxels in a dense box, struck off as spheres are found to hold them.
class Remaining {
public:
    explicit Remaining(const Voxels& voxels)
        : mBox(boxOf(voxels)), mLeft(std::size_t(mBox.volume()), false), mCount(voxels.size())
    {
        for (const Coord& voxel : voxels) mLeft[index(voxel)] = true;
    }

    /// Strikes off the voxels within @a reach of @a center for which @a held( voxel ).
    template <typename Held>
    void strike(const openvdb::Vec3d& center, double reach, const Held& held)
    {
        CoordBBox box(Coord::floor(center - reach), Coord::ceil(center + reach));
        box.intersect(mBox);
        for (auto voxel = box.begin(); voxel; ++voxel) {
            const std::size_t i = index(*voxel);
            if (!mLeft[i] || !held(*voxel)) continue;
            mLeft[i] = false;
            --mCount;
        }
    }

    std::size_t count() const { return mCount; }

private:
    std::size_t index(const Coord& voxel) const
    {
        const Coord at = voxel - mBox.min(), size = mBox.dim();
        return (std::size_t(at[0]) * size[1] + at[1]) * size[2] + at[2];
    }

    CoordBBox mBox;
    std::vector<bool> mLeft;
    std::size_t mCount;
};

void expectNoVoxelMissed(const Object& object, const SphereTree& tree,
    const std::function<bool(int32_t, const Coord&)>& held)
{
    for (const SphereTreeLevel& level : tree.levels) {
        Remaining remaining(object.voxels);
        for (int32_t id = level.begin; id < level.end && remaining.count() > 0; ++id) {
            remaining.strike(tree.spheres.center[id], tree.spheres.radius[id] + 1,
                [&](const Coord& voxel) { return held(id, voxel); });
        }
        ASSERT_EQ(remaining.count(), 0u) << "voxels missed by level " << level.level;
    }
}

/// The digital balls of level 0 have the object's voxels and no others.
void checkLevel0(const Object& object, const SphereTreeSettings&, const SphereTree& tree)
{
    const SphereTreeLevel& level = tree.levels[0];
    ASSERT_EQ(level.level, 0);
    const openvdb::BoolTree& voxels = object.grid->constTree();
    openvdb::tree::ValueAccessor<const openvdb::BoolTree> accessor(voxels);
    Remaining remaining(object.voxels);
    for (int32_t id = level.begin; id < level.end; ++id) {
        const int reach = int(std::sqrt(double(tree.radiusSq[id])));
        CoordBBox box(tree.ijk[id], tree.ijk[id]);
        box.expand(reach);
        for (auto voxel = box.begin(); voxel; ++voxel) {
            const bool inBall = squaredDistance(*voxel, tree.ijk[id]) < tree.radiusSq[id];
            ASSERT_EQ(holds(tree, id, *voxel), inBall) << "coverSq and radius_sq disagree";
            ASSERT_TRUE(!inBall || accessor.isValueOn(*voxel)) << *voxel << " is no object voxel";
        }
        remaining.strike(tree.spheres.center[id], tree.spheres.radius[id] + 1,
            [&](const Coord& q) { return squaredDistance(q, tree.ijk[id]) < tree.radiusSq[id]; });
    }
    ASSERT_EQ(remaining.count(), 0u);
}

void checkExactCover(const Object& object, const SphereTreeSettings&, const SphereTree& tree)
{
    expectNoVoxelMissed(
        object, tree, [&](int32_t id, const Coord& voxel) { return holds(tree, id, voxel); });
}

/// As a user would find it: world positions and stored radii, in doubles.
bool holdsInWorld(const SphereTree& tree, int32_t id, const openvdb::Vec3d& index)
{
    const openvdb::Vec3d at = tree.transform->indexToWorld(index);
    return (at - tree.centerWorld(id)).length() <= double(tree.spheres.radiusWorld[id]);
}

void checkStoredCoverOfCentres(
    const Object& object, const SphereTreeSettings&, const SphereTree& tree)
{
    expectNoVoxelMissed(object, tree,
        [&](int32_t id, const Coord& voxel) { return holdsInWorld(tree, id, voxel.asVec3d()); });
}

void checkStoredCoverOfCubes(
    const Object& object, const SphereTreeSettings&, const SphereTree& tree)
{
    expectNoVoxelMissed(object, tree, [&](int32_t id, const Coord& voxel) {
        for (int corner = 0; corner < 8; ++corner) {
            const openvdb::Vec3d to(corner & 1, corner >> 1 & 1, corner >> 2);
            const openvdb::Vec3d at = voxel.asVec3d() + to - openvdb::Vec3d(0.5);
            if (!holdsInWorld(tree, id, at)) return false;
        }
        return true;
    });
}

void checkParents(const Object&, const SphereTreeSettings&, const SphereTree& tree)
{
    ASSERT_EQ(tree.root().size(), 1);
    for (std::size_t k = 0; k < tree.levels.size(); ++k) {
        const bool top = k + 1 == tree.levels.size();
        for (int32_t id = tree.levels[k].begin; id < tree.levels[k].end; ++id) {
            const int32_t parent = tree.spheres.parent[id];
            if (top) {
                ASSERT_EQ(parent, -1);
            } else {
                ASSERT_GE(parent, tree.levels[k + 1].begin);
                ASSERT_LT(parent, tree.levels[k + 1].end);
            }
        }
    }
}

void checkChildren(const Object&, const SphereTreeSettings&, const SphereTree& tree)
{
    std::vector<bool> hasChild(tree.spheres.parent.size(), false);
    for (int32_t parent : tree.spheres.parent) {
        if (parent >= 0) hasChild[parent] = true;
    }
    for (int32_t id = 0; id < tree.levels[0].begin; ++id) ASSERT_TRUE(hasChild[id]) << id;
}

void checkStoredContainment(const Object&, const SphereTreeSettings&, const SphereTree& tree)
{
    for (int32_t leaf = tree.levels[0].begin; leaf < tree.levels[0].end; ++leaf) {
        const openvdb::Vec3d center = tree.centerWorld(leaf);
        for (int32_t id = tree.spheres.parent[leaf]; id >= 0; id = tree.spheres.parent[id]) {
            const double reach =
                (center - tree.centerWorld(id)).length() + tree.spheres.radiusWorld[leaf];
            ASSERT_LE(reach, double(tree.spheres.radiusWorld[id]))
                << "leaf " << leaf << ", node " << id;
        }
    }
}

TEST(TreeInvariants, Level0RebuildsTheObjectExactly)
{
    forEachTree(randomObjects(0, 66), allSettings(), checkLevel0);
}

TEST(TreeInvariants, NoLevelMissesAVoxel)
{
    forEachTree(randomObjects(100, 66), allSettings(), checkExactCover);
}

TEST(TreeInvariants, NoLevelMissesAVoxelInStoredFloats)
{
    forEachTree(randomObjects(200, 66), withPadding(allSettings(), 0), checkStoredCoverOfCentres);
}

TEST(TreeInvariants, NoLevelMissesAVoxelInStoredFloatsInARoughWorld)
{
    forEachTree(inRoughWorld(randomObjects(200, 66)), withPadding(allSettings(), 0),
        checkStoredCoverOfCentres);
}

TEST(TreeInvariants, PaddedForCubesNoLevelMissesAPartOfAVoxelInStoredFloats)
{
    const auto settings = withPadding(allSettings(), SphereTreeSettings::kPadCubes);
    forEachTree(randomObjects(300, 44), settings, checkStoredCoverOfCubes);
    forEachTree(inRoughWorld(randomObjects(300, 44)), settings, checkStoredCoverOfCubes);
}

TEST(TreeInvariants, EveryNodeButTheRootHasOneParentOnTheNextLevel)
{
    forEachTree(randomObjects(400, 66), allSettings(), checkParents);
}

TEST(TreeInvariants, EveryInnerNodeOfAnExtendedTreeHasAChild)
{
    forEachTree(randomObjects(500, 66), allSettings(TreeType::Extended, 3), checkChildren);
}

TEST(TreeInvariants, EveryAncestorContainsEveryLeafBallBelowInStoredFloats)
{
    const auto extended = allSettings(TreeType::Extended, 3);
    for (double padding : {SphereTreeSettings::kPadCubes, 0.0}) {
        const auto settings = withPadding(extended, padding);
        forEachTree(randomObjects(600, 44), settings, checkStoredContainment);
        forEachTree(inRoughWorld(randomObjects(600, 44)), settings, checkStoredContainment);
    }
}

TEST(TreeInvariants, HoldOnRealObjects)
{
    const std::vector<Object> objects = realObjects();
    if (objects.empty()) GTEST_SKIP() << "needs SPHERETREE_DATA";
    forEachTree(objects, someSettings(),
        [](const Object& object, const SphereTreeSettings& settings, const SphereTree& tree) {
            ASSERT_NO_FATAL_FAILURE(checkLevel0(object, settings, tree));
            ASSERT_NO_FATAL_FAILURE(checkExactCover(object, settings, tree));
            ASSERT_NO_FATAL_FAILURE(checkStoredCoverOfCentres(object, settings, tree));
            ASSERT_NO_FATAL_FAILURE(checkParents(object, settings, tree));
            if (settings.padding < 0) {
                ASSERT_NO_FATAL_FAILURE(checkStoredCoverOfCubes(object, settings, tree));
            }
            if (settings.type() == TreeType::Reversible) return;
            ASSERT_NO_FATAL_FAILURE(checkChildren(object, settings, tree));
            ASSERT_NO_FATAL_FAILURE(checkStoredContainment(object, settings, tree));
        });
}

TEST(TreeInvariants, HoldOnRealObjectsInARoughWorld)
{
    const std::vector<Object> objects = inRoughWorld(realObjects());
    if (objects.empty()) GTEST_SKIP() << "needs SPHERETREE_DATA";
    forEachTree(objects, withPadding(bothTypes(), 0),
        [](const Object& object, const SphereTreeSettings& settings, const SphereTree& tree) {
            ASSERT_NO_FATAL_FAILURE(checkStoredCoverOfCentres(object, settings, tree));
            if (settings.type() == TreeType::Reversible) return;
            ASSERT_NO_FATAL_FAILURE(checkStoredContainment(object, settings, tree));
        });
}

void expectSameForOneAndTwoThreads(
    const std::vector<Object>& objects, const std::vector<SphereTreeSettings>& allOfThem)
{
    using Control = tbb::global_control;
    for (const Object& object : objects) {
        for (const SphereTreeSettings& settings : allOfThem) {
            SCOPED_TRACE(object.name + ": " + describe(settings));
            SphereTree one, two;
            {
                const Control threads(Control::max_allowed_parallelism, 1);
                one = buildSphereTree(*object.grid, settings);
            }
            {
                const Control threads(Control::max_allowed_parallelism, 2);
                two = buildSphereTree(*object.grid, settings);
            }
            ASSERT_TRUE(sameNodes(one, two));
        }
    }
}

TEST(TreeInvariants, OneAndTwoThreadsGiveTheSameTree)
{
    expectSameForOneAndTwoThreads(randomObjects(700, 22), allSettings());
    std::vector<SphereTreeSettings> withDag = someSettings();
    for (SphereTreeSettings& settings : withDag) settings.pyramid().dag = true;
    Random random(1);
    const Voxels large = shapes::noise(Coord(70, 60, 50), 0.7, random);
    expectSameForOneAndTwoThreads({{"large noise", gridOf(large), large}}, withDag);
    expectSameForOneAndTwoThreads(realObjects(), someSettings());
}

TEST(TreeInvariants, TranslationByMultiplesOfEightCarriesTheTreeAlong)
{
    const std::vector<Coord> shifts{Coord(8, 0, 0), Coord(-8, 16, -24), Coord(-4096, 128, 1 << 20)};
    for (const Object& object : randomObjects(800, 33)) {
        for (const SphereTreeSettings& settings : allSettings()) {
            const Coord& by =
                shifts[settings.pyramid().factor % 2 + int(settings.pyramid().parent)];
            SCOPED_TRACE(object.name + ": " + describe(settings));
            SphereTree tree = buildSphereTree(*object.grid, settings);
            const SphereTree moved =
                buildSphereTree(*gridOf(translated(object.voxels, by)), settings);
            for (openvdb::Vec3d& center : tree.spheres.center) center += by.asVec3d();
            for (int32_t id = tree.levels[0].begin; id < tree.size(); ++id) tree.ijk[id] += by;
            ASSERT_EQ(moved.origin, tree.origin + by);
            // World radii make up for the rounding of positions, which may differ.
            for (int32_t id = 0; id < tree.size(); ++id) {
                ASSERT_NEAR(moved.spheres.radiusWorld[id], tree.spheres.radiusWorld[id],
                    1e-6 * tree.spheres.radiusWorld[id]);
            }
            tree.spheres.radiusWorld = moved.spheres.radiusWorld;
            ASSERT_TRUE(sameNodes(moved, tree));
        }
    }
}

/// Which balls label a tie depends on the order of the axes; sizes do not.
TEST(TreeInvariants, PermutingTheAxesPermutesThePyramidAndKeepsTheLargestBalls)
{
    for (const Object& object : randomObjects(900, 44)) {
        SCOPED_TRACE(object.name);
        Voxels permuted;
        for (const Coord& v : object.voxels) permuted.emplace_back(v[2], v[0], v[1]);
        SphereTreeSettings settings;
        setType(settings, TreeType::Reversible);
        const SphereTree a = buildSphereTree(*object.grid, settings);
        const SphereTree b = buildSphereTree(*gridOf(permuted), settings);
        for (std::size_t k = 0; k < std::min(a.levels.size(), b.levels.size()); ++k) {
            const auto largest = [k](const SphereTree& tree) {
                const SphereTreeLevel& level = tree.levels[k];
                return *std::max_element(
                    tree.radiusSq.begin() + level.begin, tree.radiusSq.begin() + level.end);
            };
            ASSERT_EQ(a.levels[k].pyramidVoxels, b.levels[k].pyramidVoxels);
            ASSERT_EQ(largest(a), largest(b));
        }
    }
}

TEST(TreeInvariants, TilesAndTheSameVoxelsWrittenOutGiveTheSameTree)
{
    for (const RandomObject& object : someObjects(1000, 22)) {
        auto tiled = maskOf(object.voxels);
        const Coord corner = boxOf(object.voxels).min() & ~7;
        tiled->fill(CoordBBox(corner, corner + Coord(31, 23, 15)), true); // whole leaves
        tiled->prune();
        ASSERT_GT(tiled->activeTileCount(), 0);
        const auto written = std::make_shared<openvdb::MaskTree>(*tiled);
        written->voxelizeActiveTiles();
        ASSERT_EQ(written->activeTileCount(), 0);
        for (const SphereTreeSettings& settings : someSettings()) {
            ASSERT_TRUE(sameNodes(buildSphereTree(*gridOf(*tiled), settings),
                buildSphereTree(*gridOf(*written), settings)))
                << object.name << ": " << describe(settings);
        }
    }
}

/// A solid cube of tiles, and the same written out; its low corner is at @a corner.
void expectTilesLikeVoxels(
    int side, const Coord& corner, const std::vector<SphereTreeSettings>& allOfThem)
{
    const auto tiled = maskOf(CoordBBox::createCube(corner, side));
    ASSERT_GT(tiled->activeTileCount(), 0);
    const auto written = std::make_shared<openvdb::MaskTree>(*tiled);
    written->voxelizeActiveTiles();
    for (const SphereTreeSettings& settings : allOfThem) {
        SCOPED_TRACE(describe(settings));
        const SphereTree tree = buildSphereTree(*gridOf(*tiled), settings);
        ASSERT_EQ(tree.object.voxels, int64_t(side) * side * side);
        ASSERT_TRUE(sameNodes(tree, buildSphereTree(*gridOf(*written), settings)));
        ASSERT_TRUE(endsAtOneRoot(tree));
    }
}

TEST(TreeInvariants, ABlockOfTilesGivesTheTreeOfTheSameBlockWrittenOut)
{
    expectTilesLikeVoxels(128, Coord(0, 0, 0), someSettings());
    expectTilesLikeVoxels(128, Coord(-128, 128, 0), bothTypes());
    expectTilesLikeVoxels(96, Coord(-16, 40, 120), bothTypes());
}

TEST(TreeInvariants, ABlockOfTilesOf512GivesTheTreeOfTheSameBlockWrittenOut)
{
    expectTilesLikeVoxels(512, Coord(-128, 0, 256), {extendedTree()});
}

/// Per voxel of a level: the ids of its label and of its parent voxel's label are an edge; and
/// every edge comes from a voxel.
void checkDag(const Object& object, const SphereTreeSettings& settings, const SphereTree& tree)
{
    const auto pyramid = naiveOrPyramid(object.voxels, settings.pyramid().factor);
    std::set<std::pair<int32_t, int32_t>> witnessed;
    std::map<Coord, int32_t> above; // id of the label of each voxel of the level above
    for (int k = int(tree.levels.size()) - 1; k >= 0; --k) {
        const SphereTreeLevel& level = tree.levels[k];
        const NaiveReference naive(Voxels(pyramid[k].begin(), pyramid[k].end()));
        std::map<Coord, int32_t> idAt, labels;
        for (int32_t id = level.begin; id < level.end; ++id) idAt[tree.ijk[id]] = id;
        for (std::size_t i = 0; i < naive.voxels().size(); ++i) {
            const Coord& voxel = naive.voxels()[i];
            labels[voxel] = idAt.at(naive.label(i));
            if (above.empty()) continue;
            Coord parent = k == 0 ? voxel - tree.origin : voxel;
            for (int axis = 0; axis < 3; ++axis)
                parent[axis] /= settings.pyramid().factor; // not negative
            witnessed.emplace(above.at(parent), labels[voxel]);
        }
        above = labels;
    }
    std::set<std::pair<int32_t, int32_t>> edges;
    for (const DagEdge& edge : tree.dag) edges.emplace(edge.parent, edge.child);
    ASSERT_EQ(edges.size(), tree.dag.size()) << "an edge is there twice";
    ASSERT_EQ(edges, witnessed);
}

TEST(TreeInvariants, EveryDagEdgeIsWitnessedByAVoxelAndEveryVoxelsLabelsAreAnEdge)
{
    forEachTree(randomObjects(1100, 33), allSettings(TreeType::Reversible, 3), checkDag);
}

} // namespace
