// SPDX-License-Identifier: Apache-2.0
/// @file AssimpReader.cc
/// @brief Of assimp only the importers are used: its own post-processing aborts the process on empty meshes in builds
/// with assertions (Debian's), joins points that are merely near, and flattens the scene by rules of its own.
///
/// In the child: the importer, by way of FilesOfScene; then placedSoup(), the scene's nodes, each with its transform, as
/// one set of polygons; its bytes come back.

#include "AssimpReader.h"

#include <openvdb/Exceptions.h>

#ifdef SPHERETREE_WITH_ASSIMP
#include "GltfExtensions.h"

#include <openvdb_spheretree/base/ChildProcess.h>
#include <openvdb_spheretree/base/FileStamp.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/NearbyFiles.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/mesh/TriangleMesh.h>

#include <openvdb/math/BBox.h>

#include <assimp/DefaultIOSystem.h>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <new>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <sys/stat.h>
#endif

namespace openvdb_spheretree::detail {

#ifdef SPHERETREE_WITH_ASSIMP

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxMessage = 200;

/// Memory of a reader: so much for each byte of its files, as text in trees of nodes takes some 30 times its length.
constexpr uint64_t kMemoryPerByte = 64;
/// Processor time of a reader: 4 s for each MiB of its files. Assimp 5.2 needs 0.002 to 0.024 s (.dae .x .fbx .3ds .glb
/// .x3d), and 0.12 s where the file is compressed (.3mf): a slow machine, or a sanitizer, has enough.
constexpr uint64_t kBytesPerSecond = uint64_t(1) << 18;
/// This to begin with.
constexpr ChildLimits kBeginning = {/*bytes=*/uint64_t(256) << 20, /*seconds=*/60};

/// The mesh's file, and regular files in its folder or below. Others are not opened, and noted.
class FilesOfScene : public Assimp::DefaultIOSystem {
public:
    explicit FilesOfScene(const std::string& path) : mNearby(path) {}

    bool Exists(const char* name) const override
    {
        std::error_code error;
        if (mNearby.hold(name) && fs::is_regular_file(name, error)) return true;
        if (mRefused.empty()) mRefused = name;
        return false;
    }

    Assimp::IOStream* Open(const char* name, const char* mode) override
    {
        return Exists(name) && allowFor(name) ? DefaultIOSystem::Open(name, mode) : nullptr;
    }

    /// Raises the limits for a file, once: a scene may name one a thousand times.
    /// @return whether it is there
    bool allowFor(const std::string& name)
    {
        struct stat info;
        if (stat(name.c_str(), &info) != 0) return false;
        if (mOpened.emplace(info.st_dev, info.st_ino).second) {
            const auto size = uint64_t(info.st_size);
            allowMore({kMemoryPerByte * size, size / kBytesPerSecond});
            mStamps.emplace_back(name);
        }
        return true;
    }

    /// @return the first file that was asked for in vain.
    const std::string& refused() const { return mRefused; }

    /// @throw openvdb::IoError if a file has been written to since it was opened
    void requireUnchanged() const
    {
        for (const FileStamp& stamp : mStamps) {
            if (stamp.isUnchanged()) continue;
            throw openvdb::IoError(onOneLine(stamp.path(), kMaxMessage) + ": " + kWasChanged);
        }
    }

private:
    NearbyFiles mNearby;
    std::set<std::pair<dev_t, ino_t>> mOpened;
    std::vector<FileStamp> mStamps; ///< of these
    mutable std::string mRefused;
};

/// In doubles, as far places are small differences of floats.
using PlaceInScene = aiMatrix4x4t<double>;

void addMesh(const aiMesh& mesh, const PlaceInScene& transform, PolygonSoup& soup)
{
    const std::size_t base = soup.points.size();
    if (base + mesh.mNumVertices > std::numeric_limits<std::uint32_t>::max()) {
        throw openvdb::IoError("more points than 32 bits can number");
    }
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D& own = mesh.mVertices[i];
        const auto p = transform * aiVector3t<double>(own.x, own.y, own.z);
        const openvdb::Vec3d& point = soup.points.emplace_back(p.x, p.y, p.z);
        if (!isMeshPoint(point)) throw openvdb::IoError("a coordinate is not finite, or too large");
    }
    const bool mirrored = transform.Determinant() < 0; // then faces would turn inside out
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        if (face.mNumIndices < 3) continue; // a point or a line: holds nothing
        for (unsigned k = 0; k < face.mNumIndices; ++k) {
            const unsigned index = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
            if (index >= mesh.mNumVertices)
                throw openvdb::IoError("a face names a point that is not there");
            soup.corners.push_back(std::uint32_t(base + index));
        }
        soup.counts.push_back(face.mNumIndices);
    }
}

