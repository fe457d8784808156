// SPDX-License-Identifier: Apache-2.0
/// @file MeshFile.cc
/// @brief Reader of mesh files, and mesh to level set.
///
/// 1. Polygons of the file: OBJ, OFF, PLY, STL by MeshFormats.h, which says why; others by
///    assimp. Of assimp only the importers are used: its own post-processing aborts the process on
///    empty meshes in builds with assertions (Debian's), joins points that are merely near, and
///    flattens the scene by rules of its own.
/// 2. placedSoup():  the scene's nodes, each with its transform, as one set of polygons.
/// 3. toTriangles(): polygons cut up, points at the same place joined, what is unused dropped.

#include "MeshFile.h"

#include "MeshFormats.h"
#include "Polygon.h"
#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/SignedFloodFill.h>

#ifdef SPHERETREE_WITH_ASSIMP
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#endif

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <ios>
#include <limits>
#include <new>
#include <sstream>
#include <system_error>
#include <unordered_map>
#include <utility>
#include <vector>

namespace openvdb_spheretree {
namespace {

using detail::PolygonSoup;
using openvdb::IoError;
using openvdb::Vec3d;
using openvdb::Vec3I;
using openvdb::Vec3s;

/// Half of what Coord holds, so that a narrow band and OpenVDB's own margins fit around it.
constexpr double kMaxIndex = 1 << 30;
constexpr double kMaxHalfWidth = 1000; // wider is a slip: memory grows with its cube
constexpr std::size_t kMaxMessage = 200;

[[noreturn]] void fail(const std::string& path, const std::string& what)
{
    throw IoError(path + ": " + what);
}

void needRegularFile(const std::string& path, const std::string& name)
{
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail(name, "no such file");
    if (std::filesystem::is_directory(status)) fail(name, "is a directory, not a mesh file");
    if (!std::filesystem::is_regular_file(status)) fail(name, "is not a regular file");
    if (std::filesystem::file_size(path, error) == 0) fail(name, "the file is empty");
}

/// @throw IoError without the name of the file, std::ios_base::failure with the system's reason
std::string contentsOf(const std::string& path)
{
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) throw IoError("cannot be read: " + error.message());
    std::ifstream file(path, std::ios::binary);
    if (!file) throw IoError("cannot be opened for reading");
    file.exceptions(std::ios::badbit); // otherwise the system's reason is lost
    std::string bytes(size, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(size));
    const auto count = static_cast<std::uintmax_t>(file.gcount());
    if (count == size) return bytes;
    throw IoError("ends after " + std::to_string(count) + " of its " + std::to_string(size)
        + " bytes: it was cut while it was read");
}

#ifdef SPHERETREE_WITH_ASSIMP

bool assimpKnows(const std::string& extension)
{
    // Names that are grids here, whatever a future assimp makes of them.
    if (extension == ".vdb" || extension == ".vol" || extension == ".longvol") return false;
    return !extension.empty() && Assimp::Importer().IsExtensionSupported(extension);
}

void addMesh(const aiMesh& mesh, const aiMatrix4x4& transform, PolygonSoup& soup)
{
    const std::size_t base = soup.points.size();
    if (base + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max()) {
        throw IoError("more points than 32 bits can number");
    }
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D p = transform * mesh.mVertices[i];
        const Vec3s& point = soup.points.emplace_back(p.x, p.y, p.z);
        if (!point.isFinite()) throw IoError("a coordinate is not finite");
    }
    const bool mirrored = transform.Determinant() < 0; // then faces would turn inside out
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices < 3) continue; // a point or a line: holds nothing
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            const unsigned index = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
            if (index >= mesh.mNumVertices) throw IoError("a face names a point that is not there");
            soup.corners.push_back(std::uint32_t(base + index));
        }
        soup.counts.push_back(face.mNumIndices);
    }
}

