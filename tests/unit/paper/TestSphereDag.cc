// SPDX-License-Identifier: Apache-2.0
/// @file TestSphereDag.cc
/// @brief The Sphere-DAG against its definition, voxel by voxel.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/paper/SphereDag.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>

#include "support/BuiltTrees.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>

#include <set>

namespace {

const openvdb_spheretree::LevelQueries kAllLabels{0, {}, true};

using namespace openvdb_spheretree;
using namespace spheretree_test;

using Edges = std::set<std::pair<Coord, Coord>>; ///< centre of the parent, centre of the child

Edges edgesByDefinition(
    const NaiveReference& fine, const NaiveReference& coarse, const PyramidStep& step)
{
    std::map<Coord, Coord> parentLabels;
    for (std::size_t i = 0; i < coarse.voxels().size(); ++i) {
        parentLabels[coarse.voxels()[i]] = coarse.label(i);
    }
    Edges edges;
    for (std::size_t i = 0; i < fine.voxels().size(); ++i) {
        Coord parent = fine.voxels()[i] - step.origin;
        for (int axis = 0; axis < step.dim; ++axis) {
            parent[axis] = int(std::floor(double(parent[axis]) / step.factor));
        }
        const auto label = parentLabels.find(parent);
        if (label != parentLabels.end()) edges.emplace(label->second, fine.label(i));
    }
    return edges;
}

Edges edgesByCentres(
    const std::vector<DagEdge>& edges, const MedialLevel& fine, const MedialLevel& coarse)
{
    Edges result;
    for (const DagEdge& edge : edges) {
        result.emplace(coarse.balls.at(edge.parent).center, fine.balls.at(edge.child).center);
    }
    return result;
}

Coord originOf(const Voxels& voxels) { return boxOf(voxels).min() & ~7; }

/// Checks the DAG between the voxels and those of the next level, given by the caller.
void checkStep(const Voxels& voxels, const Voxels& above, const PyramidStep& step)
{
    const MedialLevel fine(*maskOf(voxels), step.dim, Distance(), nullptr, nullptr, kAllLabels);
    const MedialLevel coarse(*maskOf(above), step.dim, Distance(), nullptr, nullptr, kAllLabels);
    const std::vector<DagEdge> edges = sphereDag(fine, coarse, step);
    EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end()));
    EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
    EXPECT_EQ(edgesByCentres(edges, fine, coarse),
        edgesByDefinition(NaiveReference(voxels, step.dim), NaiveReference(above, step.dim), step));
}

/// The ball of each voxel's label, by 512 leaf + offset; -1 where none was asked for.
std::vector<int32_t> ballsOfLabels(const MedialLevel& level)
{
    const std::size_t size = std::size_t(level.layout.leafCount()) * kLeafVoxels;
    std::vector<int32_t> balls(size, -1), ballAt(size, -1);
    forEachVoxel(level.layout, [&](uint32_t leaf, uint32_t k, const Coord&) {
        const VoxelRef site = level.labels.label(VoxelRef{leaf, k});
        int32_t& ball = ballAt[std::size_t(site.leaf) * kLeafVoxels + site.index];
        if (ball < 0) ball = level.ballAt(level.layout.voxel(site.leaf, site.index));
        balls[std::size_t(leaf) * kLeafVoxels + k] = ball;
    });
    return balls;
}

