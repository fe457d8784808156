// SPDX-License-Identifier: Apache-2.0
/// @file MeshFile.cc
/// @brief Reader of mesh files.
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
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#ifdef SPHERETREE_WITH_ASSIMP
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <limits>
#include <new>
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

} // namespace openvdb_spheretree
