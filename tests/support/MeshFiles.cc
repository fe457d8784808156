// SPDX-License-Identifier: Apache-2.0
#include "MeshFiles.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace spheretree_test {

TempFile::TempFile(const std::string& name, const std::string& contents)
    : path(testing::TempDir() + "MeshFile_" // tests may run at the same time
        + testing::UnitTest::GetInstance()->current_test_info()->name() + "_" + name)
{
    std::ofstream(path, std::ios::binary) << contents;
}

TempFile::~TempFile() { std::filesystem::remove(path); }

TriangleMesh read(const std::string& name, const std::string& bytes)
{
    const TempFile file(name, bytes);
    return readMeshFile(file.path);
}

std::string errorOf(const std::string& path)
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

std::string errorOf(const std::string& name, const std::string& bytes)
{
    const TempFile file(name, bytes);
    return errorOf(file.path);
}

double volumeOf(const TriangleMesh& mesh)
{
    double sum = 0;
    for (const Vec3I& t : mesh.triangles) {
        const Vec3d a(mesh.points[t[0]]), b(mesh.points[t[1]]), c(mesh.points[t[2]]);
        sum += a.dot(b.cross(c)) / 6;
    }
    return sum;
}

} // namespace spheretree_test
