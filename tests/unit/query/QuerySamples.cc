// SPDX-License-Identifier: Apache-2.0
#include "QuerySamples.h"

#include "support/CoreStages.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/tree/GivenTree.h>
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

namespace {

/// The leaf spheres of a tree, each a little aside and larger by as much: of no voxel's center.
WorldSpheres movedLeaves(const SphereTree& tree, Random& random)
{
    WorldSpheres spheres = worldSpheres(tree);
    const double aside = 0.3 * tree.voxelSize();
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        spheres.center[i] += aside * randomDirection(random);
        spheres.radius[i] += aside;
    }
    return spheres;
}

QuerySample overGivenLeaves(const std::string& name, const QuerySample& of, Random& random)
{
    TightOptions options;
    options.quality = Quality::Fast;
    options.leaves = Leaves::Given;
    const auto grid = gridOf(of.voxels);
    grid->setTransform(of.tree.transform->copy());
    return {name, of.voxels, buildSphereTreeOver(movedLeaves(of.tree, random), *grid, options)};
}

/// The voxels of one plane.
Voxels flat(const Voxels& voxels)
{
    Voxels plane;
    for (const Coord& voxel : voxels) {
        if (voxel[2] == voxels[voxels.size() / 2][2]) plane.push_back(voxel);
    }
    return plane;
}

void addOtherSamples(std::vector<QuerySample>& all, uint32_t seed)
{
    const std::string of = " of object " + std::to_string(seed);
    const Voxels voxels = randomObject(seed).voxels;
    TightOptions fast;
    fast.quality = Quality::Fast;
    const QuerySample tight = querySample("tight", voxels, fast);
    all.push_back(querySample("reversible" + of, voxels, ReversibleOptions()));
    ReversibleOptions reversible;
    ExtendedOptions extended;
    reversible.center = extended.center = Center::Miniball;
    all.push_back(querySample("reversible on miniballs" + of, voxels, reversible));
    all.push_back(querySample("extended on miniballs" + of, voxels, extended));
    Random random(seed);
    all.push_back(overGivenLeaves("given leaves" + of, tight, random));
    all.push_back({"given" + of, voxels, givenTree(movedLeaves(tight.tree, random))});
    if (tight.tree.hasLevel(1)) {
        all.push_back({"a coarser level" + of, voxels, tight.tree});
        all.back().settings.level = 1;
    }
    all.push_back({"scaled" + of, voxels, tight.tree});
    all.back().settings.scale = 2.5;
    SphereTreeSettings bare = fast, plane = fast;
    bare.padding = 0;
    all.push_back(querySample("no padding" + of, voxels, bare));
    plane.dim = 2;
    all.push_back(querySample("flat" + of, flat(voxels), plane));
    all.push_back(querySample("inner" + of, voxels, InnerOptions()));
}

} // namespace

const std::vector<QuerySample>& otherQuerySamples()
{
    static const std::vector<QuerySample> samples = [] {
        std::vector<QuerySample> all;
        for (const uint32_t seed : {3, 15, 19, 23}) addOtherSamples(all, seed);
        return all;
    }();
    return samples;
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

QueryTree makeQueryTree(const QuerySample& sample, Exactness exactness)
{
    QueryTreeSettings settings = sample.settings;
    settings.exactness = exactness;
    return makeQueryTree(sample.tree, settings);
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

namespace {

std::vector<WorldBall> ballsOf(
    const SphereTree& tree, const SphereTreeLevel& level, double scale, const RigidTransform& pose)
{
    std::vector<WorldBall> balls;
    for (int32_t id = level.begin; id < level.end; ++id) {
        balls.push_back(
            {pose * (scale * tree.centerWorld(id)), scale * tree.spheres.radiusWorld[id]});
    }
    return balls;
}

} // namespace

std::vector<WorldBall> leafBalls(const SphereTree& tree, const RigidTransform& pose)
{
    return ballsOf(tree, tree.levels.front(), 1, pose);
}

std::vector<WorldBall> leafBalls(const QuerySample& sample, const RigidTransform& pose)
{
    const SphereTree& tree = sample.tree;
    const int number = sample.settings.level;
    const SphereTreeLevel& level = number < 0 ? tree.levels.front() : tree.level(number);
    return ballsOf(tree, level, sample.settings.scale, pose);
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
