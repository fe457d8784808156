// SPDX-License-Identifier: Apache-2.0
#include "MedialLevel.h"

#include "detail/StageTimer.h"

#include <algorithm>

namespace openvdb_spheretree {

MedialLevel::MedialLevel(const openvdb::MaskTree& voxels, int dim, const Distance& distance,
    openvdb::util::NullInterrupter* interrupter, BuildSeconds* seconds)
    : layout(detail::timed("layout of leaves", interrupter, seconds ? &seconds->distance : nullptr,
        [&] { return LeafLayout(voxels); })),
      distances(
          detail::timed("distance transform", interrupter, seconds ? &seconds->distance : nullptr,
              [&] { return distanceTransform(layout, dim, interrupter, distance); })),
      labels(detail::timed("power labels", interrupter, seconds ? &seconds->power : nullptr,
          [&] { return powerMap(layout, distances, dim, interrupter); })),
      balls(detail::timed("medial balls", interrupter, seconds ? &seconds->medial : nullptr,
          [&] { return medialBalls(labels, distances, interrupter); }))
{}

int32_t MedialLevel::ballAt(const openvdb::Coord& center) const
{
    const auto it = std::lower_bound(balls.begin(), balls.end(), center,
        [](const MedialBall& ball, const openvdb::Coord& c) { return ball.center < c; });
    if (it == balls.end() || it->center != center) {
        OPENVDB_THROW(openvdb::LookupError, "voxel " << center << " is no centre of a medial ball");
    }
    return int32_t(it - balls.begin());
}

} // namespace openvdb_spheretree
