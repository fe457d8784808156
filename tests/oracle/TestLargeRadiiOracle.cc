// SPDX-License-Identifier: Apache-2.0
/// @file TestLargeRadiiOracle.cc
/// @brief Objects too large for the O(n^2) definition: thick solids, where the kernels divide lines
/// instead of looking at every row, and radii beyond 127 and 254 voxels, where keys and distances
/// become wider. Against LineReference.h and closed forms.

#include "support/CoreStages.h"
#include "support/RandomObjects.h"

namespace {

using namespace spheretree_test;

constexpr int64_t kNarrowLabels = 127 * 127;  // largest distSq of 8-bit label offsets
constexpr int64_t kWideDistances = 255 * 255; // smallest distSq of 32-bit distances

/// The voxels of a plane nearer to the origin than the root of @a radiusSq.
Voxels disc(int radiusSq, int z)
{
    const int r = int(std::sqrt(double(radiusSq))) + 1;
    Voxels voxels;
    for (const Coord& v : voxelsOfBox(CoordBBox(Coord(-r, -r, 0), Coord(r, r, 0)))) {
        if (squaredDistance(v, Coord(0, 0, 0)) < radiusSq) voxels.push_back(v + Coord(0, 0, z));
    }
    return voxels;
}

/// Takes about @a holes voxels out of the object.
Voxels withHoles(const Voxels& solid, int holes, uint32_t seed)
{
    Random random(seed);
    return shapes::pricked(solid, double(holes) / double(solid.size()), random);
}

/// Distance of every voxel to the nearest of the background voxels that touch the object by a face:
/// no other background voxel is the nearest one, because a step towards the object gets closer.
std::vector<int64_t> distancesToBoundary(const Voxels& voxels)
{
    Voxels boundary;
    for (const Coord& voxel : voxels) {
        for (const Coord& step :
            {Coord(1, 0, 0), Coord(-1, 0, 0), Coord(0, 1, 0), Coord(0, -1, 0)}) {
            const Coord next = voxel + step;
            const bool on = std::binary_search(voxels.begin(), voxels.end(), next);
            if (!on) boundary.push_back(next);
        }
    }
    sortVoxels(boundary);
    std::vector<int64_t> result;
    for (const Coord& voxel : voxels) {
        int64_t nearest = std::numeric_limits<int64_t>::max();
        for (const Coord& b : boundary) nearest = std::min(nearest, squaredDistance(voxel, b));
        result.push_back(nearest);
    }
    return result;
}

/// Squared distance inside a box to the nearest voxel beyond its faces.
int64_t distSqInBox(const CoordBBox& box, const Coord& ijk, int dim)
{
    int64_t nearest = std::numeric_limits<int>::max();
    for (int axis = 0; axis < dim; ++axis) {
        const int64_t before = int64_t(ijk[axis]) - box.min()[axis] + 1;
        const int64_t behind = int64_t(box.max()[axis]) - ijk[axis] + 1;
        nearest = std::min({nearest, before, behind});
    }
    return nearest * nearest;
}

testing::AssertionResult boxIsRight(const CoordBBox& box, const CoreStages& stages, int dim)
{
    auto result = testing::AssertionSuccess();
    forEachVoxel(stages.layout, [&](uint32_t leaf, uint32_t k, const Coord& voxel) {
        const int64_t distSq = stages.distances.at(leaf, k);
        const int64_t expected = distSqInBox(box, voxel, dim);
        if (!result || distSq == expected) return;
        result = testing::AssertionFailure() << "distSq of " << voxel << " in " << box << " is "
                                             << distSq << ", should be " << expected;
    });
    return result;
}

TEST(LargeRadiiOracle, MatchesOnThickSolidsOfManyShapes)
{
    Random random(77);
    const std::vector<std::pair<const char*, Voxels>> solids{
        {"ball", shapes::ball(24 * 24 + 5)},
        {"two balls",
            [] {
                Voxels voxels = shapes::ball(20 * 20);
                for (const Coord& v : shapes::ball(17 * 17 + 3))
                    voxels.push_back(v + Coord(19, 11, -6));
                return voxels;
            }()},
        {"box", shapes::box(Coord(41, 60, 33))},
        {"long box along x", shapes::box(Coord(150, 18, 25))},
        {"long box along y", shapes::box(Coord(21, 160, 23))},
        {"long box along z", shapes::box(Coord(27, 19, 170))},
        {"thick shell", shapes::ball(28 * 28, 13 * 13)},
    };
    for (const auto& [name, solid] : solids) {
        for (int holes : {0, 3, 40}) {
            Voxels voxels = withHoles(solid, holes, uint32_t(holes + 1));
            placeOnBorder(voxels, random);
            sortVoxels(voxels);
            const CoreStages stages(*maskOf(voxels));
            ASSERT_TRUE(agree(LineReference(voxels), stages)) << name << ", holes " << holes;
        }
    }
}

TEST(LargeRadiiOracle, MatchesOnDiscsOnBothSidesOfEverySwitchOfWidth)
{
    struct {
        int radiusSq, holes;
    } const cases[] = {{60 * 60, 1}, {60 * 60 + 1, 1}, {127 * 127, 0}, {127 * 127 + 1, 0},
        {150 * 150, 3}, {65000, 0}, {255 * 255, 2}};
    for (const auto& c : cases) {
        const Voxels voxels = withHoles(disc(c.radiusSq, 3), c.holes, 5);
        const CoreStages stages(*maskOf(voxels), 2);
        ASSERT_TRUE(agree(LineReference(voxels, 2), stages))
            << "radiusSq " << c.radiusSq << ", holes " << c.holes;
    }
}

TEST(LargeRadiiOracle, ADiscOfRadius300HasTheDistancesToItsBoundary)
{
    Voxels voxels = translated(disc(300 * 300, -5), Coord(-8, 131, 0));
    sortVoxels(voxels);
    const CoreStages stages(*maskOf(voxels), 2);
    ASSERT_GE(stages.distances.largest(), kWideDistances);
    const std::vector<int64_t> expected = distancesToBoundary(voxels);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        ASSERT_EQ(stages.distSq(voxels[i]), expected[i]) << voxels[i];
    }
    EXPECT_TRUE(agree(LineReference(voxels, 2), stages));
}

