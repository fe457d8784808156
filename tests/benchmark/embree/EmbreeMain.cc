// SPDX-License-Identifier: Apache-2.0
/// @file EmbreeMain.cc
/// @brief Rays, points and batches of spheres against a tree, timed against Embree on the same spheres and on a
/// mesh of the same voxels: one thread, contenders by turns.
///
///     spheretree_benchmark_embree ROUNDS TREE.vdb...
///
/// Rays come from all around, each aimed at a random place of the box (incoherent), or from one place through a
/// grid (camera). Points fill the box made 1.3 times as large, or lie near the surface. A configuration is 64 spheres along a
/// walk, as those of a robot are.

#include "AlternatingTimes.h"
#include "EmbreeScenes.h"

#include <openvdb_spheretree/query/DigitalLeaves.h>
#include <openvdb_spheretree/query/PointQuery.h>
#include <openvdb_spheretree/query/RayQuery.h>
#include <openvdb_spheretree/query/SphereDistances.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>

#include <openvdb/openvdb.h>
#include <openvdb/io/File.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_benchmark;
using openvdb::Vec3d;
using openvdb::Vec3s;

constexpr int kQuestions = 20000, kRobots = 500, kSpheres = 64;

struct FloatRay {
    Vec3s origin, direction;
    QueryRay query() const { return {Vec3d(origin), Vec3d(direction)}; }
};

/// What is asked of one tree.
class Questions {
public:
    explicit Questions(const QueryTree& tree) : mTree(tree)
    {
        for (int32_t i = 0; i < tree.leafCount(); ++i) {
            mBox.expand(tree.leafCenter(i) - Vec3d(tree.leafRadius(i)));
            mBox.expand(tree.leafCenter(i) + Vec3d(tree.leafRadius(i)));
        }
        mRadius = (mBox.max() - mBox.min()).length() / 2;
    }

    std::vector<FloatRay> raysFromAround()
    {
        std::vector<FloatRay> rays;
        for (int i = 0; i < kQuestions; ++i) {
            rays.push_back(aimed(mBox.getCenter() + 1.5 * mRadius * direction(), placeIn(1)));
        }
        return rays;
    }
    std::vector<FloatRay> raysOfCamera() const
    {
        const int side = int(std::sqrt(double(kQuestions)));
        const Vec3d eye = mBox.getCenter() + mRadius * Vec3d(1.2, 0.6, 2),
                    size = mBox.max() - mBox.min();
        std::vector<FloatRay> rays;
        for (int i = 0; i < side * side; ++i) {
            const double u = (i % side + 0.5) / side, v = (i / side + 0.5) / side;
            const Vec3d target(
                mBox.min()[0] + u * size[0], mBox.min()[1] + v * size[1], mBox.getCenter()[2]);
            rays.push_back(aimed(eye, target));
        }
        return rays;
    }
    std::vector<Vec3s> pointsInBox()
    {
        std::vector<Vec3s> points;
        for (int i = 0; i < kQuestions; ++i) points.push_back(Vec3s(placeIn(1.3)));
        return points;
    }
    /// @param mesh   of the surface
    /// @param voxel  points are some three voxels off
    std::vector<Vec3s> pointsNearSurface(const TriangleList& mesh, double voxel)
    {
        std::vector<Vec3s> points;
        for (int i = 0; i < kQuestions; ++i) {
            const auto& p = mesh.points[std::size_t(unit() * double(mesh.points.size()))];
            points.push_back(Vec3s(Vec3d(p[0], p[1], p[2]) + 3 * voxel * normal()));
        }
        return points;
    }
    std::vector<float> robots(double voxel)
    {
        std::vector<float> spheres;
        for (int c = 0; c < kRobots; ++c) {
            Vec3d at = mBox.getCenter() + mRadius * (0.6 + 0.6 * unit()) * direction();
            for (int i = 0; i < kSpheres; ++i) {
                at += 2 * voxel * normal();
                for (int axis = 0; axis < 3; ++axis) spheres.push_back(float(at[axis]));
                spheres.push_back(float(voxel * (2 + 4 * unit())));
            }
        }
        return spheres;
    }

private:
    double unit() { return double(mRandom()) / 4294967296.0; }
    Vec3d normal()
    {
        std::normal_distribution<double> gauss;
        const double x = gauss(mRandom), y = gauss(mRandom);
        return Vec3d(x, y, gauss(mRandom));
    }
    Vec3d direction() { return normal().unit(); }
    Vec3d placeIn(double times)
    {
        Vec3d place;
        for (int axis = 0; axis < 3; ++axis) {
            place[axis] =
                mBox.getCenter()[axis] + times * (unit() - 0.5) * (mBox.max() - mBox.min())[axis];
        }
        return place;
    }
    static FloatRay aimed(const Vec3d& from, const Vec3d& at)
    {
        return {Vec3s(from), Vec3s((at - from).unit())};
    }