PolygonSoup placedSoup(const aiScene& scene)
{
    PolygonSoup soup;
    std::vector<std::pair<const aiNode*, aiMatrix4x4>>
        nodes; // a scene may nest deeper than a stack
    if (scene.mRootNode) nodes.emplace_back(scene.mRootNode, scene.mRootNode->mTransformation);
    while (!nodes.empty()) {
        const auto [node, transform] = nodes.back();
        nodes.pop_back();
        for (unsigned i = 0; i < node->mNumMeshes; ++i) {
            addMesh(*scene.mMeshes[node->mMeshes[i]], transform, soup);
        }
        for (unsigned i = 0; i < node->mNumChildren; ++i) {
            const aiNode* child = node->mChildren[i];
            nodes.emplace_back(child, transform * child->mTransformation);
        }
    }
    return soup;
}

PolygonSoup readByAssimp(const std::string& path)
{
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(path, 0);
    if (!scene) {
        const std::string_view why = importer.GetErrorString(); // any text
        throw IoError("not a mesh file that assimp can read, or damaged ("
            + detail::onOneLine(why.substr(0, why.find('\n')), kMaxMessage) + ")");
    }
    return placedSoup(*scene);
}

#else

bool assimpKnows(const std::string& extension)
{
    for (const char* known : {".gltf", ".glb", ".fbx", ".dae", ".3ds", ".x", ".lwo", ".3mf"}) {
        if (extension == known) return true;
    }
    return false;
}

PolygonSoup readByAssimp(const std::string&)
{
    throw IoError(
        "this build reads .obj, .off, .ply and .stl meshes only; for other formats "
        "install assimp (Debian: libassimp-dev) and configure with -DSPHERETREE_WITH_ASSIMP=ON");
}

#endif

struct ExactHash {
    std::size_t operator()(const Vec3s& p) const
    {
        std::uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) {
            std::uint32_t bits;
            std::memcpy(&bits, p.asPointer() + axis, sizeof(bits));
            hash = (hash ^ bits) * 0x9E3779B97F4A7C15u;
            hash ^= hash >> 29;
        }
        return static_cast<std::size_t>(hash);
    }
};

/// Joins points at exactly the same place, drops triangles that this makes a line or a point, and
/// keeps the points that are left in use, in order of their first use.
void weld(const std::vector<Vec3s>& points, std::vector<Vec3I> triangles, TriangleMesh& mesh)
{
    std::unordered_map<Vec3s, std::uint32_t, ExactHash> numbers;
    numbers.reserve(points.size());
    for (const Vec3I& triangle : triangles) {
        Vec3I joined;
        const Vec3s &a = points[triangle[0]], &b = points[triangle[1]], &c = points[triangle[2]];
        if (a == b || b == c || c == a) continue;
        for (int i = 0; i < 3; ++i) {
            const Vec3s p = points[triangle[i]] + Vec3s(0); // -0 becomes 0
            const auto number = std::uint32_t(mesh.points.size());
            const auto [it, isNew] = numbers.try_emplace(p, number);
            if (isNew) mesh.points.push_back(p);
            joined[i] = it->second;
        }
        mesh.triangles.push_back(joined);
    }
}

TriangleMesh toTriangles(const PolygonSoup& soup)
{
    std::vector<Vec3I> triangles;
    std::vector<std::uint32_t> corners;
    auto at = soup.corners.begin();
    for (const std::uint32_t count : soup.counts) {
        corners.assign(at, at + count);
        at += count;
        detail::triangulate(soup.points, corners, triangles);
    }
    TriangleMesh mesh;
    weld(soup.points, std::move(triangles), mesh);
    if (mesh.triangles.empty()) throw IoError("the file holds no triangle");
    return mesh;
}

// Level set

