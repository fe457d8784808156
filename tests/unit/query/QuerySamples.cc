// SPDX-License-Identifier: Apache-2.0
#include "QuerySamples.h"

#include "support/CoreStages.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>

#include <openvdb/math/Transform.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace spheretree_test {

using namespace openvdb_spheretree;
using openvdb::Vec3d;

QuerySample querySample(
    const std::string& name, const Voxels& voxels, const SphereTreeSettings& settings)
{
    const auto grid = gridOf(voxels);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    grid->transform().postTranslate(Vec3d(3.7, -1.2, 0.4));
    return {name, voxels, buildSphereTree(*grid, settings)};
}

const std::vector<QuerySample>& querySamples()
{
    static const std::vector<QuerySample> samples = [] {
        TightOptions fast, balls, wide;
        fast.quality = balls.quality = wide.quality = Quality::Fast;
        balls.cover = Cover::Balls;
        wide.budget.branching = 30; // more children than a block has lanes
        std::vector<QuerySample> all;
        for (uint32_t seed = 1; seed < 7; ++seed) {
            const Voxels voxels = randomObject(seed).voxels;
            const std::string of = " of object " + std::to_string(seed);
            all.push_back(querySample("tight" + of, voxels, fast));
            all.push_back(querySample("balls" + of, voxels, balls));
            all.push_back(querySample("wide" + of, voxels, wide));
            all.push_back(querySample("extended" + of, voxels, ExtendedOptions()));
        }
        all.push_back(querySample("one voxel", {Coord(2, -3, 4)}, fast));
        all.push_back(querySample("two far voxels", {Coord(0, 0, 0), Coord(60, 3, -9)}, fast));
        Voxels row;
        for (int x = 0; x < 25; ++x) row.push_back(Coord(x, 0, 0));
        all.push_back(querySample("a row", row, fast));
        all.push_back(querySample("a row, balls", row, balls));
        return all;
    }();
    return samples;
}

const QuerySample& querySample(const std::string& name)
{
    for (const QuerySample& sample : querySamples()) {
        if (sample.name == name) return sample;
    }
    throw std::out_of_range("no sample " + name);
}

double uniform(Random& random, double low, double high)
{
    return low + (high - low) * random.between(0, 1 << 30) / double(1 << 30);
}

Vec3d randomDirection(Random& random)
{
    const double z = uniform(random, -1, 1), angle = uniform(random, 0, 2 * M_PI),
                 r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

RigidTransform randomRotation(Random& random)
{
    // Any axis by any angle is not uniform over rotations, but reaches all of them.
    const double radians = uniform(random, 0, 2 * M_PI); // arguments would have no order
    return RigidTransform::fromRotation(randomDirection(random), radians);
}

std::vector<WorldBall> leafBalls(const SphereTree& tree, const RigidTransform& pose)
{
    std::vector<WorldBall> balls;
    const SphereTreeLevel& level = tree.levels.front();
    for (int32_t id = level.begin; id < level.end; ++id) {
        balls.push_back({pose * tree.centerWorld(id), double(tree.spheres.radiusWorld[id])});
    }
    return balls;
}

double gap(const WorldBall& a, const WorldBall& b)
{
    return (a.center - b.center).length() - a.radius - b.radius;
}

double smallestGap(const std::vector<WorldBall>& a, const std::vector<WorldBall>& b)
{
    double smallest = std::numeric_limits<double>::infinity();
    for (const WorldBall& p : a) {
        for (const WorldBall& q : b) smallest = std::min(smallest, gap(p, q));
    }
    return smallest;
}

} // namespace spheretree_test
