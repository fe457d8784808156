// SPDX-License-Identifier: Apache-2.0
/// @file TestMiniballCenters.cc
/// @brief Trees with center=miniball: what is below a node lies inside it, exactly and in stored
/// floats; nothing but spheres has changed; and they are about as small as they can be.

#include "support/BuiltTrees.h"
#include "support/Messages.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/paper/IntersectionDag.h>

#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

SphereTreeSettings miniballs(SphereTreeSettings settings)
{
    settings.pyramid().center = Center::Miniball;
    return settings;
}

/// Both types with factors 2 and 3, both parent rules, and models; fitted.
std::vector<SphereTreeSettings> medialSettings(int dim = 3)
{
    std::vector<SphereTreeSettings> all;
    for (const TreeType type : {TreeType::Reversible, TreeType::Extended}) {
        for (const SphereTreeSettings& settings : allSettings(type, dim)) {
            if (optionsOr<ExtendedOptions>(settings).finalFit) all.push_back(settings);
        }
    }
    all.push_back(all.back());
    all.back().pyramid().closing = 2;
    return all;
}

using Twice = std::pair<SphereTree, SphereTree>; ///< medial, miniball

template <typename Check>
void forEachPair(const std::vector<RandomObject>& objects, int dim, const Check& check)
{
    for (const RandomObject& object : objects) {
        const Voxels voxels = dim == 2 ? flattened(object.voxels) : object.voxels;
        for (const SphereTreeSettings& settings : medialSettings(dim)) {
            SCOPED_TRACE(object.name + ": " + describe(settings));
            const auto grid = gridOf(voxels);
            check(voxels, buildSphereTree(*grid, settings),
                buildSphereTree(*grid, miniballs(settings)));
            if (testing::Test::HasFatalFailure()) return;
        }
    }
}

using Wide = __int128;

/// 16 times a coordinate of a centre; fails if that is no integer.
int64_t sixteenths(double x)
{
    EXPECT_EQ(16 * x, std::floor(16 * x));
    return std::llround(16 * x);
}

/// sqrt(D) >= sqrt(a) + sqrt(b), in integers.
bool atLeastSum(Wide D, Wide a, Wide b)
{
    return D >= a + b && (D - a - b) * (D - a - b) >= 4 * a * b;
}

Wide apartSq(const SphereTree& tree, int32_t s, int32_t t)
{
    Wide sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const Wide d =
            sixteenths(tree.spheres.center[s][axis]) - sixteenths(tree.spheres.center[t][axis]);
        sum += d * d;
    }
    return sum;
}

/// Calls f(leaf, node above it).
template <typename F>
void forEachAncestor(const SphereTree& tree, const F& f)
{
    for (int32_t leaf = tree.levels[0].begin; leaf < tree.levels[0].end; ++leaf) {
        for (int32_t t = tree.spheres.parent[leaf]; t >= 0; t = tree.spheres.parent[t]) f(leaf, t);
    }
}

bool holdsFine(const SphereTree& tree, int32_t id, const Coord& q)
{
    int64_t sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int64_t d = 16 * int64_t(q[axis]) - sixteenths(tree.spheres.center[id][axis]);
        sum += d * d;
    }
    return sum <= tree.spheres.coverRadiusSq[id];
}

void expectCovered(const Voxels& voxels, const SphereTree& tree)
{
    for (const SphereTreeLevel& level : tree.levels) {
        for (const Coord& voxel : voxels) {
            int32_t id = level.begin;
            while (id < level.end && !holdsFine(tree, id, voxel)) ++id;
            ASSERT_LT(id, level.end) << "level " << level.level << " misses " << voxel;
        }
    }
}

TEST(MiniballCenters, ContainEveryLeafBallBelowAndNoMore)
{
    forEachPair(
        someObjects(0, 22), 3, [](const Voxels&, const SphereTree&, const SphereTree& tree) {
            ASSERT_EQ(tree.subdivision, 16);
            std::vector<bool> tight(tree.spheres.center.size(), false); // some leaf needs that much
            forEachAncestor(tree, [&](int32_t leaf, int32_t t) {
                const Wide a = apartSq(tree, leaf, t), b = 256 * (Wide(tree.radiusSq[leaf]) - 1);
                // coverSq is the largest integer that the exact square holds
                ASSERT_TRUE(atLeastSum(Wide(tree.spheres.coverRadiusSq[t]) + 1, a, b))
                    << leaf << " in " << t;
                const double reach = std::sqrt(double(a)) + std::sqrt(double(b));
                ASSERT_GE(16 * tree.spheres.radius[t], reach * (1 - 1e-15));
                if (atLeastSum(Wide(tree.spheres.coverRadiusSq[t]) - 1, a, b)) return;
                tight[t] = tight[t] || 16 * tree.spheres.radius[t] <= reach * (1 + 1e-12);
            });
            forEachAncestor(tree, [&](int32_t, int32_t t) {
                ASSERT_TRUE(tight[t]) << "node " << t << " is larger than what is below needs";
            });
        });
}

