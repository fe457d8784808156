// SPDX-License-Identifier: Apache-2.0
/// @file EmbreeMain.cc
/// @brief Rays, points and batches of spheres against a tree, timed against Embree on the same
/// spheres and on a mesh of the same voxels: one thread, contenders by turns.
///
///     spheretree_benchmark_embree ROUNDS TREE.vdb...
///
/// Rays come from all around, each aimed at a random place of the box (incoherent), or from one
/// place through a grid (camera). Points fill the box made 1.3 times as large, or lie near the
/// surface. A configuration is 64 spheres along a walk, as those of a robot are. docs/queries.md
/// has the results.

#include "AlternatingTimes.h"
#include "DenseField.h"
#include "EmbreeScenes.h"
#include "Questions.h"
#include "RayPackets.h"

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
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_benchmark;
using openvdb::Vec3d;
using openvdb::Vec3s;

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

template <typename Question, typename Blocks>
double meanBlocks(const std::vector<Question>& questions, const Blocks& blocks)
{
    double sum = 0;
    for (const Question& question : questions) sum += blocks(question);
    return sum / double(questions.size());
}

/// Where a hit is, and 0 of a miss, so that means can be compared.
double orZero(double t) { return std::isfinite(t) ? t : 0; }

std::vector<QueryRay> queriesOf(const std::vector<FloatRay>& rays)
{
    std::vector<QueryRay> queries;
    for (const FloatRay& ray : rays) queries.push_back(ray.query());
    return queries;
}

/// A tree and its contenders.
class Contest {
public:
    Contest(const SphereTree& tree, int rounds)
        : mTree(makeQueryTree(tree)), mPlain(plainTree(tree)), mLeaves(tree),
          mBalls(leafBalls(mTree)), mMesh(meshOfObject(tree)), mVoxel(tree.voxelSize()),
          mRounds(rounds), mSphereScene(EmbreeScene::ofSpheres(mBalls)),
          mMeshScene(EmbreeScene::ofMesh(mMesh)), mPointScene(EmbreeScene::forPoints(mBalls)),
          mField(mTree, cornerOf(-1), cornerOf(1), mVoxel)
    {}

    void run() const
    {
        const double count = double(mBalls.size());
        std::printf(
            "%zu leaf spheres, %.1f bytes each (%.1f more for exact insides), %zu triangles\n",
            mBalls.size(), double(mTree.bytes()) / count, double(mLeaves.bytes()) / count,
            mMesh.triangles.size());
        if (mField.isThere())
            std::printf("dense field: %.1f bytes a leaf sphere\n", double(mField.bytes()) / count);
        Questions questions(mTree);
        compareRays("incoherent", questions.raysFromAround());
        compareRays("camera", questions.raysOfCamera());
        comparePoints("in the box", questions.pointsInBox());
        comparePoints("near the surface", questions.pointsNearSurface(mMesh, mVoxel));
        timeRobots(questions.robots(mVoxel));
        compareMany("incoherent", questions.raysFromAround());
        compareMany("camera, in tiles of 4 x 4", questions.raysOfCameraInTiles());
    }

private:
    /// @return a corner of the box that points are asked in.
    Vec3d cornerOf(double side) const
    {
        openvdb::math::BBox<Vec3d> box;
        for (const SceneBall& b : mBalls) {
            box.expand(Vec3d(b.x, b.y, b.z) - Vec3d(b.r));
            box.expand(Vec3d(b.x, b.y, b.z) + Vec3d(b.r));
        }
        return box.getCenter() + side * 0.65 * (box.max() - box.min());
    }

    /// A hierarchy over the same leaves that knows nothing of the tree: what is slower with it, the
    /// tree has made faster.
    static QueryTree plainTree(const SphereTree& tree)
    {
        QueryTreeSettings settings;
        settings.exactness = Exactness::LeafUnion;
        return makeQueryTree(keepLevel(tree, 0), settings);
    }

    void compareRays(const std::string& kind, const std::vector<FloatRay>& rays) const
    {
        const std::vector<QueryRay> queries = queriesOf(rays);
        const auto nearestOf = [](const QueryTree& tree) {
            return [&tree](const QueryRay& ray) { return orZero(intersect(tree, ray).t); };
        };
        const auto nearestIn = [](const EmbreeScene& scene) {
            return [&scene](const FloatRay& ray) {
                return orZero(scene.intersect(ray.origin.asPointer(), ray.direction.asPointer()));
            };
        };
        printTimes("nearest hit, " + kind,
            {contender("rays", queries, nearestOf(mTree)),
                contender("rays, plain hierarchy over the leaves", queries, nearestOf(mPlain)),
                contender("Embree spheres", rays, nearestIn(mSphereScene)),
                contender("Embree mesh", rays, nearestIn(mMeshScene))},
            rays.size(), mRounds);
        const auto anyIn = [](const EmbreeScene& scene) {
            return [&scene](const FloatRay& ray) {
                return scene.occluded(ray.origin.asPointer(), ray.direction.asPointer());
            };
        };
        printTimes("any hit, " + kind,
            {contender("rays", queries, [&](const QueryRay& ray) { return occluded(mTree, ray); }),
                contender("Embree spheres", rays, anyIn(mSphereScene)),
                contender("Embree mesh", rays, anyIn(mMeshScene))},
            rays.size(), mRounds);
        const auto blocksOf = [&](const QueryTree& tree) {
            return meanBlocks(
                queries, [&](const QueryRay& ray) { return intersect(tree, ray).blocks; });
        };
        std::printf("    blocks a ray: %.3f, plain %.3f\n", blocksOf(mTree), blocksOf(mPlain));
    }

