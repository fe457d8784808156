// SPDX-License-Identifier: Apache-2.0
/// @file ValueBlock.h
/// @brief The values of a node as a `.vdb` has them: which are stored, and how they are compressed.
///
/// OpenVDB believes the length of a block before it compares it with the size of its buffer
/// (version 10, bloscFromStream and unzipFromStream). Here it is compared first.

#pragma once

#include "ByteWindow.h"

#include <cstdint>
#include <optional>
#include <string>

namespace openvdb_spheretree::detail {

/// How the leaf nodes of a grid are stored.
enum class LeafKind { Values, Bool, Mask, PointIndices, Points };

/// What a grid's type says about its values.
struct ValueType {
    uint32_t bytes = 0;       ///< of a value
    uint32_t bytesAsHalf = 0; ///< of one that is stored in half precision
    LeafKind leaf = LeafKind::Values;
};

/// @param gridType  as in a file, without the suffix for half precision: `Tree_float_5_4_3`
/// @return nothing if no grid of this type is read.
std::optional<ValueType> valueTypeOf(const std::string& gridType);

/// What must be known of a file and of its grid to find the end of a block of values.
struct BlockFormat {
    uint32_t fileVersion = 0;
    uint32_t compression = 0; ///< flags of openvdb::io
    bool half = false;        ///< real values are stored in half precision
    ValueType type;
};

/// @return bytes of a value as it is stored.
inline uint32_t storedBytes(const BlockFormat& format)
{
    return format.half ? format.type.bytesAsHalf : format.type.bytes;
}

/// Where a block of values differs from one node to the next.
struct ValueBlock {
    int selection = 0;        ///< what is stored of inactive values (openvdb/io/Compression.h)
    uint64_t storedBytes = 0; ///< of the values as they are stored, with their length; 0 without
};

/// @brief Walk over a length and the bytes compressed by it.
/// @param bytes  of the values when they are unpacked
/// @throw openvdb::IoError if OpenVDB would read anything else but @a bytes bytes
void takePacked(ByteWindow& window, uint32_t compression, uint64_t bytes);

/// @brief See to it that values are such as their type has. A bool that is neither 0 nor 1 is none, and a new leaf of points
/// asserts that it has no other value than zero; of all other types any bytes are a value.
/// @param values  as they are stored, unpacked
/// @throw openvdb::IoError if they are not
void requireValues(
    const ByteWindow& window, const ValueType& type, const char* values, uint64_t bytes);

/// What is looked at of a node's values.
enum class ValueCare {
    Length, ///< how long they are, packed: of leaves, which are many
    Unpacked ///< them all: of nodes above leaves. OpenVDB loses such a node where it fails to unpack its values.
};

/// @brief Walk over the values of a node.
/// @param nodeValues    how many the node has: a power of two, or fewer in files before version 222
/// @param activeValues  how many of them are active
/// @param maskBytes     of a mask of the node
ValueBlock takeValues(ByteWindow& window, const BlockFormat& format, uint32_t nodeValues,
    uint32_t activeValues, uint32_t maskBytes, ValueCare care);

/// @return bytes that a Blosc buffer says it holds.
/// @throw openvdb::IoError if it is not @a count bytes long, or says that it holds more than LZ4 can
///        have packed into so many
uint64_t unpackedBlosc(const ByteWindow& window, const char* packed, uint64_t count);

} // namespace openvdb_spheretree::detail
