// SPDX-License-Identifier: Apache-2.0
#include "GltfExtensions.h"

#include <openvdb/Exceptions.h>

#ifdef SPHERETREE_WITH_NLOHMANN_JSON
#include <openvdb_spheretree/base/Text.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>
#endif

namespace openvdb_spheretree::detail {

#ifdef SPHERETREE_WITH_NLOHMANN_JSON

namespace {

using Json = nlohmann::json;

/// Extensions that leave all triangles what they are.
bool isOfLooks(const std::string& extension)
{
    constexpr std::array<const char*, 8> kBeginnings = {"KHR_materials_", "KHR_texture_",
        "KHR_lights_", "KHR_xmp", "EXT_texture_", "EXT_lights_", "MSFT_texture_",
        "ADOBE_materials_"};
    return std::any_of(kBeginnings.begin(), kBeginnings.end(),
        [&](const char* beginning) { return extension.rfind(beginning, 0) == 0; });
}

/// @return the JSON of a scene: all of a `.gltf`, and the first chunk of a `.glb` of version 2; empty where there is none.
std::string jsonOf(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    if (lowerExtension(path) != ".glb") return {std::istreambuf_iterator<char>(file), {}};
    struct Header {
        char magic[4];
        uint32_t version, bytes, chunkBytes;
        char chunk[4];
    } header = {};
    file.read(reinterpret_cast<char*>(&header), sizeof(header));
    const bool isScene = std::memcmp(header.magic, "glTF", 4) == 0 && header.version == 2
        && std::memcmp(header.chunk, "JSON", 4) == 0;
    std::string json;
    for (uint32_t left = isScene ? header.chunkBytes : 0; left > 0 && file;) {
        char piece[1 << 16];
        file.read(piece, std::min<std::streamsize>(sizeof(piece), left));
        json.append(piece, std::size_t(file.gcount()));
        left -= uint32_t(file.gcount());
    }
    return json;
}

/// @return the member of the scene that lists them, and null where there is none or the text is no JSON.
Json requiredExtensions(const std::string& json)
{
    constexpr auto kMember = "extensionsRequired";
    const auto isKept = [](int depth, Json::parse_event_t event, const Json& key) {
        return depth != 1 || event != Json::parse_event_t::key || key == kMember;
    };
    const Json scene = Json::parse(json, isKept, /*allow_exceptions=*/false);
    return scene.is_object() && scene.contains(kMember) ? scene[kMember] : Json();
}

} // namespace

void requireKnownExtensions(const std::string& path)
{
    for (const Json& extension : requiredExtensions(jsonOf(path))) {
        if (!extension.is_string() || isOfLooks(extension)) continue;
        constexpr std::size_t kMaxName = 60;
        throw openvdb::IoError("it requires the glTF extension '"
            + onOneLine(extension.get<std::string>(), kMaxName)
            + "', which is not read here: export it as plain triangles, without instances, "
              "compression and quantization, or as .ply, .obj or .stl");
    }
}

#else

void requireKnownExtensions(const std::string&)
{
    throw openvdb::IoError(
        "this build lacks nlohmann-json, which .gltf and .glb need: install it (Debian: "
        "nlohmann-json3-dev) and configure with -DSPHERETREE_WITH_NLOHMANN_JSON=ON");
}

#endif

} // namespace openvdb_spheretree::detail