TEST(LargeRadiiOracle, ADiscOfRadius300WithHolesKeepsTiesInOrder)
{
    // A lattice of holes: everything is symmetric, so ties abound.
    Voxels voxels;
    for (const Coord& v : disc(300 * 300, 0)) {
        const bool hole = v[0] > 0 && v[0] % 60 == 0 && v[1] % 60 == 0;
        if (!hole) voxels.push_back(v);
    }
    const CoreStages stages(*maskOf(voxels), 2);
    ASSERT_GT(int64_t(stages.distances.largest()), kNarrowLabels);
    EXPECT_TRUE(agree(LineReference(voxels, 2), stages));
}

TEST(LargeRadiiOracle, BoxesHaveTheirClosedFormAroundTheSwitchOfWidth)
{
    for (const int width : {507, 508, 509, 510, 511, 520}) {
        for (const Coord& size : {Coord(width, 700, 1), Coord(700, width, 1)}) {
            const CoordBBox box(Coord(-13, -300, 7), Coord(-14, -301, 6) + size);
            const CoreStages stages(*maskOf(box), 2);
            const int64_t radius = (width + 1) / 2;
            EXPECT_EQ(stages.distances.largest(), radius * radius) << size;
            EXPECT_EQ(stages.distances.narrow() == nullptr, radius >= 255) << size;
            EXPECT_TRUE(boxIsRight(box, stages, 2));
        }
    }
}

TEST(LargeRadiiOracle, WideLabelsInThreeDimensionsMatchOnSampledPlanes)
{
    const CoordBBox box(Coord(-3, 5, -130), Coord(254, 263, 129));
    const CoreStages stages(*maskOf(box));
    ASSERT_GT(int64_t(stages.distances.largest()), kNarrowLabels);
    ASSERT_TRUE(boxIsRight(box, stages, 3));
    const LineReference reference(
        box, [&](const Coord& ijk) { return distSqInBox(box, ijk, 3); }, 3);
    for (int z : {-130, -60, -1, 129}) {
        EXPECT_TRUE(agreeOnPlane(reference, stages, z)) << "plane " << z;
    }
}

TEST(LargeRadiiOracle, PlanksLongerThan65536VoxelsMatchTheirClosedForm)
{
    // Row numbers of such a run fit 16 bits neither signed nor unsigned. 11 voxels across are what
    // it takes to leave the plain windows.
    for (int axis = 0; axis < 3; ++axis) {
        const int dim = axis == 2 ? 3 : 2;
        Coord size(11, 11, dim == 2 ? 1 : 11);
        size[axis] = 66000;
        const CoordBBox box(Coord(-5, -6, -7), Coord(-6, -7, -8) + size);
        const CoreStages stages(*maskOf(box), dim);
        EXPECT_TRUE(boxIsRight(box, stages, dim)) << "axis " << axis;
    }
}

TEST(LargeRadiiOracle, LabelsAtBothEndsOfALongPlankAreThoseOfAShortOne)
{
    for (int axis = 0; axis < 3; ++axis) {
        Coord size(11, 13, 12), longer(0, 0, 0);
        size[axis] = 64;
        longer[axis] = 40000 - size[axis];
        const CoordBBox box(Coord(0, 0, 0), size - Coord(1, 1, 1));
        const LineReference reference(voxelsOfBox(box));
        const CoreStages stages(*maskOf(CoordBBox(box.min(), box.max() + longer)));
        for (int z = 0; z < size[2]; ++z) {
            const auto plane = reference.labelsOfPlane(z);
            for (const Coord& voxel : voxelsOfBox(box)) {
                if (voxel[2] != z) continue;
                const Coord shift = voxel[axis] < size[axis] / 2 ? Coord(0, 0, 0) : longer;
                ASSERT_EQ(
                    stages.labels.label(voxel + shift), reference.labelIn(plane, voxel).at + shift)
                    << "axis " << axis;
            }
        }
    }
}

} // namespace
