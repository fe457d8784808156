// SPDX-License-Identifier: Apache-2.0
/// @file TestMeshScene.cc
/// @brief Scenes that assimp reads: their meshes in place, every truncation refused.

#include <openvdb_spheretree/input/mesh/MeshFile.h>

#include "support/MeshFiles.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

std::string base64(const std::string& bytes)
{
    const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i + 2 < bytes.size(); i += 3) { // a multiple of three
        std::uint32_t word = 0;
        for (int k = 0; k < 3; ++k) word = word << 8 | std::uint8_t(bytes[i + k]);
        for (int k = 18; k >= 0; k -= 6) text.push_back(digits[word >> k & 63]);
    }
    return text;
}

/// A scene that shows one tetrahedron, facing outwards, three times: moved, mirrored in a moved
/// node, and nowhere at all (a mesh no node shows is no part of the scene).
std::string gltfScene()
{
    std::string bytes;
    for (const char* face : {"021", "013", "032", "123"}) {
        for (int k = 0; k < 3; ++k) {
            for (int axis = 0; axis < 3; ++axis) bytes += bytesOf(float(face[k] == '1' + axis));
        }
    }
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[
{"mesh":0,"translation":[10,0,0]},{"translation":[0,20,0],"children":[2]},
{"mesh":0,"scale":[-2,1,1]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]},
{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,
"count":12,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}],"bufferViews":[{"buffer":0,
"byteLength":144}],"buffers":[{"byteLength":144,"uri":"data:application/octet-stream;base64,)"
        + base64(bytes) + "\"}]}";
}

TEST(MeshScene, PlacesTheMeshesOfASceneByItsTransforms)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    const TriangleMesh mesh = read("scene.gltf", gltfScene());
    EXPECT_EQ(8u, mesh.points.size());
    EXPECT_EQ(8u, mesh.triangles.size());
    openvdb::BBoxd box;
    for (const Vec3s& point : mesh.points) box.expand(Vec3d(point));
    EXPECT_EQ(Vec3d(-2, 0, 0), box.min());
    EXPECT_EQ(Vec3d(11, 21, 1), box.max());
    EXPECT_NEAR(1 / 6. + 2 / 6., volumeOf(mesh), 1e-6); // the mirrored one faces outwards as well
}

TEST(MeshScene, RejectsEveryTruncationOfAScene)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    const std::string bytes = gltfScene();
    ASSERT_EQ("", errorOf("cut.gltf", bytes));
    for (std::size_t length = 0; length < bytes.size(); ++length) {
        ASSERT_NE("", errorOf("cut.gltf", bytes.substr(0, length))) << length;
    }
}

TEST(MeshScene, SaysHowToGetWhatABuildWithoutAssimpLacks)
{
    if (readsOtherMeshFormats()) GTEST_SKIP() << "needs a build without assimp";
    EXPECT_NE(std::string::npos, errorOf("scene.gltf", gltfScene()).find("libassimp-dev"));
}

} // namespace
