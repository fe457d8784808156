// SPDX-License-Identifier: Apache-2.0
#include "LeafNeighbours.h"

#include "LeafWalk.h"
#include <openvdb_spheretree/base/Parallel.h>

#include <algorithm>

namespace openvdb_spheretree {
namespace detail {

LeafNeighbours::LeafNeighbours(const LeafLayout& layout) : mNeighbours(layout.leafCount())
{
    constexpr std::size_t kChunk = 256;
    const std::size_t count = mNeighbours.size();
    parallelFor((count + kChunk - 1) / kChunk, nullptr, [&](std::size_t chunk) {
        const std::size_t begin = chunk * kChunk;
        LeafWalk around(layout, uint32_t(begin));
        for (std::size_t leaf = begin; leaf < std::min(begin + kChunk, count); ++leaf) {
            around.moveTo(uint32_t(leaf));
            mNeighbours[leaf] = around.all();
        }
    });
}

} // namespace detail
} // namespace openvdb_spheretree