/// @return the center of the mesh's box in index space, rounded to a leaf's corner. Around it,
/// points of 24 bits are as exact as those of the file are.
openvdb::Coord middleLeaf(const TriangleMesh& mesh, double voxelSize)
{
    openvdb::BBoxd box;
    for (const Vec3s& world : mesh.points) {
        const Vec3d point = Vec3d(world) / voxelSize;
        box.expand(point);
        for (int axis = 0; axis < 3; ++axis) {
            if (std::abs(point[axis]) <= kMaxIndex) continue; // false for NaN as well
            OPENVDB_THROW(openvdb::ValueError,
                "mesh '" << mesh.name << "' reaches coordinate " << world[axis]
                         << ", too far for voxel size " << voxelSize
                         << " (indices must stay within 2^30); use larger voxels");
        }
    }
    return openvdb::Coord::floor(box.getCenter())
        & ~int32_t(openvdb::FloatTree::LeafNodeType::DIM - 1);
}

/// Moves the narrow band by @a shift, a multiple of leaves, and fills its inside again.
void moveBand(openvdb::FloatGrid& grid, const openvdb::Coord& shift)
{
    if (shift == openvdb::Coord()) return;
    std::vector<openvdb::FloatTree::LeafNodeType*> leaves;
    grid.tree().stealNodes(leaves);
    grid.tree().clear();
    for (auto* leaf : leaves) {
        leaf->setOrigin(leaf->origin() + shift);
        grid.tree().addLeaf(leaf);
    }
    openvdb::tools::signedFloodFill(grid.tree());
}

void checkMesh(const TriangleMesh& mesh)
{
    if (mesh.triangles.empty()) {
        OPENVDB_THROW(openvdb::ValueError, "mesh '" << mesh.name << "' has no triangles");
    }
    for (const Vec3I& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            if (triangle[i] < mesh.points.size()) continue;
            OPENVDB_THROW(openvdb::ValueError,
                "mesh '" << mesh.name << "' has a triangle of point " << triangle[i]
                         << ", but only " << mesh.points.size() << " points");
        }
    }
}

/// By the area of its triangles a mesh has a narrow band of so many voxels, and fewer where triangles
/// are nearer to each other than twice its half width; by its box it cannot have more. Measured are 35
/// bytes a voxel of the band: what is refused needs more than there is even if four triangles share one.
void requireRoomForBand(const TriangleMesh& mesh, double voxelSize, double halfWidth)
{
    constexpr double kBytes = 8, kBytesOfDense = 8;
    double area = 0; // in faces of voxels
    openvdb::BBoxd box;
    for (const Vec3I& triangle : mesh.triangles) {
        const Vec3d a(mesh.points[triangle[0]]), b(mesh.points[triangle[1]]),
            c(mesh.points[triangle[2]]);
        area += (b - a).cross(c - a).length() / 2 / (voxelSize * voxelSize);
        for (const Vec3d& corner : {a, b, c}) box.expand(corner);
    }
    const Vec3d sides = box.extents() / voxelSize + Vec3d(2 * halfWidth);
    const double band = 2 * halfWidth * area;
    const double bytes = std::min(kBytes * band, kBytesOfDense * sides[0] * sides[1] * sides[2]);
    std::ostringstream what;
    what << "the up to " << std::setprecision(2) << band << " voxels at the surface of mesh '"
         << mesh.name << "'";
    detail::requireMemory(bytes, what.str(), "use a larger voxel");
}

openvdb::math::Transform::Ptr transformOf(double voxelSize)
{
    if (std::isfinite(voxelSize) && voxelSize > 0) {
        try {
            return openvdb::math::Transform::createLinearTransform(voxelSize);
        } catch (const openvdb::ArithmeticError&) { // nearly singular, in OpenVDB's eyes
        }
    }
    OPENVDB_THROW(openvdb::ValueError,
        "voxel size " << voxelSize
                      << " is out of range; it must be "
                         "a finite number above 0.0001 or so");
}

} // namespace

bool readsOtherMeshFormats()
{
#ifdef SPHERETREE_WITH_ASSIMP
    return true;
#else
    return false;
#endif
}

