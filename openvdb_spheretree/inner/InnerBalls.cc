// SPDX-License-Identifier: Apache-2.0
#include "InnerBalls.h"

#include "InnerOrder.h"
#include <openvdb_spheretree/medial/MedialLevel.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>

namespace openvdb_spheretree {

std::vector<MedialBall> innerBalls(const openvdb::BoolGrid& object, int64_t most, int dim,
    openvdb::util::NullInterrupter* interrupter)
{
    const FlatAxis flat = flatAxisOf(object, dim);
    const auto voxels = voxelsOf(object, flat);
    const MedialLevel level(*voxels, dim, Distance(), interrupter);
    return detail::ballsInOrder(
        level.balls, detail::innerOrder(level.layout, level.balls, dim, most, interrupter), flat);
}

} // namespace openvdb_spheretree
