// SPDX-License-Identifier: Apache-2.0
/// @file TestMeshScene.cc
/// @brief Scenes that assimp reads: their meshes in place, every truncation refused.

#include <openvdb_spheretree/input/mesh/GltfExtensions.h>
#include <openvdb_spheretree/input/mesh/MeshFile.h>

#include <openvdb_spheretree/base/Interrupted.h>

#include "support/MeshFiles.h"
#include "support/Messages.h"
#include "support/Sanitizers.h"
#include "support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>

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

/// Three corners for each side of a tetrahedron, as floats.
std::string cornersOfTetrahedron()
{
    std::string bytes;
    for (const char* face : {"021", "013", "032", "123"}) {
        for (int k = 0; k < 3; ++k) {
            for (int axis = 0; axis < 3; ++axis) bytes += bytesOf(float(face[k] == '1' + axis));
        }
    }
    return bytes;
}

/// A scene that shows one tetrahedron, facing outwards, three times: moved, mirrored in a moved
/// node, and nowhere at all (a mesh no node shows is no part of the scene).
std::string gltfScene()
{
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[
{"mesh":0,"translation":[10,0,0]},{"translation":[0,20,0],"children":[2]},
{"mesh":0,"scale":[-2,1,1]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]},
{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,
"count":12,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}],"bufferViews":[{"buffer":0,
"byteLength":144}],"buffers":[{"byteLength":144,"uri":"data:application/octet-stream;base64,)"
        + base64(cornersOfTetrahedron()) + "\"}]}";
}

TEST(MeshScene, PlacesTheMeshesOfASceneByItsTransforms)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    const TriangleMesh mesh = read("scene.gltf", gltfScene());
    EXPECT_EQ(8u, mesh.points.size());
    EXPECT_EQ(8u, mesh.triangles.size());
    openvdb::BBoxd box;
    for (const Vec3d& point : mesh.points) box.expand(Vec3d(point));
    EXPECT_EQ(Vec3d(-2, 0, 0), box.min());
    EXPECT_EQ(Vec3d(11, 21, 1), box.max());
    EXPECT_NEAR(1 / 6. + 2 / 6., volumeOf(mesh), 1e-6); // the mirrored one faces outwards as well
}

/// Floats at 5,400,000 are half a unit apart, and the corners of the mesh are floats at its own origin.
TEST(MeshScene, PlacesMeshesFarAwayInDoubles)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    std::string scene = gltfScene();
    scene.replace(scene.find("[10,0,0]"), 8, "[5400000,0,0]");
    const TriangleMesh mesh = read("far.gltf", scene);
    EXPECT_EQ(8u, mesh.points.size());
    EXPECT_NEAR(1 / 6. + 2 / 6., volumeOf(mesh), 1e-6);
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

/// A cube, of which one word after another is changed below to what crashes assimp 5.2.
std::string colladaCube()
{
    return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<library_geometries><geometry id="g"><mesh><source id="p">
<float_array id="pa" count="24">0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1</float_array>
<technique_common><accessor source="#pa" count="8" stride="3"><param name="X" type="float"/>
<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="12"><input semantic="VERTEX" source="#v" offset="0"/>
<p>0 3 2 0 2 1 4 5 6 4 6 7 0 1 5 0 5 4 1 2 6 1 6 5 2 3 7 2 7 6 3 0 4 3 4 7</p></triangles>
</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id="s">
<node id="n"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";
}

std::string replaced(std::string text, const std::string& word, const std::string& by)
{
    return text.replace(text.find(word), word.size(), by);
}

TEST(MeshScene, RefusesMeshesWhoseShapeFloatsChange)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    const std::string points = "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1";
    std::string far;
    std::istringstream numbers(points);
    for (int number, i = 0; numbers >> number; ++i) {
        far += std::to_string(number + (i % 3 == 1 ? 5400000 : 0)) + " ";
    }
    EXPECT_EQ("", errorOf("near.dae", colladaCube()));
    EXPECT_NE(std::string::npos,
        errorOf("far.dae", replaced(colladaCube(), points, far)).find("move it nearer"));
}

