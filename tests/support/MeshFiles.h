// SPDX-License-Identifier: Apache-2.0
/// @file MeshFiles.h
/// @brief Mesh files of given bytes, what reading them says, and the volume of what was read.

#pragma once

#include <openvdb_spheretree/input/mesh/MeshFile.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace spheretree_test {

using openvdb::Vec3d;
using openvdb::Vec3I;
using openvdb::Vec3s;
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

    TempFile(const std::string& name, const std::string& contents)
        : path(testing::TempDir() + "MeshFile_" // tests may run at the same time
            + testing::UnitTest::GetInstance()->current_test_info()->name() + "_" + name)
    {
        std::ofstream(path, std::ios::binary) << contents;
    }
    ~TempFile() { std::filesystem::remove(path); }
};

inline TriangleMesh read(const std::string& name, const std::string& bytes)
{
    const TempFile file(name, bytes);
    return readMeshFile(file.path);
}

/// @return what readMeshFile() says of the file, or nothing if it read it.
inline std::string errorOf(const std::string& path)
{
    try {
        readMeshFile(path);
    } catch (const openvdb::IoError& error) {
        const std::string text = error.what();
        EXPECT_NE(std::string::npos, text.find(path)) << text;
        EXPECT_LT(text.size(), path.size() + 400) << text;
        return text;
    }
    return {};
}

inline std::string errorOf(const std::string& name, const std::string& bytes)
{
    const TempFile file(name, bytes);
    return errorOf(file.path);
}

/// Positive where triangles face outwards.
inline double volumeOf(const TriangleMesh& mesh)
{
    double sum = 0;
    for (const Vec3I& t : mesh.triangles) {
        const Vec3d a(mesh.points[t[0]]), b(mesh.points[t[1]]), c(mesh.points[t[2]]);
        sum += a.dot(b.cross(c)) / 6;
    }
    return sum;
}

} // namespace spheretree_test
