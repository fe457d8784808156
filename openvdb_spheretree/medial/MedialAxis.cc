// SPDX-License-Identifier: Apache-2.0
#include "MedialAxis.h"

#include "MedialLevel.h"
#include <openvdb_spheretree/voxel/FlatAxis.h>

namespace openvdb_spheretree {

std::vector<MedialBall> medialBalls(const openvdb::BoolGrid& object, int dim,
    const Distance& distance, openvdb::util::NullInterrupter* interrupter)
{
    const FlatAxis flat = flatAxisOf(object, dim);
    const auto voxels = voxelsOf(object, flat);
    std::vector<MedialBall> balls = MedialLevel(*voxels, dim, distance, interrupter).balls;
    for (MedialBall& ball : balls) ball.center = flat.fromZ(ball.center);
    return balls;
}

} // namespace openvdb_spheretree