    const QueryTree& mTree;
    openvdb::math::BBox<Vec3d> mBox;
    double mRadius;
    std::mt19937 mRandom{5};
};

/// Sums ask(question) over all questions.
template <typename Question, typename Ask>
Contender contender(const std::string& name, const std::vector<Question>& questions, const Ask& ask)
{
    return {name, [&questions, ask] {
                double sum = 0;
                for (const Question& question : questions) sum += ask(question);
                return sum;
            }};
}

/// Where a hit is, and 0 of a miss, so that means can be compared.
double orZero(double t) { return std::isfinite(t) ? t : 0; }

void compareRays(const std::string& kind, const std::vector<FloatRay>& rays, const QueryTree& tree,
    const EmbreeScene& spheres, const EmbreeScene& mesh, int rounds)
{
    std::vector<QueryRay> queries;
    for (const FloatRay& ray : rays) queries.push_back(ray.query());
    const Contender stream{"rays, as a stream", [&] {
                               std::vector<RayHit> hits(queries.size());
                               intersect(tree, queries.data(), queries.size(), hits.data());
                               double sum = 0;
                               for (const RayHit& hit : hits) sum += orZero(hit.t);
                               return sum;
                           }};
    printTimes("nearest hit, " + kind,
        {contender(
             "rays", queries, [&](const QueryRay& r) { return orZero(intersect(tree, r).t); }),
            stream,
            contender("Embree spheres", rays,
                [&](const FloatRay& r) {
                    return orZero(spheres.intersect(r.origin.asPointer(), r.direction.asPointer()));
                }),
            contender("Embree mesh", rays,
                [&](const FloatRay& r) {
                    return orZero(mesh.intersect(r.origin.asPointer(), r.direction.asPointer()));
                })},
        rays.size(), rounds);
    printTimes("any hit, " + kind,
        {contender("rays", queries, [&](const QueryRay& r) { return occluded(tree, r); }),
            contender("Embree spheres", rays,
                [&](const FloatRay& r) {
                    return spheres.occluded(r.origin.asPointer(), r.direction.asPointer());
                }),
            contender("Embree mesh", rays,
                [&](const FloatRay& r) {
                    return mesh.occluded(r.origin.asPointer(), r.direction.asPointer());
                })},
        rays.size(), rounds);
    double blocks = 0;
    for (const QueryRay& ray : queries) blocks += intersect(tree, ray).blocks;
    std::printf("    blocks a ray: %.3f\n", blocks / double(rays.size()));
}

void comparePoints(const std::string& kind, const std::vector<Vec3s>& points, const QueryTree& tree,
    const DigitalLeaves& leaves, const EmbreeScene& balls, double voxel, int rounds)
{
    const float cutoff = float(5 * voxel), infinity = std::numeric_limits<float>::infinity();
    printTimes("signed distance of points, " + kind,
        {contender(
             "points", points, [&](const Vec3s& p) { return nearest(tree, Vec3d(p)).distance; }),
            contender("Embree rtcPointQuery, spheres (unsigned)", points,
                [&](const Vec3s& p) { return balls.distance(p.asPointer(), infinity); })},
        points.size(), rounds);
    printTimes("the same, no farther than 5 voxels, " + kind,
        {contender("points", points,
             [&](const Vec3s& p) { return nearest(tree, Vec3d(p), cutoff).distance; }),
            contender("Embree rtcPointQuery, spheres (unsigned)", points,
                [&](const Vec3s& p) { return balls.distance(p.asPointer(), cutoff); })},
        points.size(), rounds);
    printTimes("inside?, " + kind,
        {contender(
             "leaf spheres", points, [&](const Vec3s& p) { return meetsBall(tree, Vec3d(p), 0); }),
            contender("the object, exactly", points,
                [&](const Vec3s& p) { return contains(tree, leaves, Vec3d(p)); })},
        points.size(), rounds);
    double blocks = 0;
    for (const Vec3s& point : points) blocks += nearest(tree, Vec3d(point)).blocks;
    std::printf("    blocks a distance: %.3f\n", blocks / double(points.size()));
}

