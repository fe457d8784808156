// SPDX-License-Identifier: Apache-2.0
/// @file TestStoredBounds.cc
/// @brief distance= of exact solids: no point of a stored sphere is farther from the object's voxel cubes
/// than was asked, nor much farther from the solid itself. Spheres are sampled, and distances are taken
/// from the formula of the solid and from the cubes, without the library's measures.

#include "support/TightObjects.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>

#include <openvdb/Exceptions.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::Vec3d;

/// World units; voxels are halves of them.
constexpr double kVoxel = 0.5;

double outOfBox(const Vec3d& p, const Vec3d& low, const Vec3d& high)
{
    Vec3d out;
    for (int axis = 0; axis < 3; ++axis) {
        out[axis] = std::max({low[axis] - p[axis], 0.0, p[axis] - high[axis]});
    }
    return out.length();
}

struct Solid {
    std::string name;
    Vec3d low, high;
    std::function<double(const Vec3d&)> distance; ///< to the solid; 0 inside
};

std::vector<Solid> exactSolids()
{
    const auto box = [](const Vec3d& low, const Vec3d& high) {
        return [=](const Vec3d& p) { return outOfBox(p, low, high); };
    };
    const auto flange = [](const Vec3d& p) {
        return std::min(
            outOfBox(p, Vec3d(0), Vec3d(6)), outOfBox(p, Vec3d(5.9, 1, 2.6), Vec3d(14, 5, 4.1)));
    };
    return {{"box", Vec3d(0.1), Vec3d(9.3, 6.1, 4.2), box(Vec3d(0.1), Vec3d(9.3, 6.1, 4.2))},
        {"plate", Vec3d(0.1), Vec3d(12.3, 9.1, 0.7), box(Vec3d(0.1), Vec3d(12.3, 9.1, 0.7))},
        {"flange", Vec3d(0), Vec3d(14, 6, 6), flange},
        {"ball", Vec3d(-5), Vec3d(5),
            [](const Vec3d& p) { return std::max(0.0, p.length() - 4.87); }},
        {"torus", Vec3d(-6.6, -6.6, -1.6), Vec3d(6.6, 6.6, 1.6), [](const Vec3d& p) {
             return std::max(0.0, std::hypot(std::hypot(p[0], p[1]) - 5, p[2]) - 1.53);
         }}};
}

openvdb::SharedPtr<openvdb::BoolGrid> voxelsOf(const Solid& solid)
{
    const auto grid = openvdb::BoolGrid::create();
    grid->setTransform(openvdb::math::Transform::createLinearTransform(kVoxel));
    const openvdb::CoordBBox box(
        openvdb::Coord::floor(solid.low / kVoxel), openvdb::Coord::ceil(solid.high / kVoxel));
    for (auto q = box.begin(); q; ++q) {
        if (solid.distance(kVoxel * (*q).asVec3d()) == 0) grid->tree().setValueOn(*q);
    }
    return grid;
}

/// @return whether an object voxel's cube is within @a reach of @a p; voxels.
bool isNearCubes(const Vec3d& p, double reach, const openvdb::BoolGrid& object)
{
    const openvdb::CoordBBox box(openvdb::Coord::floor(p - Vec3d(reach + 0.5)),
        openvdb::Coord::ceil(p + Vec3d(reach + 0.5)));
    const auto values = object.getConstAccessor();
    for (auto q = box.begin(); q; ++q) {
        const Vec3d center = (*q).asVec3d();
        if (values.isValueOn(*q)
            && outOfBox(p, center - Vec3d(0.5), center + Vec3d(0.5)) <= reach) {
            return true;
        }
    }
    return false;
}

/// @param bound  world units
void expectWithin(
    const SphereTree& tree, const Solid& solid, const openvdb::BoolGrid& object, double bound)
{
    constexpr int kPoints = 150;
    const double golden =
        std::acos(-1.0) * (3 - std::sqrt(5.0)); // the sunflower's angle spreads points evenly
    const double cubes = 0.5 * std::sqrt(3.0) * kVoxel; // of voxels whose centers are in the solid
    constexpr double kRounding = 1e-6;
    for (int32_t id = 0; id < tree.size(); ++id) {
        for (int i = 0; i < kPoints; ++i) {
            const double z = 1 - (2 * i + 1) / double(kPoints), ring = std::sqrt(1 - z * z);
            const Vec3d direction(ring * std::cos(golden * i), ring * std::sin(golden * i), z);
            const Vec3d p = tree.centerWorld(id) + double(tree.spheres.radiusWorld[id]) * direction;
            const double outside = solid.distance(p);
            ASSERT_LE(outside, bound + cubes + kRounding) << "sphere " << id;
            if (outside <= bound - cubes) continue; // a voxel is nearer than that
            ASSERT_TRUE(isNearCubes(p / kVoxel, bound / kVoxel + kRounding, object))
                << "sphere " << id << " at " << p;
        }
    }
}

TEST(StoredBounds, HoldForRandomDistancesFromExactSolids)
{
    openvdb::initialize();
    constexpr int kBounds = 40; // of each solid
    Random random(18);
    int reached = 0;
    for (const Solid& solid : exactSolids()) {
        const auto object = voxelsOf(solid);
        for (int turn = 0; turn < kBounds; ++turn) {
            const double bound = kVoxel * random.between(800, 9000) / 1000.0;
            SCOPED_TRACE(solid.name + ", distance=" + std::to_string(bound));
            SphereTreeSettings settings = tightSettings(Quality::Fast);
            settings.budgeted().budget = SphereBudget();
            settings.budgeted().budget.distance = bound;
            try {
                const SphereTree tree = buildSphereTree(*object, settings);
                ++reached;
                ASSERT_NO_FATAL_FAILURE(expectWithin(tree, solid, *object, bound));
            } catch (const openvdb::ValueError& error) { // spheres around single voxels reach 0.37
                ASSERT_NE(std::string(error.what()).find("cannot be reached"), std::string::npos);
                ASSERT_LT(bound, 2 * kVoxel);
            }
        }
    }
    EXPECT_GE(reached, 170) << "of 200";
}

} // namespace