    /// Embree is told that the rays are coherent, and that they are not: the better of both is its time.
    void compareMany(const std::string& kind, const std::vector<FloatRay>& rays) const
    {
        const std::vector<QueryRay> queries = queriesOf(rays);
        std::vector<RayHit> hits(rays.size());
        std::vector<Contender> contenders{
            {"many rays", [&] {
                 intersect(mTree, queries.data(), queries.size(), hits.data());
                 double sum = 0;
                 for (const RayHit& hit : hits) sum += orZero(hit.t);
                 return sum;
             }}};
        const RayPackets<RTCRayHit8> eights(rays);
        const RayPackets<RTCRayHit16> sixteens(rays);
        const RayStream stream(rays);
        const auto add = [&](const std::string& how, const auto& many) {
            for (const auto* scene : {&mSphereScene, &mMeshScene}) {
                for (const auto flags :
                    {RTC_INTERSECT_CONTEXT_FLAG_COHERENT, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT}) {
                    const bool isCoherent = flags == RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
                    contenders.push_back(
                        {std::string("Embree ") + (scene == &mSphereScene ? "spheres, " : "mesh, ")
                                + how + (isCoherent ? ", coherent" : ""),
                            [&many, scene, flags] { return many.sumOfHits(*scene, flags); }});
                }
            }
        };
        add("packets of 8", eights);
        add("packets of 16", sixteens);
        add("a stream", stream);
        printTimes("many rays, nearest hit, " + kind, contenders, rays.size(), mRounds);
    }

    void comparePoints(const std::string& kind, const std::vector<Vec3s>& points) const
    {
        for (const double voxels : {std::numeric_limits<double>::infinity(), 5.0}) {
            const double cutoff = voxels * mVoxel;
            const auto distanceOf = [cutoff](const QueryTree& tree) {
                return [&tree, cutoff](const Vec3s& point) {
                    return nearest(tree, Vec3d(point), cutoff).distance;
                };
            };
            const std::string title = std::isinf(voxels) ? "" : ", no farther than 5 voxels";
            std::vector<Contender> contenders{contender("points", points, distanceOf(mTree)),
                contender("points, plain hierarchy over the leaves", points, distanceOf(mPlain)),
                contender(
                    "Embree rtcPointQuery, spheres (any depth)", points, [&](const Vec3s& point) {
                        return mPointScene.distance(point.asPointer(), float(cutoff));
                    })};
            if (mField.isThere()) {
                contenders.push_back(contender(
                    "dense field of distances, interpolated", points, [&](const Vec3s& point) {
                        return std::min(double(mField.at(point)), cutoff);
                    }));
            }
            printTimes(
                "signed distance of points, " + kind + title, contenders, points.size(), mRounds);
        }
        printTimes("inside?, " + kind,
            {contender("leaf spheres", points,
                 [&](const Vec3s& point) { return meetsBall(mTree, Vec3d(point), 0); }),
                contender("the object, exactly", points,
                    [&](const Vec3s& point) { return contains(mTree, mLeaves, Vec3d(point)); })},
            points.size(), mRounds);
        const auto blocksOf = [&](const QueryTree& tree) {
            return meanBlocks(
                points, [&](const Vec3s& point) { return nearest(tree, Vec3d(point)).blocks; });
        };
        std::printf("    blocks a distance: %.3f, plain %.3f\n", blocksOf(mTree), blocksOf(mPlain));
    }

    void timeRobots(const std::vector<float>& spheres) const
    {
        const std::size_t count = spheres.size() / 4;
        std::vector<float> distance(count), gradient(3 * count);
        std::vector<int32_t> leaf(count);
        const Contender distances{
            "spheres", [&] {
                const SphereDistanceArrays results{distance.data(), gradient.data(), leaf.data()};
                sphereDistances(mTree, spheres.data(), count, float(5 * mVoxel), results);
                return double(count) - double(std::count(leaf.begin(), leaf.end(), -1));
            }};
        printTimes(
            "a sphere of a robot: distance and gradient within 5 voxels (mean: of those that are)",
            {distances}, count, mRounds);
        std::vector<uint8_t> touching(kRobots);
        const Contender touches{"configurations", [&] {
                                    spheresTouch(
                                        mTree, spheres.data(), kRobots, kSpheres, touching.data());
                                    return double(std::count(touching.begin(), touching.end(), 1));
                                }};
        printTimes("a configuration of 64 spheres: does it touch? (mean: of those that do)",
            {touches}, kRobots, mRounds);
    }

    const QueryTree mTree, mPlain;
    const DigitalLeaves mLeaves;
    const std::vector<SceneBall> mBalls;
    const TriangleList mMesh;
    const double mVoxel;
    const int mRounds;
    const EmbreeScene mSphereScene, mMeshScene, mPointScene;
    const DenseField mField;
};

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

} // namespace

int main(int count, char** arguments)
try {
    if (count < 3) {
        std::fprintf(stderr, "usage: spheretree_benchmark_embree ROUNDS TREE.vdb...\n");
        return 2;
    }
    openvdb::initialize();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    for (int i = 2; i < count; ++i) {
        std::printf("== %s\n", arguments[i]);
        Contest(readTree(arguments[i]), std::atoi(arguments[1])).run();
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "spheretree_benchmark_embree: %s\n", error.what());
    return 1;
}
