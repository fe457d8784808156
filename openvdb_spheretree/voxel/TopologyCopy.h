// SPDX-License-Identifier: Apache-2.0
/// @file TopologyCopy.h
/// @brief A mask of another tree's topology, node by node of 4096^3 voxels, so that it can be
/// interrupted: an object of few voxels far apart takes 300 KB for each, and seconds to copy.

#pragma once

#include <openvdb_spheretree/base/Parallel.h>

#include <openvdb/Types.h>

#include <memory>
#include <vector>

namespace openvdb_spheretree::detail {

/// @return the active voxels and tiles of @a source, with the value true, as a tree whose background
///         is false. Inactive ones are kept as nodes and tiles too.
/// @tparam Result  of bool or ValueMask, of the same configuration as Source
/// @throw Interrupted if the interrupter (may be null) said so
template <typename Result, typename Source>
typename Result::Ptr copyTopology(const Source& source, openvdb::util::NullInterrupter* interrupter)
{
    using ResultNode = typename Result::RootNodeType::ChildNodeType;
    using SourceNode = typename Source::RootNodeType::ChildNodeType;
    std::vector<const SourceNode*> from;
    for (auto node = source.root().cbeginChildOn(); node; ++node) from.push_back(&*node);
    std::vector<std::unique_ptr<ResultNode>> to(from.size());
    parallelFor(from.size(), interrupter, [&](std::size_t i) {
        to[i] = std::make_unique<ResultNode>(*from[i], false, true, openvdb::TopologyCopy());
    });
    auto result = std::make_shared<Result>(false);
    for (auto& node : to) result->root().addChild(node.release());
    for (auto tile = source.root().cbeginValueAll(); tile; ++tile) {
        result->root().addTile(tile.getCoord(), tile.isValueOn(), tile.isValueOn());
    }
    return result;
}

} // namespace openvdb_spheretree::detail