void timeRobots(const std::vector<float>& spheres, const QueryTree& tree, double voxel, int rounds)
{
    const std::size_t count = spheres.size() / 4;
    std::vector<float> distance(count), gradient(3 * count);
    std::vector<int32_t> leaf(count);
    std::vector<uint8_t> touching(kRobots);
    const float activation = float(5 * voxel);
    printTimes(
        "a sphere of a robot: distance and gradient within 5 voxels (mean: of those that are)",
        {{"spheres",
            [&] {
                sphereDistances(tree, spheres.data(), count, activation,
                    {distance.data(), gradient.data(), leaf.data()});
                return double(count - std::size_t(std::count(leaf.begin(), leaf.end(), -1)));
            }}},
        count, rounds);
    printTimes("a configuration of 64 spheres: does it touch? (mean: of those that do)",
        {{"configurations",
            [&] {
                spheresTouch(tree, spheres.data(), kRobots, kSpheres, touching.data());
                return double(std::count(touching.begin(), touching.end(), 1));
            }}},
        kRobots, rounds);
}

SphereTree readTree(const std::string& path)
{
    openvdb::io::File file(path);
    file.open();
    const openvdb::GridPtrVecPtr grids = file.getGrids();
    for (const auto& grid : *grids) {
        if (const auto points = openvdb::GridBase::grid<openvdb::points::PointDataGrid>(grid))
            return fromPoints(*points);
    }
    OPENVDB_THROW(openvdb::IoError, path << " holds no sphere-tree");
}

void compare(const std::string& path, int rounds)
{
    const SphereTree tree = readTree(path);
    const QueryTree queries = makeQueryTree(tree);
    const DigitalLeaves leaves(tree);
    const auto balls = leafBalls(queries);
    const TriangleList mesh = meshOfObject(tree);
    std::printf(
        "== %s: %zu leaf spheres, %.1f bytes each (%.1f more for exact insides), %zu triangles\n",
        path.c_str(), balls.size(), double(queries.bytes()) / double(balls.size()),
        double(leaves.bytes()) / double(balls.size()), mesh.triangles.size());
    const EmbreeScene sphereScene = EmbreeScene::ofSpheres(balls),
                      meshScene = EmbreeScene::ofMesh(mesh),
                      pointScene = EmbreeScene::forPoints(balls);
    Questions questions(queries);
    const double voxel = tree.voxelSize();
    compareRays("incoherent", questions.raysFromAround(), queries, sphereScene, meshScene, rounds);
    compareRays("camera", questions.raysOfCamera(), queries, sphereScene, meshScene, rounds);
    comparePoints(
        "in the box", questions.pointsInBox(), queries, leaves, pointScene, voxel, rounds);
    comparePoints("near the surface", questions.pointsNearSurface(mesh, voxel), queries, leaves,
        pointScene, voxel, rounds);
    timeRobots(questions.robots(voxel), queries, voxel, rounds);
}

} // namespace

int main(int count, char** arguments)
try {
    if (count < 3) {
        std::fprintf(stderr, "usage: spheretree_benchmark_embree ROUNDS TREE.vdb...\n");
        return 2;
    }
    openvdb::initialize();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    for (int i = 2; i < count; ++i) compare(arguments[i], std::atoi(arguments[1]));
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "spheretree_benchmark_embree: %s\n", error.what());
    return 1;
}
