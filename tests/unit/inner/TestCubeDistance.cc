// SPDX-License-Identifier: Apache-2.0
/// @file TestCubeDistance.cc
/// @brief Distances to the nearest cube outside, against all cubes around; and inner trees that stay within cubes.

#include "support/CoreStages.h"
#include "support/NaiveReference.h"
#include "support/RandomObjects.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/inner/CubeDistance.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::MaskTree;

int64_t halvesToCubes(const Coord& voxel, const std::set<Coord>& object, int flatAxis)
{
    int64_t nearest = INT64_MAX;
    CoordBBox around(voxel - Coord(12), voxel + Coord(12));
    if (flatAxis >= 0) around.min()[flatAxis] = around.max()[flatAxis] = voxel[flatAxis];
    for (auto q = around.begin(); q; ++q) {
        if (object.count(*q)) continue;
        int64_t sum = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const int64_t apart = std::max(0, 2 * std::abs((*q)[axis] - voxel[axis]) - 1);
            sum += apart * apart;
        }
        nearest = std::min(nearest, sum);
    }
    return nearest;
}

TEST(CubeDistance, IsThatOfTheNearestOfAllCubes)
{
    for (uint32_t seed = 0; seed < 40; ++seed) {
        const RandomObject object = randomObject(seed);
        if (object.voxels.size() > 4000) continue;
        SCOPED_TRACE(object.name);
        MaskTree tree(false);
        for (const Coord& voxel : object.voxels) tree.setValueOn(voxel);
        const std::set<Coord> set(object.voxels.begin(), object.voxels.end());
        const detail::CubeDistance distance(tree, -1, nullptr);
        for (std::size_t i = 0; i < object.voxels.size(); i += 1 + object.voxels.size() / 100) {
            const int64_t expected = halvesToCubes(object.voxels[i], set, -1);
            if (expected > 400) continue; // beyond the cubes that are looked at
            ASSERT_EQ(expected, distance.halvesSq(object.voxels[i])) << object.voxels[i];
        }
    }
}

TEST(CubeDistance, LeavesOutTheAxisThatAFlatObjectIsThinAlong)
{
    for (int axis = 0; axis < 3; ++axis) {
        MaskTree tree(false);
        std::set<Coord> set;
        Coord low(0), high(10, 14, 9);
        low[axis] = high[axis] = 5;
        for (auto voxel = CoordBBox(low, high).begin(); voxel; ++voxel) {
            tree.setValueOn(*voxel);
            set.insert(*voxel);
        }
        const detail::CubeDistance distance(tree, axis, nullptr);
        for (const Coord& voxel : set) {
            ASSERT_EQ(halvesToCubes(voxel, set, axis), distance.halvesSq(voxel)) << voxel;
        }
    }
}

/// Points of the surface of every sphere lie in cubes of the object.
TEST(CubeDistance, KeepsStrictInnerSpheresWithinCubes)
{
    openvdb::initialize();
    for (const bool cuts : {false, true}) {
        InnerOptions options;
        options.strict = true;
        options.cuts = cuts;
        if (!cuts) options.budget.spheres = {60, 9};
        const auto object = gridOf(shapes::ball(150, 40));
        const SphereTree tree = buildSphereTree(*object, options);
        EXPECT_TRUE(checkSphereTree(tree, *object).empty());
        EXPECT_LT(5, *std::max_element(tree.spheres.radius.begin(), tree.spheres.radius.end()) * 3);
        for (int32_t id = 0; id < tree.size(); ++id) {
            const double radius = double(tree.spheres.radiusWorld[std::size_t(id)]);
            for (int k = 0; k < 2000; ++k) {
                const double z = 1 - (2 * k + 1) / 2000.0, angle = 2.39996322972865332 * k;
                const double flat = std::sqrt(1 - z * z);
                const openvdb::Vec3d point = tree.centerWorld(id)
                    + 0.999999 * radius
                        * openvdb::Vec3d(flat * std::cos(angle), flat * std::sin(angle), z);
                ASSERT_TRUE(object->tree().isValueOn(Coord::round(object->worldToIndex(point))))
                    << id;
            }
        }
        SphereTree damaged = tree;
        damaged.spheres.radiusWorld[0] *= 1.5f;
        const auto faults = checkSphereTree(damaged, *object);
        EXPECT_TRUE(std::any_of(faults.begin(), faults.end(), [](const TreeFault& fault) {
            return fault.kind == FaultKind::Inside
                && fault.sentence.find("strict=1") != std::string::npos;
        }));
    }
}

} // namespace