std::string repeated(int count, const std::string& text)
{
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

TEST(MeshScene, WhatCrashesItsReaderIsAnErrorOfTheFile)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    const std::string cube = colladaCube(), instance = R"(<instance_geometry url="#g"/>)";
    ASSERT_EQ("", errorOf("cube.dae", cube));
    const std::string deep = repeated(200000, "<node>") + instance + repeated(200000, "</node>");
    for (const std::string& damaged : {replaced(cube, "count=\"24\"", "count=\"-1\""),
             replaced(cube, "stride=\"3\"", "stride=\"1000000000\""),
             replaced(cube, instance, R"(<instance_node url="#n"/>)"), // a node within itself
             replaced(cube, instance, deep)}) {
        const std::string why = errorOf("cube.dae", damaged);
        EXPECT_TRUE(mentions(why, "cube.dae"));
        EXPECT_TRUE(mentions(why, "damaged"));
    }
}

TEST(MeshScene, AReaderThatTakesFarMoreMemoryThanItsFileIsStopped)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    if (kSanitized) GTEST_SKIP() << "its allocator ends the process";
    const std::string instance = R"(<instance_geometry url="#g"/>)";
    std::string many; // ten times ten times ...
    for (int i = 0; i < 9; ++i) {
        const std::string next = "<instance_node url=\"#n" + std::to_string(i + 1) + "\"/>";
        many += "<node id=\"n" + std::to_string(i) + "\">" + repeated(10, next) + "</node>";
    }
    const std::string node = "<node id=\"n\">" + instance + "</node>";
    const std::string laugh =
        replaced(colladaCube(), node, many + "<node id=\"n9\">" + instance + "</node>");
    EXPECT_TRUE(mentions(errorOf("laugh.dae", laugh), "more memory"));
    // A word among the corners makes assimp 5.2 add one for ever.
    EXPECT_TRUE(
        mentions(errorOf("word.dae", replaced(colladaCube(), "0 1 5 0", "0 x 5 0")), "memory"));
}

TEST(MeshScene, BuffersAreRegularFilesBelowTheFolderOfTheFile)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    const std::string scene = gltfScene();
    const auto save = [&](const std::string& name, const std::string& bytes) {
        fs::create_directories(fs::path(folder.path() + "/" + name).parent_path());
        std::ofstream(folder.path() + "/" + name, std::ios::binary) << bytes;
    };
    const std::size_t begin = scene.find("data:"), end = scene.find('"', begin);
    const auto whyNot = [&](const std::string& uri) {
        save("in/a.gltf", scene.substr(0, begin) + uri + scene.substr(end));
        return errorOf(folder.path() + "/in/a.gltf");
    };
    for (const char* name : {"in/b.bin", "in/c/b.bin", "b.bin"}) save(name, cornersOfTetrahedron());
    ASSERT_EQ(0, mkfifo((folder.path() + "/in/pipe.bin").c_str(), 0600));
    EXPECT_EQ("", whyNot("b.bin"));
    EXPECT_EQ("", whyNot("c/b.bin"));
    for (const std::string uri :
        {"../b.bin", "pipe.bin", "/dev/zero", "http://127.0.0.1:1/b.bin", "none.bin"}) {
        EXPECT_TRUE(
            mentions(whyNot(uri), "the file '" + uri + "', which is no regular file in its folder"))
            << whyNot(uri);
    }
    EXPECT_TRUE(mentions(whyNot("%2e%2e/b.bin"), "in its folder"));
    EXPECT_TRUE(mentions(whyNot(folder.path() + "/b.bin"), "in its folder"));
}

/// Assimp reads such a scene all the same, and shows one mesh for many instances, or packed points as they lie.
TEST(MeshScene, RefusesExtensionsThatSayWhichTrianglesThereAre)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    const auto withRequired = [](const std::string& list) {
        return gltfScene().insert(1, "\"extensionsRequired\":" + list + ",");
    };
    const auto asGlb = [](std::string json) {
        const std::size_t uri = json.find(",\"uri\""), end = json.find('}', uri);
        json.erase(uri, end - uri); // its buffer is the second chunk
        while (json.size() % 4 != 0) json += ' ';
        const std::string buffer = cornersOfTetrahedron();
        const auto length = uint32_t(json.size()), own = uint32_t(buffer.size());
        return "glTF" + bytesOf(uint32_t(2)) + bytesOf(28 + length + own) + bytesOf(length) + "JSON"
            + json + bytesOf(own) + std::string("BIN\0", 4) + buffer;
    };
    for (const std::string name : {"EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression",
             "KHR_mesh_quantization", "EXT_meshopt_compression", "OTHER"}) {
        const std::string scene = withRequired("[\"KHR_materials_unlit\",\"" + name + "\"]");
        EXPECT_TRUE(mentions(errorOf("a.gltf", scene), "extension '" + name + "'")) << name;
        EXPECT_TRUE(mentions(errorOf("a.glb", asGlb(scene)), "extension '" + name + "'")) << name;
    }
    for (const std::string list : {"[]", "[\"KHR_materials_unlit\",\"KHR_texture_transform\"]"}) {
        EXPECT_EQ("", errorOf("a.gltf", withRequired(list))) << list;
        EXPECT_EQ("", errorOf("a.glb", asGlb(withRequired(list)))) << list;
    }
    const std::string latin = withRequired("[\"OTHER\"]").insert(1, "\"name\":\"\xfc\",");
    EXPECT_TRUE(mentions(errorOf("a.gltf", latin), "no JSON in UTF-8"));
    EXPECT_TRUE(mentions(errorOf("a.glb", asGlb(latin)), "no JSON in UTF-8"));
    std::string used = gltfScene(); // not required: the scene is whole without
    used.insert(1, "\"extensionsUsed\":[\"EXT_mesh_gpu_instancing\"],");
    EXPECT_EQ("", errorOf("a.gltf", used));
}