bool isMeshFileName(const std::string& path)
{
    const std::string extension = detail::lowerExtension(path);
    return detail::isStrictFormat(extension) || assimpKnows(extension);
}

TriangleMesh readMeshFile(const std::string& path, const std::string& shownAs)
{
    const std::string& name = shownAs.empty() ? path : shownAs;
    needRegularFile(path, name);
    const std::string extension = detail::lowerExtension(name);
    TriangleMesh mesh;
    try {
        mesh = toTriangles(detail::isStrictFormat(extension)
                ? detail::parseMesh(extension, contentsOf(path))
                : readByAssimp(path));
    } catch (const std::bad_alloc&) {
        fail(name, "not enough memory for the mesh");
    } catch (const std::ios_base::failure& error) {
        fail(name, "cannot be read: " + error.code().message());
    } catch (const openvdb::Exception& error) {
        fail(name, detail::messageOf(error));
    }
    mesh.name = std::filesystem::path(name).stem().string();
    return mesh;
}

int64_t openEdges(const TriangleMesh& mesh)
{
    std::vector<uint64_t> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const Vec3I& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const uint64_t a = triangle[i], b = triangle[(i + 1) % 3];
            edges.push_back(std::min(a, b) << 32 | std::max(a, b));
        }
    }
    tbb::parallel_sort(edges.begin(), edges.end());
    int64_t open = 0;
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end] == edges[begin]) ++end;
        open += int64_t((end - begin) % 2);
    }
    return open;
}

openvdb::FloatGrid::Ptr meshToLevelSet(const TriangleMesh& mesh, double voxelSize, double halfWidth,
    openvdb::util::NullInterrupter* interrupter)
{
    const openvdb::math::Transform::Ptr transform = transformOf(voxelSize);
    if (!(halfWidth >= 1 && halfWidth <= kMaxHalfWidth)) {
        OPENVDB_THROW(openvdb::ValueError,
            "half width " << halfWidth << " is out of range; it must be from 1 to " << kMaxHalfWidth
                          << " voxels");
    }
    checkMesh(mesh);
    const openvdb::Coord shift = middleLeaf(mesh, voxelSize);
    requireRoomForBand(mesh, voxelSize, halfWidth);
    std::vector<Vec3s> points; // in index space, around the origin
    points.reserve(mesh.points.size());
    for (const Vec3s& world : mesh.points) {
        points.emplace_back(Vec3d(world) / voxelSize - shift.asVec3d());
    }
    // The types for which the code is in OpenVDB's library.
    const openvdb::tools::QuadAndTriangleDataAdapter<Vec3s, Vec3I> adapter(points, mesh.triangles);
    openvdb::util::NullInterrupter silent;
    openvdb::util::NullInterrupter& boss = interrupter ? *interrupter : silent;
    const auto band = static_cast<float>(halfWidth);
    auto grid =
        openvdb::tools::meshToVolume<openvdb::FloatGrid>(boss, adapter, *transform, band, band);
    if (openvdb::util::wasInterrupted(&boss)) throw Interrupted();
    moveBand(*grid, shift);
    grid->setName(mesh.name);
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    return grid;
}

double voxelSizeForDim(const TriangleMesh& mesh, int dim)
{
    if (dim < 1) {
        OPENVDB_THROW(openvdb::ValueError, "dim " << dim << " is out of range; it must be >= 1");
    }
    openvdb::BBoxd box;
    bool isFinite = !mesh.points.empty();
    for (const Vec3s& point : mesh.points) {
        isFinite = isFinite && point.isFinite();
        box.expand(Vec3d(point));
    }
    const double side = isFinite ? box.extents()[box.maxExtent()] : 0;
    if (!(side > 0)) {
        OPENVDB_THROW(openvdb::ValueError,
            "mesh '" << mesh.name
                     << "' is empty, has no extent, or is not finite: no voxel size fits it");
    }
    return side / dim;
}

} // namespace openvdb_spheretree