TEST(MiniballCenters, LeaveEverythingButSpheresAsItWas)
{
    forEachPair(
        someObjects(100, 11), 3, [](const Voxels&, const SphereTree& medial, SphereTree tree) {
            std::vector<bool> hasLeaves(tree.spheres.center.size(), false);
            forEachAncestor(tree, [&](int32_t, int32_t t) { hasLeaves[t] = true; });
            for (int32_t id = 0; id < tree.size(); ++id) {
                if (hasLeaves[id]) continue; // leaves and the childless: the same in finer units
                ASSERT_EQ(tree.spheres.center[id], medial.spheres.center[id]);
                ASSERT_EQ(tree.spheres.radius[id], medial.spheres.radius[id]);
                for (const Coord& q : {medial.ijk[id], Coord::round(medial.spheres.center[id])}) {
                    for (int x = 0; x < 40; ++x) {
                        const Coord at = q.offsetBy(x, x / 3, -x / 2);
                        ASSERT_EQ(holdsFine(tree, id, at), holds(medial, id, at));
                    }
                }
            }
            tree.spheres.center = medial.spheres.center;
            tree.spheres.radius = medial.spheres.radius;
            tree.spheres.coverRadiusSq = medial.spheres.coverRadiusSq;
            tree.spheres.radiusWorld = medial.spheres.radiusWorld;
            ASSERT_TRUE(sameNodes(tree, medial));
        });
}

TEST(MiniballCenters, CoverTheObjectAtEveryLevel)
{
    forEachPair(someObjects(200, 11), 3,
        [](const Voxels& voxels, const SphereTree&, const SphereTree& tree) {
            ASSERT_NO_FATAL_FAILURE(expectCovered(voxels, tree));
        });
}

TEST(MiniballCenters, OfExtendedTreesAreNeverLargerThanAroundTheMedialCentre)
{
    int smaller = 0, all = 0;
    forEachPair(someObjects(300, 22), 3,
        [&](const Voxels&, const SphereTree& medial, const SphereTree& tree) {
            if (tree.settings.type() != TreeType::Extended) return;
            for (int32_t id = 0; id < tree.levels[0].begin; ++id) {
                ASSERT_LE(tree.spheres.radius[id], medial.spheres.radius[id]);
                smaller += tree.spheres.radius[id] < medial.spheres.radius[id] - 0.1;
                ++all;
            }
        });
    EXPECT_GT(smaller, all / 3);
}

/// From no other point of a fine grid around the centre do all leaves come nearer than rounding
/// explains: the farthest reach is convex, so then it is so from anywhere.
TEST(MiniballCenters, AreAsSmallAsRoundingAllows)
{
    forEachPair(
        someObjects(400, 11), 3, [](const Voxels&, const SphereTree&, const SphereTree& tree) {
            std::vector<std::vector<int32_t>> below(tree.spheres.center.size());
            forEachAncestor(tree, [&](int32_t leaf, int32_t t) { below[t].push_back(leaf); });
            for (int32_t t = 0; t < tree.levels[0].begin; ++t) {
                for (int i = 0; i < 27 && !below[t].empty(); ++i) {
                    const Vec3d step(i / 9 - 1, i / 3 % 3 - 1, i % 3 - 1);
                    double most = 0;
                    for (const int32_t leaf : below[t]) {
                        const Vec3d from = tree.spheres.center[t] + 0.25 * step;
                        most = std::max(most,
                            (tree.spheres.center[leaf] - from).length()
                                + tree.spheres.radius[leaf]);
                    }
                    ASSERT_GE(most, tree.spheres.radius[t] - std::sqrt(3.0) / 32 - 1e-9);
                }
            }
        });
}

TEST(MiniballCenters, InTwoDimensionsStayInThePlaneWhateverItsAxis)
{
    for (const RandomObject& object : someObjects(500, 11)) {
        const Voxels flat = flattened(object.voxels);
        for (int axis = 0; axis < 3; ++axis) {
            Voxels turned;
            for (const Coord& v : flat) {
                turned.push_back(axis == 2 ? v
                        : axis == 1        ? Coord(v[0], v[2], v[1])
                                           : Coord(v[2], v[0], v[1]));
            }
            for (const SphereTreeSettings& settings : medialSettings(2)) {
                SCOPED_TRACE(object.name + ": " + describe(settings));
                const SphereTree tree = buildSphereTree(*gridOf(turned), miniballs(settings));
                const int along = tree.flatAxis;
                for (const Vec3d& center : tree.spheres.center) {
                    ASSERT_EQ(center[along], double(boxOf(turned).min()[along]));
                }
                ASSERT_NO_FATAL_FAILURE(expectCovered(turned, tree));
            }
        }
    }
}