/// As where a process may have no more files open: the file is no damaged one.
TEST(MeshScene, AFileThatCannotBeOpenedIsNotDamaged)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    const std::string message = messageOf<openvdb::IoError>(
        [] { openvdb_spheretree::detail::requireKnownExtensions("nowhere/a.glb"); });
    EXPECT_TRUE(mentions(message, "cannot be opened: No such file"));
}

/// Numbers that are in the text itself: the limits are those of the file.
TEST(MeshScene, ALargeTextIsRead)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    if (kSanitized) GTEST_SKIP() << "its allocator ends the process";
    std::string scene = gltfScene();
    const std::size_t end = scene.find("\"}]}");
    scene.insert(end, std::string(std::size_t(96) << 20, 'A')); // more zeros behind the numbers
    const std::string bytes = "\"byteLength\":144,\"uri\"";
    scene.replace(scene.find(bytes), bytes.size(),
        "\"byteLength\":" + std::to_string(144 + (std::size_t(72) << 20)) + ",\"uri\"");
    EXPECT_EQ("", errorOf("large.gltf", scene));
}

/// Assimp reads it as often, and the limits are of files.
TEST(MeshScene, ABufferThatIsNamedOftenCountsOnce)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    if (kSanitized) GTEST_SKIP() << "its allocator ends the process";
    constexpr int kBytes = 1 << 20;
    const TemporaryFolder folder;
    std::ofstream(folder.path() + "/b.bin", std::ios::binary)
        << cornersOfTetrahedron() << std::string(kBytes - 144, '\0');
    const auto whyNot = [&](int count) {
        std::string primitives, accessors, views, buffers;
        for (int i = 0; i < count; ++i) {
            const std::string comma = i > 0 ? "," : "", number = std::to_string(i);
            primitives += comma + "{\"attributes\":{\"POSITION\":" + number + "}}";
            accessors += comma + "{\"bufferView\":" + number
                + R"(,"componentType":5126,"count":12,"type":"VEC3","min":[0,0,0],"max":[1,1,1]})";
            views += comma + "{\"buffer\":" + number + ",\"byteLength\":144}";
            buffers += comma + R"({"uri":"b.bin","byteLength":)" + std::to_string(kBytes) + "}";
        }
        std::ofstream(folder.path() + "/a.gltf")
            << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
            << "\"meshes\":[{\"primitives\":[" << primitives << "]}],\"accessors\":[" << accessors
            << "],\"bufferViews\":[" << views << "],\"buffers\":[" << buffers << "]}";
        return errorOf(folder.path() + "/a.gltf");
    };
    EXPECT_EQ("", whyNot(10));
    EXPECT_TRUE(mentions(whyNot(600), "more memory")); // than 256 MiB, and 64 for the buffer
}

TEST(MeshScene, ABufferThatIsWrittenToWhileItIsReadIsAnError)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    const TemporaryFolder folder;
    const std::string scene = gltfScene(), path = folder.path() + "/a.gltf";
    const std::string buffer = folder.path() + "/b.bin";
    const std::size_t begin = scene.find("data:"), end = scene.find('"', begin);
    std::ofstream(path) << scene.substr(0, begin) + "b.bin" + scene.substr(end);
    std::ofstream(buffer, std::ios::binary) << cornersOfTetrahedron();
    ASSERT_EQ("", errorOf(path));
    std::atomic<bool> isOver{false};
    std::thread writer([&] {
        for (long i = 0; !isOver; ++i) {
            const timespec times[] = {{i, 0}, {i, 0}};
            utimensat(AT_FDCWD, buffer.c_str(), times, 0);
        }
    });
    std::string why;
    for (int i = 0; i < 100 && why.empty(); ++i) why = errorOf(path);
    isOver = true;
    writer.join();
    EXPECT_TRUE(mentions(why, "b.bin: the file was changed while it was read"));
    EXPECT_EQ("", errorOf(path));
}

TEST(MeshScene, CanBeInterrupted)
{
    if (!readsOtherMeshFormats()) GTEST_SKIP() << "needs a build with assimp";
    struct : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    const TempFile file("scene.gltf", gltfScene());
    EXPECT_THROW(readMeshFile(file.path, {}, &stop), Interrupted);
}

TEST(MeshScene, SaysHowToGetWhatABuildWithoutAssimpLacks)
{
    if (readsOtherMeshFormats()) GTEST_SKIP() << "needs a build without assimp";
    EXPECT_NE(std::string::npos, errorOf("scene.gltf", gltfScene()).find("libassimp-dev"));
}

} // namespace
