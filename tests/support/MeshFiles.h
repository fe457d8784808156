// SPDX-License-Identifier: Apache-2.0
/// @file MeshFiles.h
/// @brief Mesh files of given bytes, what reading them says, and the volume of what was read.

#pragma once

#include <openvdb_spheretree/input/mesh/MeshFile.h>

#include <cstdint>
#include <cstring>
#include <string>

namespace spheretree_test {

using openvdb::Vec3d;
using openvdb::Vec3I;
using openvdb_spheretree::readMeshFile;
using openvdb_spheretree::TriangleMesh;

template <typename Value>
std::string bytesOf(Value value, bool bigEndian = false)
{
    std::uint32_t bits;
    static_assert(sizeof(Value) == sizeof(bits), "four bytes");
    std::memcpy(&bits, &value, sizeof(bits));
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes.push_back(char(bits >> (8 * (bigEndian ? 3 - i : i))));
    return bytes;
}

/// A file in the folder for temporary files, gone when the test is over.
struct TempFile {
    std::string path;

    TempFile(const std::string& name, const std::string& contents);
    ~TempFile();
    TempFile(const TempFile&) = delete;
};

TriangleMesh read(const std::string& name, const std::string& bytes);

/// @return what readMeshFile() says of the file, or nothing if it read it.
std::string errorOf(const std::string& path);

std::string errorOf(const std::string& name, const std::string& bytes);

/// Positive where triangles face outwards.
double volumeOf(const TriangleMesh& mesh);

} // namespace spheretree_test
