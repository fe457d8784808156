// SPDX-License-Identifier: Apache-2.0
#include "PosePairs.h"

#include "ObjectReference.h"

#include <gtest/gtest.h>

#include <openvdb/math/Transform.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace spheretree_test {

using namespace openvdb_spheretree;
using openvdb::Vec3d;

namespace {

/// A cube by its center and half its sides' vectors.
struct Cube {
    Vec3d center;
    std::array<Vec3d, 3> half;

    double reachAlong(const Vec3d& axis) const
    {
        return std::abs(axis.dot(half[0])) + std::abs(axis.dot(half[1]))
            + std::abs(axis.dot(half[2]));
    }
    Vec3d corner(int i) const
    {
        return center + (i & 1 ? 1.0 : -1.0) * half[0] + (i & 2 ? 1.0 : -1.0) * half[1]
            + (i & 4 ? 1.0 : -1.0) * half[2];
    }
    double distance(const Vec3d& point) const
    {
        Vec3d nearest = center;
        for (const Vec3d& h : half) {
            const double along = (point - center).dot(h) / h.lengthSqr();
            nearest += std::max(-1.0, std::min(1.0, along)) * h;
        }
        return (point - nearest).length();
    }
};

/// Separating axes (S. Gottschalk et al., OBBTree, SIGGRAPH 1996). Cubes that touch within rounding do not count: who asks
/// holds a "meet" against a verdict.
bool meet(const Cube& a, const Cube& b)
{
    const Vec3d between = b.center - a.center;
    const auto separates = [&](const Vec3d& axis) {
        if (axis.lengthSqr() < 1e-12) return false;
        return std::abs(axis.dot(between)) > a.reachAlong(axis) + b.reachAlong(axis) - 1e-12;
    };
    for (const Vec3d& h : a.half)
        if (separates(h)) return false;
    for (const Vec3d& h : b.half)
        if (separates(h)) return false;
    for (const Vec3d& g : a.half) {
        for (const Vec3d& h : b.half)
            if (separates(g.cross(h))) return false;
    }
    return true;
}

std::vector<Cube> cubesOf(const QueryBody& body, const RigidTransform& pose, double inside)
{
    const auto& transform = *body.tree.transform;
    const double scale = body.sample.settings.scale;
    std::vector<Cube> cubes;
    for (const Coord& voxel : body.sample.voxels) {
        Cube cube;
        cube.center = pose * (scale * transform.indexToWorld(voxel.asVec3d()));
        for (int axis = 0; axis < 3; ++axis) {
            Vec3d half(0, 0, 0);
            half[axis] = 0.5 * scale * body.tree.voxelSize() - inside;
            cube.half[axis] = pose.rotate(half);
        }
        cubes.push_back(cube);
    }
    return cubes;
}

/// Pairs of cubes whose centers are that near at most.
template <typename Visit>
void forNearCubes(const PosePair& pair, double most, double inside, const Visit& visit)
{
    const std::vector<Cube> b = cubesOf(pair.b, pair.poseB, inside);
    for (const Cube& p : cubesOf(pair.a, pair.poseA, inside)) {
        for (const Cube& q : b) {
            if ((p.center - q.center).length() <= most) visit(p, q);
        }
    }
}

/// A pose in which @a b is that far from touching @a a along a random direction: by halving.
RigidTransform poseNear(const QueryBody& a, const QueryBody& b, double apart, Random& random)
{
    const RigidTransform turn = randomRotation(random);
    const Vec3d direction = randomDirection(random);
    const auto at = [&](double along) {
        return RigidTransform::fromTranslation(
                   a.query.center() + along * direction - turn.rotate(b.query.center()))
            * turn;
    };
    double low = 0, high = 1.01 * (a.query.radius() + b.query.radius());
    const auto ballsA = leafBalls(a.sample);
    for (int step = 0; step < 24; ++step) {
        const double middle = 0.5 * (low + high);
        (smallestGap(ballsA, leafBalls(b.sample, at(middle))) > 0 ? high : low) = middle;
    }
    return at(high + apart);
}

} // namespace

std::string PosePair::name() const { return a.sample.name + " and " + b.sample.name + ": "; }

double PosePair::smallestGap() const
{
    return spheretree_test::smallestGap(leafBalls(a.sample, poseA), leafBalls(b.sample, poseB));
}

std::vector<double> PosePair::allGaps() const
{
    std::vector<double> gaps;
    const auto ballsB = leafBalls(b.sample, poseB);
    for (const WorldBall& p : leafBalls(a.sample, poseA)) {
        for (const WorldBall& q : ballsB) gaps.push_back(gap(p, q));
    }
    return gaps;
}

double PosePair::gapOf(const NodePair& nodes) const
{
    const auto ball = [](const QueryBody& body, int32_t id, const RigidTransform& pose) {
        const double scale = body.sample.settings.scale;
        return WorldBall{pose * (scale * body.tree.centerWorld(id)),
            scale * body.tree.spheres.radiusWorld.at(std::size_t(id))};
    };
    return gap(ball(a, nodes.a, poseA), ball(b, nodes.b, poseB));
}

