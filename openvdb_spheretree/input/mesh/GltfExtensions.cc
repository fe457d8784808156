// SPDX-License-Identifier: Apache-2.0
#include "GltfExtensions.h"

#include <openvdb/Exceptions.h>

#ifdef SPHERETREE_WITH_ASSIMP
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/TextStream.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <istream>
#endif

namespace openvdb_spheretree::detail {

#ifdef SPHERETREE_WITH_ASSIMP

namespace {

using Json = nlohmann::json;

constexpr const char* kMember = "extensionsRequired";

/// Extensions that leave all triangles what they are.
bool isOfLooks(const std::string& extension)
{
    constexpr std::array<const char*, 8> kBeginnings = {"KHR_materials_", "KHR_texture_",
        "KHR_lights_", "KHR_xmp", "EXT_texture_", "EXT_lights_", "MSFT_texture_",
        "ADOBE_materials_"};
    return std::any_of(kBeginnings.begin(), kBeginnings.end(),
        [&](const char* beginning) { return extension.rfind(beginning, 0) == 0; });
}

/// The text of a scene; parts of it that are not asked for take no memory.
Json parsed(std::istream& text)
{
    const auto isKept = [](int depth, Json::parse_event_t event, const Json& key) {
        return depth != 1 || event != Json::parse_event_t::key || key == kMember;
    };
    Json scene = Json::parse(text, isKept, /*allow_exceptions=*/false);
    if (scene.is_discarded()) throw openvdb::IoError("damaged: its text is no JSON in UTF-8");
    return scene;
}

/// @return the scene of a `.gltf`, or of the first chunk of a `.glb`; null of one of version 1, which requires nothing.
Json sceneOf(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file) throw openvdb::IoError("it cannot be opened: " + std::string(std::strerror(errno)));
    struct Header {
        char magic[4];
        uint32_t version, bytes, chunkBytes;
        char chunk[4];
    } header = {};
    file.read(reinterpret_cast<char*>(&header), sizeof(header));
    if (std::memcmp(header.magic, "glTF", 4) != 0) {
        file.clear();
        file.seekg(0);
        return parsed(file);
    }
    if (header.version != 2 || std::memcmp(header.chunk, "JSON", 4) != 0) return {};
    TextStream text;
    char piece[1 << 16];
    for (uint32_t left = header.chunkBytes; left > 0 && file; left -= uint32_t(file.gcount())) {
        file.read(piece, std::min<std::streamsize>(sizeof(piece), left));
        text.write(piece, file.gcount());
    }
    return parsed(text);
}

} // namespace

void requireKnownExtensions(const std::string& path)
{
    const Json scene = sceneOf(path);
    if (!scene.is_object() || !scene.contains(kMember)) return;
    for (const Json& extension : scene[kMember]) {
        if (!extension.is_string() || isOfLooks(extension)) continue;
        constexpr std::size_t kMaxName = 60;
        throw openvdb::IoError("it requires the glTF extension '"
            + onOneLine(extension.get<std::string>(), kMaxName)
            + "', which is not read here: export it as plain triangles, without instances, "
              "compression and quantization, or as .ply, .obj or .stl");
    }
}

#endif

} // namespace openvdb_spheretree::detail
