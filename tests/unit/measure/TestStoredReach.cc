// SPDX-License-Identifier: Apache-2.0
/// @file TestStoredReach.cc
/// @brief The bound on how far spheres reach, against points of them, and against what can be
/// reckoned by hand.

#include <openvdb_spheretree/measure/StoredReach.h>

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/sphere/SphereUnion.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using detail::ReachSphere;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskTree;
using openvdb::Vec3d;

constexpr double kTolerance = 0.055; // voxels, of what the header promises

class StoredReach : public ::testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }
};

/// Voxels that a sphere may touch: those whose center is within it, made larger by a diagonal.
MaskTree::Ptr touchedBy(
    const std::vector<ReachSphere>& spheres, const Distance& distance, int flatAxis)
{
    constexpr int kParts = 16;
    std::vector<ExactSphere> exact;
    for (const ReachSphere& s : spheres) {
        const double radius = kParts * distance.unit() * (s.radius + 2);
        exact.push_back({{std::llround(kParts * s.center[0]), std::llround(kParts * s.center[1]),
                             std::llround(kParts * s.center[2])},
            int64_t(radius * radius)});
    }
    CoordBBox box = boundingBox(exact, {distance, kParts});
    if (flatAxis >= 0) box.min()[flatAxis] = box.max()[flatAxis] = int(spheres[0].center[flatAxis]);
    return sphereUnion(exact, box, {distance, kParts});
}

double reachOf(const std::vector<ReachSphere>& spheres, const MaskTree& object,
    const Distance& distance = {}, int flatAxis = -1)
{
    const MaskTree::Ptr touched = touchedBy(spheres, distance, flatAxis);
    return detail::storedReach(spheres, detail::MaskMinus(*touched, object), object,
        detail::NearestVoxel(object, distance), flatAxis, nullptr);
}

std::vector<Coord> voxelsOf(const MaskTree& object)
{
    std::vector<Coord> voxels;
    for (auto it = object.cbeginValueOn(); it; ++it) {
        CoordBBox box;
        it.getBoundingBox(box);
        for (auto q = box.begin(); q; ++q) voxels.push_back(*q);
    }
    return voxels;
}

/// By its definition.
double distanceToCubes(const Vec3d& p, const std::vector<Coord>& voxels, const Distance& distance)
{
    double least = 1e300;
    for (const Coord& v : voxels) {
        Vec3d gap;
        for (int a = 0; a < 3; ++a) gap[a] = std::max(std::abs(p[a] - v[a]) - 0.5, 0.0);
        least = std::min(least, distance.length(gap[0], gap[1], gap[2]) / distance.unit());
    }
    return least;
}

/// The farthest of points of the spheres: on a grid of directions, at several depths, and then
/// climbing from the best of them.
double sampledReach(const std::vector<ReachSphere>& spheres, const std::vector<Coord>& voxels,
    std::mt19937& random, int flatAxis = -1)
{
    std::normal_distribution<double> normal;
    double most = 0;
    for (const ReachSphere& sphere : spheres) {
        const auto at = [&](const Vec3d& offset) {
            return distanceToCubes(sphere.center + offset, voxels, {});
        };
        std::vector<std::pair<double, Vec3d>> found;
        for (int i = 0; i < 600; ++i) {
            Vec3d offset(normal(random), normal(random), normal(random));
            if (flatAxis >= 0) offset[flatAxis] = 0;
            offset.normalize();
            offset *= sphere.radius * (i % 4 == 3 ? std::abs(std::sin(double(i))) : 1.0);
            found.emplace_back(at(offset), offset);
        }
        std::sort(found.begin(), found.end(), [](auto& a, auto& b) { return a.first > b.first; });
        for (std::size_t k = 0; k < 3; ++k) {
            auto [best, offset] = found[k];
            for (double step = 0.3; step > 1e-3; step *= 0.8) {
                for (int i = 0; i < 8; ++i) {
                    Vec3d moved =
                        offset + step * Vec3d(normal(random), normal(random), normal(random));
                    if (flatAxis >= 0) moved[flatAxis] = 0;
                    if (moved.length() > sphere.radius) moved *= sphere.radius / moved.length();
                    const double there = at(moved);
                    if (there > best) best = there, offset = moved;
                }
            }
            most = std::max(most, best);
        }
    }
    return most;
}

MaskTree cubeOf(int side)
{
    MaskTree object;
    object.fill(CoordBBox(Coord(0), Coord(side - 1)), true, true);
    return object;
}

