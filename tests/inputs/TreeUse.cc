// SPDX-License-Identifier: Apache-2.0
#include "TreeUse.h"

#include "VdbSamples.h"

#include <openvdb_spheretree/chart/ErrorChart.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/export/ExportTree.h>
#include <openvdb_spheretree/measure/MassProperties.h>
#include <openvdb_spheretree/picture/SpherePicture.h>
#include <openvdb_spheretree/query/BodyDistance.h>
#include <openvdb_spheretree/query/Collide.h>
#include <openvdb_spheretree/query/ContinuousCollide.h>
#include <openvdb_spheretree/query/PointQuery.h>
#include <openvdb_spheretree/query/QueryTree.h>
#include <openvdb_spheretree/query/RayQuery.h>
#include <openvdb_spheretree/store/SphereTreeCsv.h>
#include <openvdb_spheretree/store/SphereTreeJson.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/tree/GivenTree.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>
#include <openvdb_spheretree/tree/SphereLevelSet.h>
#include <openvdb_spheretree/tree/SphereTracks.h>
#include <openvdb_spheretree/viewer/TreeViewer.h>

#include <openvdb/Exceptions.h>
#include <openvdb/Grid.h>

#include <algorithm>
#include <functional>
#include <ostream>
#include <streambuf>
#include <vector>