TEST(MiniballCenters, ContainStoredLeavesInARoughWorld)
{
    const auto transform = openvdb::math::Transform::createLinearTransform(0.1);
    transform->postRotate(0.7, openvdb::math::X_AXIS);
    transform->postTranslate(Vec3d(1e5, -1e5, 1e5 / 3));
    for (const RandomObject& object : someObjects(600, 11)) {
        const auto grid = gridOf(object.voxels);
        grid->setTransform(transform->copy());
        for (const double padding : {SphereTreeSettings::kPadCubes, 0.0}) {
            for (SphereTreeSettings settings : medialSettings()) {
                settings.padding = padding;
                const SphereTree tree = buildSphereTree(*grid, miniballs(settings));
                forEachAncestor(tree, [&](int32_t leaf, int32_t t) {
                    const double apart = (tree.centerWorld(leaf) - tree.centerWorld(t)).length();
                    ASSERT_LE(apart + double(tree.spheres.radiusWorld[leaf]),
                        double(tree.spheres.radiusWorld[t]))
                        << object.name << ": " << describe(settings);
                });
            }
        }
    }
}

TEST(MiniballCenters, AreTheSameForAnyNumberOfThreads)
{
    using Control = tbb::global_control;
    Random random(1);
    const auto grid = gridOf(shapes::noise(Coord(60, 50, 40), 0.7, random));
    for (const SphereTreeSettings& settings : bothTypes()) {
        std::vector<SphereTree> trees;
        for (const std::size_t threads : {1, 2, 5}) {
            const Control control(Control::max_allowed_parallelism, threads);
            trees.push_back(buildSphereTree(*grid, miniballs(settings)));
        }
        EXPECT_TRUE(sameNodes(trees[0], trees[1]));
        EXPECT_TRUE(sameNodes(trees[0], trees[2]));
    }
}

/// Which spheres meet is measured in the tree's own units.
TEST(MiniballCenters, IntersectionEdgesAreThoseOfTheNewSpheres)
{
    forEachPair(
        someObjects(700, 11), 3, [](const Voxels&, const SphereTree&, const SphereTree& tree) {
            std::vector<DagEdge> expected;
            for (std::size_t k = 1; k < tree.levels.size(); ++k) {
                for (int32_t t = tree.levels[k].begin; t < tree.levels[k].end; ++t) {
                    for (int32_t s = tree.levels[k - 1].begin; s < tree.levels[k - 1].end; ++s) {
                        const double reach = std::sqrt(double(tree.spheres.coverRadiusSq[s]))
                            + std::sqrt(double(tree.spheres.coverRadiusSq[t]));
                        const double apart = std::sqrt(double(apartSq(tree, s, t)));
                        if (apart <= reach * (1 + 1e-14)) expected.push_back({t, s});
                    }
                }
            }
            std::sort(expected.begin(), expected.end());
            ASSERT_EQ(intersectionDag(tree), expected);
        });
}

TEST(MiniballCenters, OfOneLevelKeepItsUnits)
{
    const SphereTree tree =
        buildSphereTree(*gridOf(randomObject(9).voxels), miniballs(extendedTree()));
    EXPECT_EQ(keepLevel(tree, 1).subdivision, 16);
}

TEST(MiniballCenters, OfObjectsTooWideForTheirUnitsAreRefused)
{
    SphereTreeSettings settings = extendedTree();
    settings.topology = false;
    const Voxels wide{Coord(0, 0, 0), Coord(1 << 27, 0, 0)};
    EXPECT_NO_THROW(buildSphereTree(*gridOf(wide), settings));
    EXPECT_TRUE(mentions(messageOf<openvdb::ValueError>(
                             [&] { buildSphereTree(*gridOf(wide), miniballs(settings)); }),
        "too wide for center=miniball"));
    const Voxels fits{Coord(0, 0, 0), Coord(1 << 24, 0, 0)};
    const SphereTree tree = buildSphereTree(*gridOf(fits), miniballs(settings));
    EXPECT_EQ(tree.spheres.center[0], Vec3d(1 << 23, 0, 0));
    EXPECT_EQ(tree.spheres.radius[0], double(1 << 23));
}

} // namespace
