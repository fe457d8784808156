// SPDX-License-Identifier: Apache-2.0
#include "LeafNeighbours.h"

#include "Parallel.h"

namespace openvdb_spheretree {
namespace detail {

LeafNeighbours::LeafNeighbours(const LeafLayout& layout) : mNeighbours(layout.leafCount())
{
    const uint32_t count = layout.leafCount();
    parallelFor(27, nullptr, [&](std::size_t direction) {
        const int d = int(direction);
        const openvdb::Coord step(
            (d / 9 - 1) * kLeafDim, (d / 3 % 3 - 1) * kLeafDim, (d % 3 - 1) * kLeafDim);
        uint32_t there = 0;
        for (uint32_t leaf = 0; leaf < count; ++leaf) {
            const openvdb::Coord wanted = layout.origin(leaf) + step;
            while (there < count && layout.origin(there) < wanted) ++there;
            const bool found = there < count && layout.origin(there) == wanted;
            mNeighbours[leaf][direction] = found ? there : kNone;
        }
    });
}

} // namespace detail
} // namespace openvdb_spheretree
