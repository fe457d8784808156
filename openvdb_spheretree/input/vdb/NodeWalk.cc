// SPDX-License-Identifier: Apache-2.0
#include "NodeWalk.h"

#include <openvdb/util/NodeMasks.h>
#include <openvdb/version.h>

#include <algorithm>

namespace openvdb_spheretree::detail {

using openvdb::Coord;

namespace {

constexpr int32_t kUpperDim = 4096; // voxels along a side of the root's children

template <openvdb::Index Log2Dim>
openvdb::util::NodeMask<Log2Dim> takeMask(ByteWindow& window)
{
    using Mask = openvdb::util::NodeMask<Log2Dim>;
    Mask mask;
    static_assert(sizeof(Mask) == Mask::SIZE / 8);
    std::memcpy(static_cast<void*>(&mask), window.take(sizeof(Mask)), sizeof(Mask));
    return mask;
}

/// @brief Walk over an internal node and what is below it.
/// @param childDim   voxels along a side of a child
/// @param takeChild  called with the origin of each child
template <openvdb::Index Log2Dim, typename TakeChild>
void takeInternal(ByteWindow& window, const BlockFormat& format, const Coord& origin,
    int32_t childDim, const TakeChild& takeChild)
{
    using Mask = openvdb::util::NodeMask<Log2Dim>;
    const auto children = takeMask<Log2Dim>(window);
    const auto active = takeMask<Log2Dim>(window);
    const bool leavesGaps =
        format.fileVersion >= openvdb::OPENVDB_FILE_VERSION_NODE_MASK_COMPRESSION;
    takeValues(window, format, leavesGaps ? Mask::SIZE : children.countOff(), active.countOn(),
        Mask::SIZE / 8, ValueCare::Unpacked);
    for (auto child = children.beginOn(); child; ++child) {
        const auto x = int32_t(child.pos() >> 2 * Log2Dim);
        const auto y = int32_t(child.pos() >> Log2Dim & (Mask::DIM - 1));
        const auto z = int32_t(child.pos() & (Mask::DIM - 1));
        takeChild(origin.offsetBy(x * childDim, y * childDim, z * childDim));
    }
}

/// @return a place in the root's table. @throw openvdb::IoError if nothing can be there
Coord takeOrigin(ByteWindow& window)
{
    const auto x = window.value<int32_t>(), y = window.value<int32_t>(),
               z = window.value<int32_t>();
    if (((x | y | z) & (kUpperDim - 1)) != 0) window.fail("a node is where no node can be");
    return Coord(x, y, z);
}

/// The background, or the value of a tile.
void takeValue(ByteWindow& window, const ValueType& type)
{
    requireValues(window, type, window.take(type.bytes), type.bytes);
}

} // namespace

double bytesOf(const GridNodes& nodes, const ValueType& type)
{
    // An entry holds a tile's value or a pointer; there are two bits for each.
    const double entry = std::max<double>(type.bytes, sizeof(void*)) + 2.0 / 8;
    constexpr double kLeaf = 96; // its masks, and its place
    return entry * (32768.0 * double(nodes.upper) + 4096.0 * double(nodes.lower))
        + kLeaf * double(nodes.leaves.size());
}

GridNodes takeNodes(ByteWindow& window, const BlockFormat& format)
{
    GridNodes nodes;
    window.value<int32_t>();        // buffers a leaf, which nobody reads
    takeValue(window, format.type); // background
    const auto tiles = window.value<uint32_t>();
    const auto children = window.value<uint32_t>();
    for (uint32_t i = 0; i < tiles; ++i) {
        takeOrigin(window);
        takeValue(window, format.type);
        if (window.value<uint8_t>() > 1) window.fail("a tile is neither active nor inactive");
    }
    Coord last;
    for (uint32_t i = 0; i < children; ++i) {
        const Coord upper = takeOrigin(window);
        // Their values follow in the order of the root's table, which has one entry for each place.
        if (i > 0 && !(last < upper)) window.fail("nodes are out of order");
        last = upper;
        ++nodes.upper;
        takeInternal<5>(window, format, upper, 128, [&](const Coord& lower) {
            ++nodes.lower;
            takeInternal<4>(window, format, lower, 8, [&](const Coord& leaf) {
                takeMask<3>(window);
                nodes.leaves.push_back(leaf);
            });
        });
    }
    return nodes;
}

} // namespace openvdb_spheretree::detail