/// The pair of labels of every voxel, one by one. Labels are the levels' own: NaiveReference.h,
/// which is used above, has none for norms and takes days where balls are large.
std::vector<DagEdge> edgesOfLabels(
    const MedialLevel& fine, const MedialLevel& coarse, const PyramidStep& step)
{
    const std::vector<int32_t> children = ballsOfLabels(fine), parents = ballsOfLabels(coarse);
    std::vector<DagEdge> edges;
    forEachVoxel(fine.layout, [&](uint32_t leaf, uint32_t k, const Coord& voxel) {
        const Coord parent = step.parentVoxel(voxel);
        const auto parentLeaf = coarse.layout.findLeaf(parent);
        if (!parentLeaf || !coarse.layout.mask(*parentLeaf).isOn(leafIndex(parent))) return;
        const std::size_t place = std::size_t(*parentLeaf) * kLeafVoxels + leafIndex(parent);
        const DagEdge edge{parents[place], children[std::size_t(leaf) * kLeafVoxels + k]};
        if (edges.empty() || !(edges.back() == edge)) edges.push_back(edge);
    });
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

Voxels coarsened(const Voxels& voxels, const PyramidStep& step)
{
    return voxelsOf(*coarsen(*maskOf(voxels), step));
}

TEST(SphereDag, HasAnEdgeForEveryVoxelAndAVoxelForEveryEdge)
{
    for (uint32_t seed = 0; seed < 66; ++seed) {
        const RandomObject object = randomObject(seed);
        SCOPED_TRACE(object.name);
        for (int factor : {2, 3, 4, 5}) {
            const PyramidStep first{originOf(object.voxels), factor, 3};
            const PyramidStep second{Coord(0, 0, 0), factor, 3};
            const Voxels level1 = coarsened(object.voxels, first);
            checkStep(object.voxels, level1, first);
            checkStep(level1, coarsened(level1, second), second);
        }
    }
}

TEST(SphereDag, LeavesTheThirdAxisAloneInTwoDimensions)
{
    for (uint32_t seed = 100; seed < 133; ++seed) {
        const RandomObject object = randomObject(seed);
        SCOPED_TRACE(object.name);
        const Voxels voxels = flattened(object.voxels);
        const PyramidStep step{originOf(voxels), 2, 2};
        checkStep(voxels, coarsened(voxels, step), step);
    }
}

TEST(SphereDag, WorksFromAnyOrigin)
{
    for (uint32_t seed = 300; seed < 333; ++seed) {
        const RandomObject object = randomObject(seed);
        SCOPED_TRACE(object.name);
        for (int factor : {2, 3, 5}) {
            const PyramidStep step{originOf(object.voxels).offsetBy(3, -1, 5), factor, 3};
            checkStep(object.voxels, coarsened(object.voxels, step), step);
        }
    }
}

TEST(SphereDag, PassesOverVoxelsWhoseParentIsOff)
{
    for (uint32_t seed = 200; seed < 233; ++seed) {
        const RandomObject object = randomObject(seed);
        SCOPED_TRACE(object.name);
        const PyramidStep step{originOf(object.voxels), 2, 3};
        Voxels kept;
        for (const Coord& voxel : coarsened(object.voxels, step)) {
            if ((voxel[0] + voxel[1] + voxel[2]) % 3 != 0) kept.push_back(voxel);
        }
        if (!kept.empty()) checkStep(object.voxels, kept, step);
    }
}

/// Labels of balls of more than 127 voxels radius are kept in wider steps.
TEST(SphereDag, IsThatOfTheLabelsOfLargeBalls)
{
    const openvdb::MaskTree::Ptr voxels = maskOf(CoordBBox(Coord(-3, 0, 0), Coord(256, 259, 259)));
    voxels->setValueOff(Coord(3, 4, 5));
    const PyramidStep step{Coord(-8, 0, 0), 3, 3};
    const MedialLevel fine(*voxels, 3, Distance(), nullptr, nullptr, kAllLabels);
    const MedialLevel coarse(*coarsen(*voxels, step), 3, Distance(), nullptr, nullptr, kAllLabels);
    ASSERT_NE(fine.labels.wideOffsets(Axis::X, 0), nullptr);
    EXPECT_TRUE(sphereDag(fine, coarse, step) == edgesOfLabels(fine, coarse, step));
}

TEST(SphereDag, IsThatOfTheLabelsOfLargeDisks)
{
    Voxels disk;
    for (const Coord& v : voxelsOfBox(CoordBBox(Coord(-140, -150, 7), Coord(160, 145, 7)))) {
        const int64_t fromCentre = int64_t(v[0]) * v[0] + int64_t(v[1]) * v[1];
        if (fromCentre < 138 * 138 && (v[0] - v[1]) % 61 != 0) disk.push_back(v);
        else if (fromCentre >= 130 * 130 && v[0] > 0) disk.push_back(v);
    }
    const Voxels solid = voxelsOfBox(CoordBBox(Coord(200, -30, 7), Coord(470, 240, 7)));
    disk.insert(disk.end(), solid.begin(), solid.end());
    for (int factor : {2, 3, 4, 5}) {
        const PyramidStep step{Coord(-144, -152, 0), factor, 2};
        const MedialLevel fine(*maskOf(disk), 2, Distance(), nullptr, nullptr, kAllLabels);
        const MedialLevel coarse(
            *maskOf(coarsened(disk, step)), 2, Distance(), nullptr, nullptr, kAllLabels);
        ASSERT_NE(fine.labels.wideOffsets(Axis::X, 0), nullptr);
        EXPECT_TRUE(sphereDag(fine, coarse, step) == edgesOfLabels(fine, coarse, step)) << factor;
    }
}

/// The labels of norms are not kept as steps.
TEST(SphereDag, IsThatOfTheLabelsOfNorms)
{
    for (uint32_t seed = 400; seed < 433; ++seed) {
        const RandomObject object = randomObject(seed);
        SCOPED_TRACE(object.name);
        for (const char* name : {"l1", "linf", "chamfer:3,4,5"}) {
            for (int factor : {2, 3, 4, 5}) {
                const PyramidStep step{originOf(object.voxels), factor, 3};
                const Distance distance = distanceFromString(name);
                const MedialLevel fine(
                    *maskOf(object.voxels), 3, distance, nullptr, nullptr, kAllLabels);
                const MedialLevel coarse(*maskOf(coarsened(object.voxels, step)), 3, distance,
                    nullptr, nullptr, kAllLabels);
                EXPECT_TRUE(sphereDag(fine, coarse, step) == edgesOfLabels(fine, coarse, step));
            }
        }
    }
}

/// Edges by id, level by level, of an object that is flat along @a flat.
std::vector<DagEdge> edgesOfFlatTree(const SphereTree& tree, Voxels voxels, const FlatAxis& flat)
{
    for (Coord& voxel : voxels) voxel = flat.toZ(voxel);
    std::vector<DagEdge> edges;
    PyramidStep step{flat.toZ(tree.origin), tree.settings.pyramid().factor, 2};
    for (std::size_t k = 0; k + 1 < tree.levels.size(); ++k) {
        const Voxels above = coarsened(voxels, step);
        std::map<Coord, int32_t> parents, children; // ids by centre
        const auto fill = [&](const SphereTreeLevel& level, std::map<Coord, int32_t>& ids) {
            for (int32_t id = level.begin; id < level.end; ++id) ids[flat.toZ(tree.ijk[id])] = id;
        };
        fill(tree.levels[k + 1], parents);
        fill(tree.levels[k], children);
        for (const auto& [parent, child] :
            edgesByDefinition(NaiveReference(voxels, 2), NaiveReference(above, 2), step)) {
            edges.push_back({parents.at(parent), children.at(child)});
        }
        voxels = above;
        step.origin = Coord();
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

TEST(SphereDag, OfATreeOfAFlatObjectIsThatOfItsPlane)
{
    for (uint32_t seed = 500; seed < 533; ++seed) {
        const RandomObject object = randomObject(seed);
        for (int axis = 0; axis < 3; ++axis) {
            Voxels voxels = flattened(object.voxels);
            for (Coord& voxel : voxels) voxel = FlatAxis(axis).fromZ(voxel + Coord(-3, 5, 13));
            SphereTreeSettings settings;
            setType(settings, TreeType::Reversible);
            settings.dim = 2;
            settings.pyramid().factor = 2 + int(seed % 4);
            settings.pyramid().dag = true;
            const SphereTree tree = buildSphereTree(*gridOf(voxels), settings);
            const FlatAxis flat(tree.flatAxis);
            EXPECT_TRUE(tree.dag == edgesOfFlatTree(tree, voxels, flat))
                << object.name << " axis " << axis;
        }
    }
}

TEST(SphereDag, IsEmptyWhereNoParentIsOn)
{
    const MedialLevel fine(
        *maskOf(shapes::box(Coord(4, 4, 4))), 3, Distance(), nullptr, nullptr, kAllLabels);
    const MedialLevel coarse(
        *maskOf(Voxels{Coord(100, 0, 0)}), 3, Distance(), nullptr, nullptr, kAllLabels);
    EXPECT_TRUE(sphereDag(fine, coarse, {Coord(0, 0, 0), 2, 3}).empty());
}

TEST(SphereDag, StopsWhenInterrupted)
{
    const MedialLevel fine(
        *maskOf(shapes::box(Coord(9, 9, 9))), 3, Distance(), nullptr, nullptr, kAllLabels);
    const MedialLevel coarse(
        *maskOf(shapes::box(Coord(5, 5, 5))), 3, Distance(), nullptr, nullptr, kAllLabels);
    StopAfter now;
    EXPECT_THROW(sphereDag(fine, coarse, {Coord(0, 0, 0), 2, 3}, &now), Interrupted);
}

} // namespace
