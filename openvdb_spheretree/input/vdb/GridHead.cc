// SPDX-License-Identifier: Apache-2.0
#include "GridHead.h"

#include <openvdb_spheretree/base/TextStream.h>

#include <openvdb/Grid.h>
#include <openvdb/Metadata.h>
#include <openvdb/MetaMap.h>
#include <openvdb/io/Compression.h>
#include <openvdb/io/DelayedLoadMetadata.h>
#include <openvdb/math/Maps.h>
#include <openvdb/version.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

namespace openvdb_spheretree::detail {

namespace io = openvdb::io;
using openvdb::math::MapRegistry;
using openvdb::math::NonlinearFrustumMap;

namespace {

constexpr size_t kTagLength = 36;
constexpr std::string_view kHalfSuffix = "_HalfFloat"; // of types whose values are stored so
constexpr uint64_t kLeastGrid = 48;  // bytes of a grid without name, metadata and nodes
constexpr uint64_t kLeastEntry = 12; // bytes of a metadata entry without name and value

/// @return how many entries follow, which the file is long enough for.
uint32_t takeCount(ByteWindow& window)
{
    const auto count = window.value<uint32_t>();
    window.require(count * kLeastEntry);
    return count;
}

/// OpenVDB gives values of these types their size, whatever the file says.
void requireSize(const ByteWindow& window, const std::string& type, uint32_t bytes)
{
    if (!openvdb::Metadata::isRegisteredType(type)) return;
    if (type == openvdb::StringMetadata::staticTypeName()) return;
    if (openvdb::Metadata::createMetadata(type)->size() != bytes) {
        window.fail("a value of metadata is longer or shorter than its type");
    }
}

/// @return what is said of the leaves in the entry that OpenVDB asks: with Keep, and if there is one
std::optional<DelayedSizes> takeEntries(ByteWindow& window, DelayedMetadata treatment)
{
    std::optional<DelayedSizes> delayed;
    const size_t begin = window.size();
    const uint32_t count = takeCount(window);
    uint32_t kept = count;
    for (uint32_t i = 0; i < count; ++i) {
        const size_t entry = window.size();
        const std::string name = window.string(), type = window.string();
        const auto bytes = window.value<uint32_t>();
        if (type != io::DelayedLoadMetadata::staticTypeName()) {
            requireSize(window, type, bytes);
            const char* value = window.take(bytes);
            const bool boolean = type == openvdb::BoolMetadata::staticTypeName();
            if (boolean && *value != 0 && *value != 1) window.fail("neither true nor false");
        } else if (treatment == DelayedMetadata::Keep) { // OpenVDB parses all, and asks one
            DelayedSizes sizes = takeDelayedSizes(window, bytes);
            if (name == openvdb::GridBase::META_FILE_DELAYED_LOAD) delayed = std::move(sizes);
        } else {
            window.take(bytes);
            window.eraseFrom(entry);
            --kept;
        }
    }
    std::memcpy(window.data() + begin, &kept, sizeof(kept));
    return delayed;
}

void requireTag(ByteWindow& window)
{
    const char* tag = window.take(kTagLength);
    for (size_t i = 0; i < kTagLength; ++i) {
        const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
        const bool right = dash ? tag[i] == '-' : std::isxdigit(static_cast<unsigned char>(tag[i]));
        if (!right) window.fail("its identifier is none");
    }
}

void takeLinearMap(ByteWindow& window, const std::string& type)
{
    if (!MapRegistry::isRegistered(type) || type == NonlinearFrustumMap::mapType()) {
        window.fail("its transform is of no type that there is");
    }
    detail::TextStream written;
    MapRegistry::createMap(type)->write(written);
    window.take(written.str().size());
}

void takeTransform(ByteWindow& window, uint32_t fileVersion)
{
    const std::string type = window.string();
    if (type != NonlinearFrustumMap::mapType()) {
        takeLinearMap(window, type);
        return;
    }
    const bool integerBox = fileVersion < openvdb::OPENVDB_FILE_VERSION_FLOAT_FRUSTUM_BBOX;
    window.take(6 * (integerBox ? sizeof(int32_t) : sizeof(double)));
    window.take(2 * sizeof(double)); // taper, depth
    takeLinearMap(window, window.string());
}

std::string withoutSuffix(const std::string& gridType)
{
    const size_t length = gridType.size() - std::min(gridType.size(), kHalfSuffix.size());
    return gridType.substr(length) == kHalfSuffix ? gridType.substr(0, length) : gridType;
}

/// What metadata says once OpenVDB has read it. All its lengths must have been looked at before.
bool savesHalf(const char* metadata, size_t bytes)
{
    detail::TextStream in(std::string(metadata, bytes));
    openvdb::MetaMap map;
    map.readMeta(in);
    const auto entry = map[openvdb::GridBase::META_SAVE_HALF_FLOAT];
    return entry && entry->asBool();
}

} // namespace

void takeMetadata(ByteWindow& window) { takeEntries(window, DelayedMetadata::Keep); }

FileHead takeFileHead(ByteWindow& window, DelayedMetadata treatment)
{
    if (window.value<int64_t>() != openvdb::OPENVDB_MAGIC) {
        OPENVDB_THROW(openvdb::IoError, "not a VDB file");
    }
    FileHead file;
    file.fileVersion = window.value<uint32_t>();
    if (file.fileVersion < openvdb::OPENVDB_FILE_VERSION_NEW_TRANSFORM) {
        OPENVDB_THROW(openvdb::IoError,
            "the file is of format version "
                << file.fileVersion
                << ", older than OpenVDB 1.0; save it anew with a program that reads it");
    }
    const auto major = window.value<uint32_t>(), minor = window.value<uint32_t>();
    file.staleSizes = major < 6 || (major == 6 && minor <= 1);
    file.hasOffsets = window.value<char>();
    const bool older = file.fileVersion < openvdb::OPENVDB_FILE_VERSION_SELECTIVE_COMPRESSION;
    if (older) file.compression = io::COMPRESS_ZIP | io::COMPRESS_ACTIVE_MASK;
    if (!older && file.fileVersion < openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION) {
        file.compression = window.value<char>() ? io::COMPRESS_ZIP : io::COMPRESS_NONE;
    }
    requireTag(window);
    takeEntries(window, treatment);
    file.gridCount = window.value<int32_t>();
    if (file.gridCount < 0) window.fail("it has fewer grids than none");
    window.require(uint64_t(file.gridCount) * kLeastGrid);
    return file;
}

GridHead takeGridHead(ByteWindow& window, const FileHead& file, DelayedMetadata treatment)
{
    GridHead grid;
    grid.name = window.string();
    grid.type = withoutSuffix(window.string());
    grid.instance = !window.string().empty();
    grid.saidBegin = window.value<int64_t>();
    window.value<int64_t>(); // where its buffers begin
    grid.saidEnd = window.value<int64_t>();
    grid.begin = window.position();

    grid.compression = file.compression;
    if (file.fileVersion >= openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION) {
        grid.compression = window.value<uint32_t>();
    }
    const size_t metadata = window.size();
    grid.delayed = takeEntries(window, treatment);
    if (file.staleSizes) grid.delayed.reset();
    grid.half = savesHalf(window.data() + metadata, window.size() - metadata);
    takeTransform(window, file.fileVersion);
    return grid;
}

} // namespace openvdb_spheretree::detail
