// SPDX-License-Identifier: Apache-2.0
#include "MeshSolid.h"

#include <openvdb_spheretree/base/EmptyObject.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/index/NearestVoxel.h>
#include <openvdb_spheretree/mesh/MeshHoles.h>
#include <openvdb_spheretree/mesh/TriangleVoxels.h>
#include <openvdb_spheretree/solid/WindingNumber.h>
#include <openvdb_spheretree/pyramid/BallMorphology.h>
#include <openvdb_spheretree/pyramid/Closing.h>
#include <openvdb_spheretree/topology/ObjectParts.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>
#include <openvdb_spheretree/voxel/TopologyCopy.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <vector>

namespace openvdb_spheretree {

namespace {

using openvdb::MaskTree;
using openvdb::Vec3d;
using openvdb::util::NullInterrupter;

/// @return how many nodes of so many voxels along a side the mesh has points in.
double nodesWithPoints(const TriangleMesh& mesh, double voxelSize, double side)
{
    using Place = std::array<double, 3>;
    std::vector<Place> places;
    for (const Vec3d& point : mesh.points) {
        Place place;
        for (int a = 0; a < 3; ++a) {
            place[std::size_t(a)] = std::floor(point[a] / (side * voxelSize));
        }
        // Most points follow one of the same node.
        if (places.empty() || places.back() != place) places.push_back(place);
    }
    std::sort(places.begin(), places.end());
    return double(std::unique(places.begin(), places.end()) - places.begin());
}

/// A surface has a leaf of 8^3 voxels for each 64 faces of voxels of its area, and as many as an edge is long,
/// at the least, and three trees of them are held at a time; by its box it cannot have more. Nodes above the
/// leaves count where parts are far apart.
void requireRoomForSurface(const TriangleMesh& mesh, double voxelSize)
{
    constexpr double kTrees = 3, kLeafBytes = 100, kLowerBytes = 34e3, kUpperBytes = 270e3;
    const double leaf = 8 * voxelSize;
    const Vec3d sides = boxOf(mesh).extents() / leaf + Vec3d(1);
    const double leaves = std::min(std::max(areaOf(mesh) / (leaf * leaf), longestEdge(mesh) / leaf),
        sides[0] * sides[1] * sides[2]);
    const double lower = nodesWithPoints(mesh, voxelSize, 128);
    const double upper = nodesWithPoints(mesh, voxelSize, 4096);
    const double bytes = kTrees * (leaves * kLeafBytes + lower * kLowerBytes + upper * kUpperBytes);
    const Vec3d voxels = boxOf(mesh).extents() / voxelSize + Vec3d(1);
    detail::TextStream what;
    what << "the voxels at the surface of mesh '" << mesh.name << "', in a box of "
         << std::setprecision(2) << voxels[0] * voxels[1] * voxels[2] << " voxels,";
    detail::requireMemory(bytes, what.str(), "use a larger voxel");
}

/// @return the radius of the ball that closes holes of this width, in voxels.
int radiusFor(double gap, double voxelSize)
{
    if (gap == 0) return 0;
    const double radius = std::ceil(gap / voxelSize / 2 + std::sqrt(0.75) + 0.5);
    if (gap > 0 && radius <= kMaxClosing) return int(radius);
    OPENVDB_THROW(openvdb::ValueError,
        "gap=" << gap << " is out of range: it must be 0 to " << 2 * kMaxClosing - 3
               << " voxels of " << voxelSize);
}

/// The surface, and of what it keeps from outside that which the mesh winds around: not a room whose neck is
/// narrower than a voxel, nor a hollow.
MaskTree::Ptr woundAround(
    const MaskTree& surface, const IndexMesh& mesh, NullInterrupter* interrupter)
{
    const auto isInside = [&](const std::vector<openvdb::Coord>& voxels) {
        std::vector<bool> inside;
        for (const int number : windingNumbers(mesh, voxels, interrupter)) {
            inside.push_back(number != 0);
        }
        return inside;
    };
    return filledCavities(surface, isInside, interrupter);
}

/// All that a ball cannot reach from outside.
MaskTree::Ptr solidOf(const MaskTree& surface, int radius, NullInterrupter* interrupter)
{
    if (radius == 0) return filledCavities(surface, interrupter);
    MaskTree::Ptr walls = std::make_shared<MaskTree>(surface);
    walls->topologyUnion(*detail::voxelsNear(surface, radius, 3, "gap", interrupter));
    const MaskTree::Ptr solid = filledCavities(*walls, interrupter);
    // What is within the radius of a voxel outside is so of the walls, which are between, too.
    walls->topologyUnion(*detail::voxelsNear(*walls, radius, 3, "gap", interrupter));
    detail::erodeAround(*solid, *walls, radius, 3, interrupter);
    return solid;
}

} // namespace

openvdb::BoolGrid::Ptr meshToObject(const TriangleMesh& mesh, double voxelSize,
    const MeshSolidSettings& settings, NullInterrupter* interrupter)
{
    const openvdb::math::Transform::Ptr transform = transformOfVoxels(voxelSize);
    const int radius = radiusFor(settings.gap, voxelSize);
    if (settings.coverage == Coverage::Centers) {
        OPENVDB_THROW(openvdb::ValueError, "voxels by their centers are those of meshToLevelSet()");
    }
    requireUsableMesh(mesh, voxelSize);
    requireRoomForSurface(mesh, voxelSize);
    const IndexMesh triangles = toIndexSpace(mesh, *transform);
    const MaskTree::Ptr surface = trianglesToVoxels(triangles, interrupter);
    const bool isWhole = settings.coverage == Coverage::Whole;
    const MaskTree::Ptr solid = isWhole && radius == 0
        ? woundAround(*surface, triangles, interrupter)
        : solidOf(*surface, radius, interrupter);
    if (isWhole) solid->topologyDifference(*surface);
    openvdb::tools::prune(*solid);
    if (solid->empty()) {
        OPENVDB_THROW(EmptyObject,
            "no voxel of " << voxelSize << " lies wholly inside mesh '" << mesh.name
                           << "': use a smaller voxel");
    }
    openvdb::BoolGrid::Ptr object =
        openvdb::BoolGrid::create(detail::copyTopology<openvdb::BoolTree>(*solid, interrupter));
    object->setTransform(transform);
    object->setName(mesh.name);
    setCoverage(*object, settings.coverage);
    return object;
}

double hollowShare(const TriangleMesh& mesh, const openvdb::BoolGrid& object)
{
    constexpr double kPoints = 4096, kMostRows = 64, kAway = 2; // voxels
    const IndexMesh triangles = toIndexSpace(mesh, object.transform());
    const auto corner = [&](const openvdb::Vec3I& t, int i) { return triangles.points[t[i]]; };
    const auto normalOf = [&](const openvdb::Vec3I& t) {
        return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
    };
    double all = 0, hollow = 0; // twice the area
    for (const openvdb::Vec3I& t : triangles.triangles) all += normalOf(t).length();
    const auto values = object.getConstAccessor();
    for (const openvdb::Vec3I& t : triangles.triangles) {
        const Vec3d normal = normalOf(t);
        const double area = normal.length();
        if (!(area > 0)) continue;
        const Vec3d away = kAway / area * normal;
        // The middles of the small triangles of a grid that stand as the large one does.
        const auto rows = int(std::clamp(std::sqrt(kPoints * area / all), 1.0, kMostRows));
        int points = 0, bare = 0;
        for (int i = 0; i < rows; ++i) {
            for (int j = 0; i + j < rows; ++j, ++points) {
                const double u = (i + 1.0 / 3) / rows, v = (j + 1.0 / 3) / rows;
                const Vec3d at = corner(t, 0) + u * (corner(t, 1) - corner(t, 0))
                    + v * (corner(t, 2) - corner(t, 0));
                bare += !values.isValueOn(openvdb::Coord::round(at + away))
                    && !values.isValueOn(openvdb::Coord::round(at - away));
            }
        }
        hollow += area * bare / points;
    }
    return all > 0 ? hollow / all : 0;
}

std::string hollowWarning(const TriangleMesh& mesh, const openvdb::BoolGrid& object, double gap,
    NullInterrupter* interrupter)
{
    constexpr double kMuch = 0.25, kSome = 0.05, kBeyond = 0.25;
    const std::vector<OpenEdge> edges = openEdgesOf(mesh, interrupter);
    if (edges.empty()) return {};
    const MeshHoles holes = holesOf(mesh, edges);
    // Voxels at the surface reach out of the solid, by half of one on average. Half of that is sure.
    const double voxel = voxelSizeOf(object.transform());
    const double inside =
        double(object.activeVoxelCount()) * voxel * voxel * voxel - kBeyond * voxel * areaOf(mesh);
    const double lacking = holes.volume > 0 ? 1 - inside / holes.volume : 0;
    const double hollow = hollowShare(mesh, object);
    if (hollow < kMuch && lacking < kSome) return {};
    const auto percent = [](double share) { return std::to_string(int(100 * share)) + "%"; };
    return "mesh " + detail::inQuotes(mesh.name) + " is open, and "
        + (hollow < kMuch ? "its object lacks " + percent(lacking) + " of what it bounds"
                          : percent(hollow) + " of it has nothing inside")
        + ": where it ought to be solid, a hole is wider than gap=" + detail::shortNumber(gap)
        + ", so make gap larger (the widest hole measures about "
        + detail::shortNumber(holes.widest) + ")";
}

MissedSurface missedSurface(
    const TriangleMesh& mesh, const openvdb::BoolGrid& object, NullInterrupter* interrupter)
{
    const MaskTree::Ptr surface =
        trianglesToVoxels(toIndexSpace(mesh, object.transform()), interrupter);
    const MaskTree::Ptr near = detail::copyTopology<MaskTree>(object.tree(), interrupter);
    const detail::NearestVoxel nearest(*near);
    openvdb::tools::dilateActiveValues(
        *near, 1, openvdb::tools::NN_FACE_EDGE_VERTEX, openvdb::tools::PRESERVE_TILES);
    const detail::MaskDifference missed = detail::maskDifference(*surface, *near, interrupter);

    std::vector<int64_t> furthestSq(missed.cubes.size(), 0); // in half voxels
    detail::parallelFor(missed.cubes.size(), interrupter, [&](std::size_t i) {
        const detail::VoxelCube& cube = missed.cubes[i]; // of 8: surfaces have no tiles
        cube.mask.visitOn([&](uint32_t offset) {
            openvdb::Coord at;
            const openvdb::Coord voxel = leafVoxel(cube.origin, offset);
            furthestSq[i] = std::max(furthestSq[i], nearest.nearest(voxel, at));
        });
    });
    MissedSurface result;
    result.voxels = missed.voxels;
    const double voxel = voxelSizeOf(object.transform());
    for (const int64_t sq : furthestSq) {
        result.distance = std::max(result.distance, std::sqrt(double(sq)) / 2 * voxel);
    }
    return result;
}

} // namespace openvdb_spheretree
