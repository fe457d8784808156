// SPDX-License-Identifier: Apache-2.0
#include "ValueBlock.h"

#include <openvdb/io/Compression.h>
#include <openvdb/version.h>

#include <blosc.h>
#include <zlib.h>

#include <algorithm>
#include <map>
#include <vector>

namespace openvdb_spheretree::detail {

namespace io = openvdb::io;

namespace {

// LZ4, by which OpenVDB packs, turns a byte into 255 at the most.
constexpr uint64_t kLargestRatio = 255;

/// Values where they lie in the window.
struct StoredValues {
    const char* data;
    uint64_t bytes;
    bool isPacked;
};

StoredValues takeStored(ByteWindow& window, uint32_t compression, uint64_t bytes)
{
    const bool blosc = compression & io::COMPRESS_BLOSC;
    if (!blosc && !(compression & io::COMPRESS_ZIP)) return {window.take(bytes), bytes, false};
    const auto length = window.value<int64_t>();
    if (length <= 0) { // they are not packed
        if (length != -int64_t(bytes))
            window.fail("a node has more or fewer values than it stores");
        return {window.take(bytes), bytes, false};
    }
    const StoredValues stored = {window.take(uint64_t(length)), uint64_t(length), true};
    if (blosc && unpackedBlosc(window, stored.data, stored.bytes) != bytes) {
        window.fail("a node has more or fewer values than it stores");
    }
    return stored;
}

std::vector<char> unpacked(
    const ByteWindow& window, const StoredValues& packed, uint32_t compression, uint64_t bytes)
{
    std::vector<char> values(bytes);
    uLongf count = bytes;
    const bool isWhole = compression & io::COMPRESS_BLOSC
        ? blosc_decompress_ctx(packed.data, values.data(), bytes, 1) == int64_t(bytes)
        : uncompress(reinterpret_cast<Bytef*>(values.data()), &count,
              reinterpret_cast<const Bytef*>(packed.data), packed.bytes)
                == Z_OK
            && count == bytes;
    if (!isWhole) window.fail("packed values cannot be unpacked");
    return values;
}

void requireUnpacked(
    const ByteWindow& window, const BlockFormat& format, const StoredValues& stored, uint64_t bytes)
{
    if (!stored.isPacked) return requireValues(window, format.type, stored.data, bytes);
    const auto values = unpacked(window, stored, format.compression, bytes);
    requireValues(window, format.type, values.data(), bytes);
}

/// Of values that are not stored one by one.
void takeInactive(ByteWindow& window, const BlockFormat& format, uint32_t count)
{
    const uint64_t bytes = uint64_t(count) * format.type.bytes;
    requireValues(window, format.type, window.take(bytes), bytes);
}

} // namespace

std::optional<ValueType> valueTypeOf(const std::string& gridType)
{
    static const std::map<std::string, ValueType> types = {
        {"Tree_bool_5_4_3", {1, 1, LeafKind::Bool}}, {"Tree_mask_5_4_3", {1, 1, LeafKind::Mask}},
        {"Tree_float_5_4_3", {4, 2, LeafKind::Values}},
        {"Tree_double_5_4_3", {8, 2, LeafKind::Values}},
        {"Tree_int32_5_4_3", {4, 4, LeafKind::Values}},
        {"Tree_int64_5_4_3", {8, 8, LeafKind::Values}},
        {"Tree_vec3i_5_4_3", {12, 12, LeafKind::Values}},
        {"Tree_vec3s_5_4_3", {12, 6, LeafKind::Values}},
        {"Tree_vec3d_5_4_3", {24, 6, LeafKind::Values}},
        {"Tree_ptidx32_5_4_3", {4, 4, LeafKind::PointIndices}},
        {"Tree_ptdataidx32_5_4_3", {4, 4, LeafKind::Points}}};
    const auto found = types.find(gridType);
    if (found == types.end()) return std::nullopt;
    return found->second;
}

uint64_t unpackedBlosc(const ByteWindow& window, const char* packed, uint64_t count)
{
    if (count < BLOSC_MIN_HEADER_LENGTH) window.fail("packed values are too short");
    size_t unpacked, packedBytes, blockBytes;
    blosc_cbuffer_sizes(packed, &unpacked, &packedBytes, &blockBytes);
    if (packedBytes != count) window.fail("packed values have two lengths");
    if (unpacked > kLargestRatio * count) window.fail("so few bytes cannot hold so many values");
    return unpacked;
}

void takePacked(ByteWindow& window, uint32_t compression, uint64_t bytes)
{
    takeStored(window, compression, bytes);
}

void requireValues(
    const ByteWindow& window, const ValueType& type, const char* values, uint64_t bytes)
{
    const bool isPoints = type.leaf == LeafKind::Points;
    const bool isBool = type.leaf == LeafKind::Bool || type.leaf == LeafKind::Mask;
    if (!isPoints && !isBool) return;
    const char largest = isPoints ? 0 : 1;
    const auto isNone = [&](char value) { return value < 0 || value > largest; };
    if (std::any_of(values, values + bytes, isNone)) {
        window.fail("the grid's background, or a tile, has a value that it cannot have");
    }
}

ValueBlock takeValues(ByteWindow& window, const BlockFormat& format, uint32_t nodeValues,
    uint32_t activeValues, uint32_t maskBytes, ValueCare care)
{
    const bool selects = format.fileVersion >= openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION;
    const bool activeOnly = format.compression & io::COMPRESS_ACTIVE_MASK;
    ValueBlock block;
    block.selection = selects ? int(window.value<int8_t>()) : int(io::NO_MASK_AND_ALL_VALS);
    switch (block.selection) {
    case io::NO_MASK_OR_INACTIVE_VALS:
    case io::NO_MASK_AND_MINUS_BG:
    case io::NO_MASK_AND_ALL_VALS: break;
    case io::NO_MASK_AND_ONE_INACTIVE_VAL: takeInactive(window, format, 1); break;
    case io::MASK_AND_NO_INACTIVE_VALS: window.take(maskBytes); break;
    case io::MASK_AND_ONE_INACTIVE_VAL:
        takeInactive(window, format, 1);
        window.take(maskBytes);
        break;
    case io::MASK_AND_TWO_INACTIVE_VALS:
        takeInactive(window, format, 2);
        window.take(maskBytes);
        break;
    default: window.fail("a node's values are of no kind that there is");
    }
    const bool allStored = block.selection == io::NO_MASK_AND_ALL_VALS;
    if (!activeOnly && !allStored) window.fail("a node leaves values out where its grid does not");

    const uint64_t stored = allStored ? nodeValues : activeValues;
    const bool half = format.half && format.type.bytesAsHalf != format.type.bytes;
    if (half && stored == 0) return block; // not even a length
    const uint64_t before = window.position(), bytes = stored * storedBytes(format);
    const StoredValues values = takeStored(window, format.compression, bytes);
    if (care == ValueCare::Unpacked) requireUnpacked(window, format, values, bytes);
    block.storedBytes = window.position() - before;
    return block;
}

} // namespace openvdb_spheretree::detail
