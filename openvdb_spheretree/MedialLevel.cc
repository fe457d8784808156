// SPDX-License-Identifier: Apache-2.0
#include "MedialLevel.h"

#include "detail/StageTimer.h"

#include <algorithm>
#include <cassert>

namespace openvdb_spheretree {

MedialLevel::MedialLevel(const openvdb::MaskTree& voxels, int dim,
    openvdb::util::NullInterrupter* interrupter, BuildSeconds* seconds)
    : layout(
        detail::timed(seconds ? &seconds->distance : nullptr, [&] { return LeafLayout(voxels); })),
      distances(detail::timed(seconds ? &seconds->distance : nullptr,
          [&] { return distanceTransform(layout, dim, interrupter); })),
      labels(detail::timed(seconds ? &seconds->power : nullptr,
          [&] { return powerMap(layout, distances, dim, interrupter); })),
      balls(detail::timed(seconds ? &seconds->medial : nullptr,
          [&] { return medialBalls(labels, distances, interrupter); }))
{}

int32_t MedialLevel::ballAt(const openvdb::Coord& center) const
{
    const auto it = std::lower_bound(balls.begin(), balls.end(), center,
        [](const MedialBall& ball, const openvdb::Coord& c) { return ball.center < c; });
    assert(it != balls.end() && it->center == center);
    return int32_t(it - balls.begin());
}

} // namespace openvdb_spheretree