PolygonSoup placedSoup(const aiScene& scene)
{
    PolygonSoup soup;
    std::vector<std::pair<const aiNode*, PlaceInScene>>
        nodes; // a scene may nest deeper than a stack
    if (scene.mRootNode) {
        nodes.emplace_back(scene.mRootNode, PlaceInScene(scene.mRootNode->mTransformation));
    }
    while (!nodes.empty()) {
        const auto [node, transform] = nodes.back();
        nodes.pop_back();
        for (unsigned i = 0; i < node->mNumMeshes; ++i) {
            addMesh(*scene.mMeshes[node->mMeshes[i]], transform, soup);
        }
        for (unsigned i = 0; i < node->mNumChildren; ++i) {
            const aiNode* child = node->mChildren[i];
            nodes.emplace_back(child, transform * PlaceInScene(child->mTransformation));
        }
    }
    return soup;
}

/// @throw openvdb::IoError if a mesh lies so far from its origin that floats, which assimp reads coordinates as, change
/// its shape
void requireNearOrigin(const aiScene& scene)
{
    constexpr double kFloat = 0x1p-24, kShare = 0x1p-12; // of the mesh's size
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[m];
        openvdb::BBoxd box;
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            const aiVector3D& p = mesh.mVertices[i];
            box.expand(openvdb::Vec3d(p.x, p.y, p.z));
        }
        if (mesh.mNumVertices == 0) continue;
        const openvdb::Vec3d sides = box.extents();
        for (int a = 0; a < 3; ++a) {
            const double off = kFloat * std::max(std::abs(box.min()[a]), std::abs(box.max()[a]));
            if (off <= kShare * std::max({sides[0], sides[1], sides[2]})) continue;
            throw openvdb::IoError(
                "it is so far from the origin that coordinates, read as floats, are off by "
                + shortNumber(off)
                + ": move it nearer, or write it as .ply, .obj, .off or .stl, which are read in "
                  "full");
        }
    }
}

template <typename T>
void append(std::string& bytes, const std::vector<T>& values)
{
    const uint64_t count = values.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof(count));
    bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
}

[[noreturn]] void failCrashed() { throw openvdb::IoError("damaged: its reader crashed on it"); }

/// What append() has written; a crashed reader may have written anything.
template <typename T>
void take(std::string_view& bytes, std::vector<T>& values)
{
    uint64_t count = 0;
    const bool hasCount = bytes.size() >= sizeof(count);
    if (hasCount) std::memcpy(&count, bytes.data(), sizeof(count));
    if (!hasCount || count > (bytes.size() - sizeof(count)) / sizeof(T)) {
        failCrashed();
    }
    bytes.remove_prefix(sizeof(count));
    values.resize(count);
    if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
    bytes.remove_prefix(count * sizeof(T));
}

/// @return the name as the scene has it: the importer puts the scene's folder before it, whatever it is.
std::string refusedName(const std::string& asked, const std::string& path)
{
    const std::string folder = path.substr(0, path.rfind('/') + 1);
    const bool isPrefixed = asked.size() > folder.size() && asked.rfind(folder, 0) == 0;
    return onOneLine(isPrefixed ? asked.substr(folder.size()) : asked, kMaxMessage);
}