TEST_F(StoredReach, IsWhatCanBeReckonedByHand)
{
    const MaskTree dot = cubeOf(1);
    EXPECT_NEAR(reachOf({{{0, 0, 0}, 3}}, dot), 2.5, kTolerance) << "along an axis";
    EXPECT_GE(reachOf({{{0, 0, 0}, 3}}, dot), 2.5);
    EXPECT_NEAR(reachOf({{{10, 0, 0}, 3}}, dot), 12.5, kTolerance);
    EXPECT_GE(reachOf({{{10, 0, 0}, 3}}, dot), 12.5);
    // The corners of a cube are the farthest points of the sphere around it that are inside.
    const MaskTree cube = cubeOf(40);
    const double half = 20, around = half * std::sqrt(3.0);
    EXPECT_NEAR(reachOf({{Vec3d(19.5), around}}, cube), around - half, kTolerance);
    EXPECT_GE(reachOf({{Vec3d(19.5), around}}, cube), around - half);
    // Two spheres: the one that reaches farther decides.
    EXPECT_NEAR(reachOf({{Vec3d(19.5), 21}, {{38.0, 10.0, 10.0}, 5}}, cube), 3.5, kTolerance);
}

TEST_F(StoredReach, IsNothingWhereSpheresStayInTheCubes)
{
    const MaskTree cube = cubeOf(20);
    EXPECT_EQ(reachOf({{Vec3d(9.5), 9.999}}, cube), 0);
    EXPECT_NEAR(reachOf({{Vec3d(9.5), 10}}, cube), 0, 1e-6) << "touches the faces";
    EXPECT_EQ(reachOf({{{3, 4, 5}, 3.4}, {{0, 0, 0}, 0}}, cube), 0);
    EXPECT_GT(reachOf({{Vec3d(9.5), 10.01}}, cube), 0.0099);
    EXPECT_EQ(reachOf({}, cube), 0);
}

TEST_F(StoredReach, FindsTheFarthestPointInsideAHole)
{
    MaskTree shell = cubeOf(41);
    shell.fill(CoordBBox(Coord(6), Coord(34)), false, false);
    const double reach = reachOf({{Vec3d(20), 18}}, shell);
    EXPECT_GE(reach, 14.5);
    EXPECT_LE(reach, 14.5 + kTolerance);
}

TEST_F(StoredReach, HoldsForTilesOfTheSpheresAndOfTheObject)
{
    MaskTree tile;
    tile.addTile(2, Coord(0), true, true); // 128^3
    const double reach = reachOf({{Vec3d(63.5), 400}}, tile);
    EXPECT_GE(reach, 400 - 64);
    EXPECT_LE(reach, 400 - 64 + kTolerance);
}

TEST_F(StoredReach, IsNeverLessThanWhatPointsOfTheSpheresReachAndHardlyMore)
{
    for (unsigned seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> place(-6, 6), size(0, seed % 3 == 0 ? 12 : 4);
        MaskTree object;
        for (int i = 0; i < (seed % 4 == 0 ? 3 : 60); ++i) {
            object.setValueOn(Coord(int(place(random)), int(place(random)), int(place(random))));
        }
        if (seed % 5 == 0) object.fill(CoordBBox(Coord(-4), Coord(3)), true, true);
        const int flatAxis = seed % 6 == 5 ? int(seed % 3) : -1;
        if (flatAxis >= 0) {
            CoordBBox plane(Coord(-9), Coord(9));
            plane.min()[flatAxis] = plane.max()[flatAxis] = 0;
            object.setValueOn(Coord(0));
            object.clip(plane);
        }
        std::vector<ReachSphere> spheres;
        for (unsigned i = 0; i < 1 + seed % 4; ++i) {
            Vec3d center(place(random), place(random), place(random));
            for (int a = 0; a < 3; ++a) center[a] = std::round(16 * center[a]) / 16;
            if (flatAxis >= 0) center[flatAxis] = 0;
            spheres.push_back({center, size(random)});
        }
        const double reach = reachOf(spheres, object, {}, flatAxis);
        const double sampled = sampledReach(spheres, voxelsOf(object), random, flatAxis);
        EXPECT_GE(reach, sampled);
        EXPECT_LE(reach, sampled + kTolerance + 0.02) << "samples miss a little";
    }
}

/// Two voxels, and a ball between them. Nearly all leaves are dismissed by blocks, and the farthest points are as far
/// from one voxel as from the other: seeds, which flee from the nearest one, do not find them.
struct BetweenTwoVoxels {
    explicit BetweenTwoVoxels(int flatAxis) : ball{Vec3d(0), 90}
    {
        for (const int at : {-60, 60}) {
            Coord voxel(at);
            if (flatAxis >= 0) voxel[flatAxis] = 0;
            object.setValueOn(voxel);
        }
    }

    MaskTree object;
    ReachSphere ball;
};

