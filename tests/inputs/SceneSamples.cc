// SPDX-License-Identifier: Apache-2.0
/// @file SceneSamples.cc
/// @brief Samples of meshes that assimp reads: one triangle, its points in the file itself.

#include "SampleBytes.h"
#include "SampleFiles.h"

#include <openvdb_spheretree/input/mesh/MeshFile.h>

#include <cstdint>

namespace spheretree_test {

namespace {

/// @param uri  of the buffer; empty: the second chunk of a .glb
std::string sceneOf(const std::string& uri)
{
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,)"
           R"("translation":[1,2,3]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
           R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
           R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{)"
        + uri + R"("byteLength":36}]})";
}

std::string gltf()
{
    // (0, 0, 0), (1, 0, 0) and (0, 1, 0) as floats
    return sceneOf(R"("uri":"data:application/octet-stream;base64,)"
                   R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",)");
}

std::string chunk(const std::string& type, const std::string& bytes)
{
    return bytesOf(uint32_t(bytes.size())) + type + bytes;
}

std::string glb()
{
    std::string scene = sceneOf(""), points;
    scene.resize((scene.size() + 3) / 4 * 4, ' ');
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) points += bytesOf(x);
    const std::string chunks = chunk("JSON", scene) + chunk(std::string("BIN\0", 4), points);
    return "glTF" + bytesOf(uint32_t(2)) + bytesOf(uint32_t(12 + chunks.size())) + chunks;
}

} // namespace

const std::vector<SampleMaker>& sceneSamples()
{
    constexpr int64_t kMutants = 1000;
    static const std::vector<SampleMaker> samples = {
        {"gltf", ".gltf", gltf, true, kMutants},
        {"glb", ".glb", glb, true, kMutants},
    };
    static const std::vector<SampleMaker> none;
    return openvdb_spheretree::readsOtherMeshFormats() ? samples : none;
}

} // namespace spheretree_test
