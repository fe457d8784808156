// SPDX-License-Identifier: Apache-2.0
#include "TreeChecksum.h"

#include "SphereTreePoints.h"
#include "TreeMetadata.h"
#include <openvdb_spheretree/base/Checksum.h>
#include <openvdb_spheretree/base/TextStream.h>

#include <algorithm>
#include <array>
#include <cstdio>

namespace openvdb_spheretree {

namespace {

using detail::PartChecksum;
using openvdb::GridBase;
using openvdb::util::NullInterrupter;

constexpr char kChecksumKey[] = "spheretree_checksum";
constexpr char kTransformChecksumKey[] = "spheretree_checksum_transform";
constexpr char kOwnKeys[] = "spheretree_"; // how metadata starts that is ours
constexpr char kAlgorithm[] = "crc32";

/// Zeros have one sign: that of a position gets lost where it is a voxel and an offset.
std::array<double, 3> position(const openvdb::Vec3d& center)
{
    return {center[0] + 0.0, center[1] + 0.0, center[2] + 0.0};
}

template <typename T>
uint32_t crcOf(const std::vector<T>& values, NullInterrupter* interrupter)
{
    return detail::crc32Of<T>(values.size(), interrupter, [&](std::size_t i) { return values[i]; });
}

/// Attributes that nodes of trees and of cuts have in common.
std::vector<PartChecksum> sphereChecksums(const Spheres& nodes, NullInterrupter* interrupter)
{
    const uint32_t positions = detail::crc32Of<std::array<double, 3>>(nodes.center.size(),
        interrupter, [&](std::size_t id) { return position(nodes.center[id]); });
    return {{"P", positions}, {"pscale", crcOf(nodes.radiusWorld, interrupter)},
        {"parent", crcOf(nodes.parent, interrupter)}, {"radius", crcOf(nodes.radius, interrupter)},
        {"cover_sq", crcOf(nodes.coverRadiusSq, interrupter)}};
}

/// Of key, type and value of all metadata that is ours, by keys.
PartChecksum metadataChecksum(const GridBase& grid)
{
    detail::TextStream bytes;
    for (auto meta = grid.beginMeta(); meta != grid.endMeta(); ++meta) {
        const std::string& key = meta->first;
        if (key.rfind(kOwnKeys, 0) != 0) continue;
        if (key == kChecksumKey || key == kTransformChecksumKey) continue;
        bytes << key << '\0' << meta->second->typeName() << '\0';
        meta->second->write(bytes); // its size, then the value
    }
    const std::string all = bytes.str();
    return {"metadata", detail::extendedCrc32(0, all.data(), all.size())};
}

/// Of the map with all its numbers, those that follow from others included: files store them, and
/// readers use them.
PartChecksum transformChecksum(const GridBase& grid)
{
    detail::TextStream bytes;
    grid.transform().write(bytes);
    const std::string all = bytes.str();
    return {"transform", detail::extendedCrc32(0, all.data(), all.size())};
}

/// @return "radius=0a1b2c3d".
std::string wordOf(const PartChecksum& sum)
{
    char digits[16];
    std::snprintf(digits, sizeof(digits), "=%08x", unsigned(sum.crc));
    return sum.part + digits;
}

std::string textOf(const std::vector<PartChecksum>& sums)
{
    std::string text = kAlgorithm;
    for (const PartChecksum& sum : sums) text += ' ' + wordOf(sum);
    return text;
}

/// @return those of @a sums that a checksum of the grid has not. Others that it has may be of parts
///         that came after this version.
std::vector<std::string> missingFrom(
    const GridBase& grid, const char* key, const std::vector<PartChecksum>& sums)
{
    detail::TextStream text(detail::getMeta<std::string>(grid, key));
    std::vector<std::string> words;
    for (std::string word; text >> word;) words.push_back(word);
    if (words.empty() || words.front() != kAlgorithm) {
        OPENVDB_THROW(openvdb::IoError, "metadata '" << key << "' is no checksum");
    }
    std::vector<std::string> missing;
    for (const PartChecksum& sum : sums) {
        if (!std::count(words.begin(), words.end(), wordOf(sum))) missing.push_back(sum.part);
    }
    return missing;
}

[[noreturn]] void throwDamaged(const std::string& parts)
{
    OPENVDB_THROW(
        openvdb::IoError, "by its checksum it is not as it was written: " << parts << " changed");
}

} // namespace

namespace detail {

std::vector<PartChecksum> nodeChecksums(const SphereTree& tree, NullInterrupter* interrupter)
{
    std::vector<PartChecksum> sums = sphereChecksums(tree.spheres, interrupter);
    sums.push_back({"radius_sq", crcOf(tree.radiusSq, interrupter)});
    const auto ijk = [&](std::size_t id) -> std::array<int32_t, 3> {
        return {tree.ijk[id][0], tree.ijk[id][1], tree.ijk[id][2]};
    };
    sums.push_back({"ijk", crc32Of<std::array<int32_t, 3>>(tree.ijk.size(), interrupter, ijk)});
    if (!tree.track.empty()) sums.push_back({"track", crcOf(tree.track, interrupter)});
    return sums;
}

std::vector<PartChecksum> edgeChecksums(
    const std::vector<DagEdge>& edges, NullInterrupter* interrupter)
{
    return {{"edges", crcOf(edges, interrupter)}};
}

std::vector<PartChecksum> cutsChecksums(const SphereCuts& cuts, NullInterrupter* interrupter)
{
    std::vector<PartChecksum> sums = sphereChecksums(cuts.spheres, interrupter);
    sums.push_back({"first", crcOf(cuts.first, interrupter)});
    sums.push_back({"last", crcOf(cuts.last, interrupter)});
    return sums;
}

void writeChecksum(GridBase& grid, const std::vector<PartChecksum>& content)
{
    std::vector<PartChecksum> all = content;
    all.push_back(metadataChecksum(grid));
    setMeta(grid, kChecksumKey, textOf(all));
    setMeta(grid, kTransformChecksumKey, textOf({transformChecksum(grid)}));
}

void verifyDescription(const GridBase& grid)
{
    if (!missingFrom(grid, kChecksumKey, {metadataChecksum(grid)}).empty()) {
        throwDamaged("its metadata (keys that start with 'spheretree_')");
    }
    if (!grid[kTransformChecksumKey]) return;
    if (missingFrom(grid, kTransformChecksumKey, {transformChecksum(grid)}).empty()) return;
    OPENVDB_THROW(openvdb::IoError,
        "its transform is not the one it was written with. If it was moved on purpose, remove the "
        "metadata '"
            << kTransformChecksumKey << "'");
}

void verifyContent(const GridBase& grid, const std::vector<PartChecksum>& content)
{
    std::string parts;
    for (const std::string& part : missingFrom(grid, kChecksumKey, content)) {
        parts += (parts.empty() ? "'" : ", '") + part + "'";
    }
    if (!parts.empty()) throwDamaged(parts);
}

} // namespace detail

bool hasChecksum(const GridBase& grid) { return grid[kChecksumKey] || grid[kTransformChecksumKey]; }

} // namespace openvdb_spheretree