TEST_F(StoredReach, IsThatOfPointsAsFarFromTwoVoxels)
{
    const BetweenTwoVoxels given(-1);
    const std::vector<Coord> voxels = voxelsOf(given.object);
    double farthest = 0;
    const Vec3d u = Vec3d(1, -1, 0).unit(), v = Vec3d(1, 1, -2).unit(); // across the diagonal
    for (int i = 0; i < 10000; ++i) {
        const double angle = i * 0.001;
        const Vec3d point = given.ball.radius * (std::cos(angle) * u + std::sin(angle) * v);
        farthest = std::max(farthest, distanceToCubes(point, voxels, {}));
    }
    EXPECT_GT(farthest, 136);
    double alone = 0;
    for (const int threads : {1, 4}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        const double reach = reachOf({given.ball}, given.object);
        EXPECT_GE(reach, farthest);
        EXPECT_LE(reach, farthest + kTolerance);
        if (threads == 1) alone = reach;
        EXPECT_EQ(reach, alone);
    }
}

TEST_F(StoredReach, IsThatOfPointsAsFarFromTwoVoxelsOfAPlane)
{
    const BetweenTwoVoxels given(2);
    const double across = given.ball.radius / std::sqrt(2.0);
    const double farthest = distanceToCubes(Vec3d(across, -across, 0), voxelsOf(given.object), {});
    const double reach = reachOf({given.ball}, given.object, {}, 2);
    EXPECT_GE(reach, farthest - 1e-9);
    EXPECT_LE(reach, farthest + kTolerance);
}

TEST_F(StoredReach, IsThatOfPointsAsFarFromTwoVoxelsByANorm)
{
    const BetweenTwoVoxels given(-1);
    const std::vector<Coord> voxels = voxelsOf(given.object);
    const Distance norm = Distance::chamfer(3, 4, 5);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-1, 1);
    double sampled = 0;
    for (int i = 0; i < 100000; ++i) {
        Vec3d offset(place(random), place(random), place(random));
        offset *= given.ball.radius * norm.unit() / norm.length(offset[0], offset[1], offset[2]);
        sampled = std::max(sampled, distanceToCubes(offset, voxels, norm));
    }
    const double reach = reachOf({given.ball}, given.object, norm);
    EXPECT_GE(reach, sampled);
    EXPECT_LE(reach, sampled + 0.25 * norm.length(1, 1, 1) / norm.unit() + 1);
}

TEST_F(StoredReach, BoundsTheBallsOfNorms)
{
    for (const Distance& norm : {Distance::l1(), Distance::linf(), Distance::chamfer(3, 4, 5)}) {
        SCOPED_TRACE(toString(norm));
        std::mt19937 random(7);
        std::uniform_real_distribution<double> place(-1, 1);
        MaskTree object;
        for (int i = 0; i < 30; ++i) {
            object.setValueOn(
                Coord(int(6 * place(random)), int(6 * place(random)), int(6 * place(random))));
        }
        const ReachSphere ball{{1.5, -2, 0.5}, 6};
        const std::vector<Coord> voxels = voxelsOf(object);
        double sampled = 0;
        for (int i = 0; i < 20000; ++i) {
            Vec3d offset(place(random), place(random), place(random));
            offset *= ball.radius * norm.unit() / norm.length(offset[0], offset[1], offset[2]);
            sampled = std::max(sampled, distanceToCubes(ball.center + offset, voxels, norm));
        }
        const double reach = reachOf({ball}, object, norm);
        EXPECT_GE(reach, sampled);
        EXPECT_LE(reach, sampled + 0.25 * norm.length(1, 1, 1) / norm.unit() + 0.2);
    }
}

TEST_F(StoredReach, DoesNotDependOnThreads)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(-100, 100), size(1, 20);
    MaskTree object;
    std::vector<ReachSphere> spheres;
    for (int i = 0; i < 300; ++i) {
        const Vec3d center(
            std::round(place(random)), std::round(place(random)), std::round(place(random)));
        spheres.push_back({center, size(random)});
        object.setValueOn(Coord::round(center));
    }
    const auto compute = [&](int threads) {
        tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return reachOf(spheres, object);
    };
    const double one = compute(1);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(compute(2), one);
}

TEST_F(StoredReach, CanBeInterrupted)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    const MaskTree object = cubeOf(4);
    const std::vector<ReachSphere> spheres{{{0, 0, 0}, 10}};
    const MaskTree::Ptr touched = touchedBy(spheres, {}, -1);
    EXPECT_THROW(detail::storedReach(spheres, detail::MaskMinus(*touched, object), object,
                     detail::NearestVoxel(object), -1, &stop),
        Interrupted);
}

} // namespace
