// SPDX-License-Identifier: Apache-2.0
#include "LeafBalls.h"

#include "../detail/Parallel.h"
#include "BallMask.h"

#include <algorithm>

namespace openvdb_spheretree {
namespace tight {

LeafBalls::LeafBalls(const std::vector<FineBall>& balls, const SampleLevel& object,
    openvdb::util::NullInterrupter* interrupter)
    : mBegin(object.leafCount() + 2, 0)
{
    std::vector<std::vector<uint32_t>> leaves(balls.size());
    detail::parallelFor(balls.size(), interrupter, [&](std::size_t i) {
        openvdb::CoordBBox box;
        if (!ballBox(balls[i], box)) return;
        object.forEachLeaf(box, [&](std::size_t leaf) {
            if (mayReach(balls[i], object.origin(leaf))) leaves[i].push_back(uint32_t(leaf));
        });
    });
    for (const auto& list : leaves) {
        for (const uint32_t leaf : list) ++mBegin[leaf + 2];
    }
    for (std::size_t leaf = 2; leaf < mBegin.size(); ++leaf) mBegin[leaf] += mBegin[leaf - 1];
    mBalls.resize(mBegin.back());
    for (std::size_t i = 0; i < balls.size(); ++i) {
        for (const uint32_t leaf : leaves[i]) mBalls[mBegin[leaf + 1]++] = int32_t(i);
    }
}

uint32_t LeafBalls::most() const
{
    std::size_t most = 0;
    for (std::size_t leaf = 0; leaf + 2 < mBegin.size(); ++leaf) {
        most = std::max(most, of(leaf).size());
    }
    return uint32_t(most);
}

} // namespace tight
} // namespace openvdb_spheretree