/// In the child.
std::string bytesOfScene(const std::string& path)
{
    const std::string extension = lowerExtension(path);
    const bool isGltf = extension == ".gltf" || extension == ".glb" || extension == ".vrm";
    Assimp::Importer importer;
    auto* const files = new FilesOfScene(path); // the importer deletes it
    importer.SetIOHandler(files);
    if (isGltf) {
        files->allowFor(path);
        requireKnownExtensions(path);
    }
    const aiScene* scene = importer.ReadFile(path, 0);
    files->requireUnchanged(); // whatever came of it
    // Without what it names, assimp takes a file of the same name from elsewhere.
    if (isGltf && !files->refused().empty()) {
        throw openvdb::IoError("it needs the file '" + refusedName(files->refused(), path)
            + "', which is no regular file in its folder or below");
    }
    if (!scene) {
        const std::string_view why = importer.GetErrorString(); // any text
        if (why.find("bad_alloc") != why.npos) throw std::bad_alloc();
        throw openvdb::IoError("not a mesh file that assimp can read, or damaged ("
            + onOneLine(why.substr(0, why.find('\n')), kMaxMessage) + ")");
    }
    const bool storesFloats = isGltf || extension == ".3ds";
    if (!storesFloats) requireNearOrigin(*scene);
    const PolygonSoup soup = placedSoup(*scene);
    std::string bytes;
    append(bytes, soup.points);
    append(bytes, soup.corners);
    append(bytes, soup.counts);
    return bytes;
}

/// @throw openvdb::IoError unless each polygon has three corners or more, and each corner its point
void requireWhole(const PolygonSoup& soup)
{
    uint64_t corners = 0;
    bool isWhole = true;
    for (const uint32_t count : soup.counts) {
        isWhole = isWhole && count >= 3;
        corners += count;
    }
    for (const uint32_t corner : soup.corners) isWhole = isWhole && corner < soup.points.size();
    for (const openvdb::Vec3d& p : soup.points) isWhole = isWhole && isMeshPoint(p);
    if (!isWhole || corners != soup.corners.size()) {
        failCrashed();
    }
}

} // namespace

bool hasAssimp() { return true; }

bool assimpKnows(const std::string& extension)
{
    // Names that are grids here, whatever a future assimp makes of them.
    if (extension == ".vdb" || extension == ".vol" || extension == ".longvol") return false;
    return !extension.empty() && Assimp::Importer().IsExtensionSupported(extension);
}

PolygonSoup readByAssimp(const std::string& path, openvdb::util::NullInterrupter* interrupter)
{
    std::string bytes;
    try {
        bytes = resultOfChild([&] { return bytesOfScene(path); }, kBeginning, interrupter);
    } catch (const std::bad_alloc&) {
        throw openvdb::IoError("it takes more memory than " + asText(kBeginning.bytes) + " and "
            + std::to_string(kMemoryPerByte)
            + " times its size: damaged, or one mesh shown very many times; write each as "
              "triangles, as .ply or .stl");
    }
    std::string_view left = bytes;
    PolygonSoup soup;
    take(left, soup.points);
    take(left, soup.corners);
    take(left, soup.counts);
    requireWhole(soup);
    return soup;
}

#else

bool hasAssimp() { return false; }

bool assimpKnows(const std::string& extension)
{
    for (const char* known : {".gltf", ".glb", ".fbx", ".dae", ".3ds", ".x", ".lwo", ".3mf"}) {
        if (extension == known) return true;
    }
    return false;
}

PolygonSoup readByAssimp(const std::string&, openvdb::util::NullInterrupter*)
{
    throw openvdb::IoError(
        "this build reads .obj, .off, .ply and .stl meshes only; for other formats "
        "install assimp (Debian: libassimp-dev) and configure with -DSPHERETREE_WITH_ASSIMP=ON");
}

#endif

} // namespace openvdb_spheretree::detail
