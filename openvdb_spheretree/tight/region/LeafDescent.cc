// SPDX-License-Identifier: Apache-2.0
#include "LeafDescent.h"

#include <openvdb_spheretree/index/RegionHalving.h>

#include <memory>
#include <numeric>
#include <utility>

namespace openvdb_spheretree::tight {

void forEachLeafWithBalls(const SampleLevel& object, std::vector<int32_t> balls,
    const BallFilter& filter, const LeafBallsBody& body,
    openvdb::util::NullInterrupter* interrupter)
{
    if (object.leafCount() == 0) return;
    /// Some leaves, and the balls that may matter in a region around them.
    struct LeafRegion {
        uint32_t *begin, *end;
        std::shared_ptr<const std::vector<int32_t>> balls;
    };
    std::vector<uint32_t> leaves(object.leafCount());
    std::iota(leaves.begin(), leaves.end(), 0);
    const auto originOf = [&](uint32_t leaf) { return object.origin(leaf); };
    const auto divide = [&](const LeafRegion& region, char&) -> std::vector<LeafRegion> {
        openvdb::CoordBBox box;
        for (const uint32_t* leaf = region.begin; leaf != region.end; ++leaf) {
            box.expand(openvdb::CoordBBox::createCube(object.origin(*leaf), kLeafDim));
        }
        auto near = std::make_shared<std::vector<int32_t>>();
        filter(box, *region.balls, *near);
        if (region.end - region.begin == 1) {
            body(*region.begin, *near);
            return {};
        }
        uint32_t* const middle = detail::halve(region.begin, region.end, box, originOf);
        return {{region.begin, middle, near}, {middle, region.end, near}};
    };
    const LeafRegion whole{leaves.data(), leaves.data() + leaves.size(),
        std::make_shared<const std::vector<int32_t>>(std::move(balls))};
    detail::divideRegions(whole, char(0), divide, interrupter);
}

} // namespace openvdb_spheretree::tight