namespace spheretree_test {

using namespace openvdb_spheretree;
using openvdb::Vec3d;

namespace {

/// Takes all that is written to it, and keeps nothing.
class NoBuffer : public std::streambuf {
protected:
    int_type overflow(int_type c) override { return traits_type::not_eof(c); }
    std::streamsize xsputn(const char*, std::streamsize count) override { return count; }
};

class NoStream : public std::ostream {
public:
    NoStream() : std::ostream(&mBuffer) {}

private:
    NoBuffer mBuffer;
};

/// Runs a use of the tree, which may be refused.
template <typename Use>
void attempt(const Use& use)
{
    try {
        use();
    } catch (const openvdb::ValueError&) {
    } catch (const openvdb::ArithmeticError&) { // OpenVDB's, of transforms that have no inverse
    }
}

void drawSmall(const SphereTree& tree, int level)
{
    PictureSettings settings;
    settings.width = settings.height = 4;
    settings.samples = 2;
    settings.lightRays = 1;
    const Camera camera = viewOf(tree.object.bbox, *tree.transform, {0, 1, 0}, 40, 1);
    renderLevel(tree, level, camera, settings);
}

/// Alone; and twice, as the links of a robot or as samples over time.
void exportTo(const ExportFormat& format, const SphereTree& tree)
{
    if (!format.missing.empty()) return;
    NoStream out;
    attempt([&] { exportTree(tree, format, {}, out); });
    ExportSettings settings;
    settings.frame = ExportFrame::Principal;
    settings.scale = 1000;
    if (!tree.levels.empty()) settings.level = tree.root().level;
    attempt([&] { exportTree(tree, format, settings, out); });
    settings = {};
    settings.spheres = 5;
    attempt([&] { exportTree(tree, format, settings, out); });
    if (!format.links && !format.samples) return;
    settings.links = {"left", "right"};
    attempt([&] { exportTrees({&tree, &tree}, format, settings, out); });
}

void makePage(const SphereTree& tree)
{
    NoStream out;
    ViewerSettings settings;
    settings.triangles = 100;
    attempt([&] { writeViewer(tree, nullptr, settings, out); });
    attempt([&] { writeViewer(tree, sampleObject().get(), settings, out); });
}

void makeChart(const SphereTree& tree)
{
    NoStream out;
    const auto curves = withOwnNames({errorCurve(tree), errorCurve(tree)});
    attempt([&] { writeChartSvg(curves, {}, out); });
    attempt([&] { writeChartCsv(curves, out); });
    if (drawsCharts()) attempt([&] { drawChart(curves, {64, 48}); });
}

void keepParts(const SphereTree& tree)
{
    for (const SphereTreeLevel& level : tree.levels) {
        attempt([&] { toPoints(keepLevel(tree, level.level)); });
    }
    for (const int64_t spheres : {0, 1, 5, 1000}) {
        attempt([&] { toPoints(keepSpheres(tree, spheres)); });
    }
    attempt([&] { toPoints(givenTree(worldSpheres(tree))); });
    attempt([&] { toPoints(givenTree(worldSpheres(tree), *sampleObject())); });
}

void followTracks(const SphereTree& tree)
{
    SphereTree next = tree;
    attempt([&] { continueTracks(next, tree); });
    attempt([&] { movementSince(tree, next); });
    attempt([&] { toPoints(next); });
}

void weigh(const SphereTree& tree)
{
    for (const SphereTreeLevel& level : tree.levels) {
        attempt([&] { massProperties(tree, level); });
    }
}

/// With voxels of the tree where these are few; else as large as a part of the largest sphere. What the library allows takes
/// gigabytes.
void makeLevelSets(const SphereTree& tree)
{
    constexpr double kMost = 1e5, kBand = 4;
    for (const SphereTreeLevel& level : tree.levels) {
        double voxels = 0, largest = 0;
        for (int32_t id = level.begin; id < level.end; ++id) {
            const double radius = tree.spheres.radiusWorld[std::size_t(id)];
            const double side = 2 * (radius / tree.voxelSize() + kBand);
            voxels += side * side * side;
            largest = std::max(largest, radius);
        }
        if (voxels < kMost) attempt([&] { levelSetOfSpheres(tree, level); });
        attempt([&] { levelSetOfSpheres(tree, level, std::max(largest / 3, 1e-4), 1); });
    }
}

void askPair(const QueryTree& tree)
{
    constexpr int64_t kBlocks = 100000;
    const RigidTransform start;
    const auto away = RigidTransform::fromTranslation(Vec3d(3 * tree.radius(), 0, 0));
    CollisionRequest several;
    several.maxContacts = 4;
    several.enableDistanceLowerBound = several.decideObjects = true;
    several.maxBlocks = kBlocks;
    attempt([&] {
        std::vector<Contact> contacts;
        collide(tree, start, tree, start, several, &contacts);
    });
    DistanceRequest nearest;
    nearest.enableSignedDistance = true;
    nearest.maxBlocks = kBlocks;
    for (const RigidTransform& pose : {start, away}) {
        attempt([&] { distance(tree, start, tree, pose, nearest); });
    }
    ContinuousCollisionRequest first;
    first.maxBlocks = kBlocks;
    const Vec3d back(-3 * tree.radius(), 0, 0);
    attempt([&] { continuousCollide(tree, start, tree, RigidMotion::line(away, back), first); });
    attempt([&] { continuousCollide(tree, start, tree, RigidMotion::screw(away, start), first); });
}

void askPointsAndRays(const QueryTree& tree)
{
    for (const Vec3d& point : {tree.center(), Vec3d(0.5), Vec3d(1e6)}) {
        attempt([&] { nearest(tree, point); });
        attempt([&] { meetsBall(tree, point, 1); });
        for (const bool leavesStart : {false, true}) {
            QueryRay ray{point, tree.center() - point + Vec3d(0.1, 0.2, 0.3)};
            ray.leavesStart = leavesStart;
            attempt([&] { intersect(tree, ray); });
            attempt([&] { occluded(tree, ray); });
        }
    }
}

void ask(const SphereTree& tree, const QueryTreeSettings& settings)
{
    attempt([&] {
        const QueryTree asked = makeQueryTree(tree, settings);
        askPair(asked);
        askPointsAndRays(asked);
    });
}

using Use = std::function<void(const SphereTree&)>;

std::vector<Use> makeUses()
{
    std::vector<Use> uses = {makePage, makeChart, keepParts, followTracks, weigh, makeLevelSets,
        [](const SphereTree& tree) { ask(tree, {}); },
        [](const SphereTree& tree) {
            ask(tree, {Exactness::LeafUnion, tree.root().level, /*scale=*/2});
        }};
    for (const ExportFormat& format : exportFormats()) {
        uses.push_back([&format](const SphereTree& tree) { exportTo(format, tree); });
    }
    return uses;
}

/// That of no object, which formats with room for none have.
void useEmptyTree(const SphereTree& tree)
{
    for (const ExportFormat& format : exportFormats()) exportTo(format, tree);
    makeChart(tree);
}

} // namespace

void useTree(const SphereTree& tree, uint64_t turn)
{
    if (tree.levels.empty()) return useEmptyTree(tree);
    static const std::vector<Use> uses = makeUses();
    NoStream out;
    attempt([&] { checkSphereTree(tree, *sampleObject()); });
    attempt([&] { toPoints(tree); });
    attempt([&] { dagToPoints(tree); });
    attempt([&] { cutsToPoints(tree); });
    attempt([&] { writeCsv(tree, out); });
    attempt([&] { writeJson(tree, out); });
    // The check has painted every level.
    const SphereTreeLevel& level = tree.levels[turn % tree.levels.size()];
    attempt([&] { levelUnion(tree, level); });
    attempt([&] { drawSmall(tree, level.level); });
    for (std::size_t i = turn % kUseTurns; i < uses.size(); i += kUseTurns) uses[i](tree);
}

} // namespace spheretree_test
