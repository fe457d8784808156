// SPDX-License-Identifier: Apache-2.0
/// @file BufferWalk.h
/// @brief What a `.vdb` has of a grid's leaves after its nodes: their values, or points.

#pragma once

#include "ByteWindow.h"
#include "DelayedSizes.h"
#include "ValueBlock.h"

#include <openvdb/Types.h> // Coord

#include <memory>
#include <optional>
#include <vector>

namespace openvdb_spheretree::detail {

/// Walks over the leaves of a grid, as many at a time as fit into a window of moderate size.
class BufferWalk {
public:
    virtual ~BufferWalk() = default;
    /// @return whether there was anything left.
    /// @throw openvdb::IoError if the file is truncated or damaged
    virtual bool takeSome(ByteWindow& window) = 0;

protected:
    static constexpr size_t kWindow = 1 << 20; // bytes; a leaf has some hundred to some thousand
};

/// @param leaves   their origins, in the file's order
/// @param delayed  what the file says of the same leaves in advance, if it does; is held against them
std::unique_ptr<BufferWalk> walkBuffers(const BlockFormat& format,
    std::vector<openvdb::Coord> leaves, std::optional<DelayedSizes> delayed);

} // namespace openvdb_spheretree::detail