bool PosePair::cubesMeet(double inside) const
{
    bool found = false;
    const double most = std::sqrt(3.0) * 0.5
        * (a.sample.settings.scale * a.tree.voxelSize()
            + b.sample.settings.scale * b.tree.voxelSize());
    forNearCubes(
        *this, most, inside, [&](const Cube& p, const Cube& q) { found = found || meet(p, q); });
    return found;
}

double PosePair::cubesDistanceAtMost() const
{
    double least = std::numeric_limits<double>::infinity();
    forNearCubes(*this, least, 0, [&](const Cube& p, const Cube& q) {
        if ((p.center - q.center).length() - 2 * p.half[0].length() - 2 * q.half[0].length()
            > least)
            return;
        for (int i = 0; i < 8; ++i)
            least = std::min({least, p.distance(q.corner(i)), q.distance(p.corner(i))});
    });
    return least;
}

void forEachPosePair(
    Exactness exactness, int count, const std::function<void(const PosePair&)>& test)
{
    forEachPosePairOf(querySamples(), exactness, count, test);
}

void forEachPosePairOf(const std::vector<QuerySample>& samples, Exactness exactness, int count,
    const std::function<void(const PosePair&)>& test)
{
    std::vector<QueryBody> bodies;
    for (const QuerySample& sample : samples) {
        bodies.push_back({sample, makeQueryTree(sample, exactness), sample.tree});
    }
    Random random(11);
    RigidTransform near;
    for (int i = 0; i < count && !testing::Test::HasFatalFailure(); ++i) {
        static int pairOf[2];
        if (i % 12 == 0) { // a few poses of each pair
            for (int& which : pairOf) which = random.between(0, int(bodies.size()) - 1);
            near = poseNear(bodies[pairOf[0]], bodies[pairOf[1]], 0, random);
        }
        const QueryBody &a = bodies[pairOf[0]], &b = bodies[pairOf[1]];
        RigidTransform poseB = near;
        // One after the other, here and below: samples are the same for all compilers.
        if (i % 3 == 0) {
            const double apart = uniform(random, -0.01, 0.01);
            poseB = RigidTransform::fromTranslation(apart * randomDirection(random)) * near;
        }
        if (i % 3 == 1) {
            const double far = uniform(random, 0, 1.2) * (a.query.radius() + b.query.radius());
            const RigidTransform turn = randomRotation(random);
            poseB = RigidTransform::fromTranslation(a.query.center() + far * randomDirection(random)
                        - turn.rotate(b.query.center()))
                * turn;
        }
        if (i % 3 == 2) {
            const double apart = uniform(random, 0, 0.5);
            poseB = RigidTransform::fromTranslation(apart * randomDirection(random)) * near;
        }
        RigidTransform world;
        if (i % 2 == 0) {
            const Vec3d direction = randomDirection(random);
            world = RigidTransform::fromTranslation(30.0 * direction) * randomRotation(random);
        }
        test({a, b, world, world * poseB});
    }
}

RigidMotion movedMotion(
    const RigidTransform& world, const RigidMotion& motion, const RigidTransform& first)
{
    const RigidTransform start = world * motion.start() * first;
    const Vec3d axis = world.rotate(motion.axis());
    if (motion.radians() == 0) return RigidMotion::line(start, motion.slide() * axis);
    return RigidMotion::screw(
        start, world * motion.point(), axis, motion.radians(), motion.slide());
}

namespace {

/// As turnedTree().
const RigidTransform& turnOfAxes()
{
    static const RigidTransform turn(openvdb::Mat3d(0, 1, 0, 0, 0, 1, 1, 0, 0), Vec3d(0.0));
    return turn;
}

} // namespace

TurnedPairs::Turned::Turned(const QueryBody& given, Exactness exactness)
    : sample{given.sample.name, {}, turnedTree(given.tree, Vec3d(0.0)), given.sample.settings},
      body{sample, makeQueryTree(sample, exactness), sample.tree}
{
    for (const Coord& voxel : given.sample.voxels)
        sample.voxels.push_back(Coord(voxel[1], voxel[2], voxel[0]));
}

const QueryBody& TurnedPairs::body(const QueryBody& given)
{
    auto& turned = mBodies[&given];
    if (!turned) turned = std::make_unique<Turned>(given, mExactness);
    return turned->body;
}

PosePair TurnedPairs::of(const PosePair& pair)
{
    const RigidTransform &turn = turnOfAxes(), back = turn.inverse();
    return {body(pair.a), body(pair.b), turn * pair.poseA * back, turn * pair.poseB * back};
}

RigidMotion TurnedPairs::of(const RigidMotion& motion) const
{
    return movedMotion(turnOfAxes(), motion, turnOfAxes().inverse());
}

} // namespace spheretree_test
