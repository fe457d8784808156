// SPDX-License-Identifier: Apache-2.0
/// @file TestSphereDag.cc
/// @brief The Sphere-DAG against its definition, voxel by voxel.

#include <openvdb_spheretree/SphereDag.h>

#include "../support/BuiltTrees.h"

#include <openvdb_spheretree/Interrupted.h>

#include <set>

namespace {

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
    const MedialLevel fine(*maskOf(voxels), step.dim, Distance(), nullptr);
    const MedialLevel coarse(*maskOf(above), step.dim, Distance(), nullptr);
    const std::vector<DagEdge> edges = sphereDag(fine, coarse, step);
    EXPECT_TRUE(std::is_sorted(edges.begin(), edges.end()));
    EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
    EXPECT_EQ(edgesByCentres(edges, fine, coarse),
        edgesByDefinition(NaiveReference(voxels, step.dim), NaiveReference(above, step.dim), step));
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
        for (int factor : {2, 3}) {
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

/// Labels of balls of more than 127 voxels radius are kept in wider steps. The reference, one by
/// one, would take a day: here labels are looked up in the levels themselves.
TEST(SphereDag, IsThatOfTheLabelsOfLargeBalls)
{
    openvdb::MaskTree::Ptr voxels = maskOf(CoordBBox(Coord(-3, 0, 0), Coord(268, 259, 260)));
    voxels->setValueOff(Coord(3, 4, 5));
    const PyramidStep step{Coord(-8, 0, 0), 3, 3};
    const MedialLevel fine(*voxels, 3, Distance(), nullptr), coarse(*coarsen(*voxels, step), 3, Distance(), nullptr);
    ASSERT_NE(fine.labels.wideSteps(Axis::X, 0), nullptr);
    std::set<std::pair<int32_t, int32_t>> expected;
    forEachVoxel(fine.layout, [&](uint32_t leaf, uint32_t k, const Coord& voxel) {
        if ((voxel[1] + voxel[2]) % 7 != 0) return; // some of them
        const PowerMap::Voxel site = fine.labels.label(PowerMap::Voxel{leaf, k});
        expected.emplace(coarse.labelOf(step.parentVoxel(voxel)),
            fine.ballAt(fine.layout.voxel(site.leaf, site.offset)));
    });
    std::set<std::pair<int32_t, int32_t>> edges;
    for (const DagEdge& edge : sphereDag(fine, coarse, step)) {
        edges.emplace(edge.parent, edge.child);
    }
    EXPECT_TRUE(std::includes(edges.begin(), edges.end(), expected.begin(), expected.end()));
}

TEST(SphereDag, IsEmptyWhereNoParentIsOn)
{
    const MedialLevel fine(*maskOf(shapes::box(Coord(4, 4, 4))), 3, Distance(), nullptr);
    const MedialLevel coarse(*maskOf(Voxels{Coord(100, 0, 0)}), 3, Distance(), nullptr);
    EXPECT_TRUE(sphereDag(fine, coarse, {Coord(0, 0, 0), 2, 3}).empty());
}

TEST(SphereDag, StopsWhenInterrupted)
{
    const MedialLevel fine(*maskOf(shapes::box(Coord(9, 9, 9))), 3, Distance(), nullptr);
    const MedialLevel coarse(*maskOf(shapes::box(Coord(5, 5, 5))), 3, Distance(), nullptr);
    StopAfter now;
    EXPECT_THROW(sphereDag(fine, coarse, {Coord(0, 0, 0), 2, 3}, &now), Interrupted);
}

} // namespace
