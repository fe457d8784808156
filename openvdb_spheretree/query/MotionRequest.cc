// SPDX-License-Identifier: Apache-2.0
#include "MotionRequest.h"

#include "PairAnswers.h"

#include <openvdb/Exceptions.h>

#include <algorithm>

namespace openvdb_spheretree::detail {

MotionLimits motionLimits(const ContinuousCollisionRequest& request, double radius)
{
    requireLength(request.tolerance, "the tolerance");
    requireLength(request.securityMargin, "the security margin");
    if (request.securityMargin > kMostExtent) {
        OPENVDB_THROW(openvdb::ValueError,
            "the security margin of a motion is " << request.securityMargin
                                                  << " world units, and must be " << kMostExtent
                                                  << " at most: choose another unit");
    }
    if (!(request.endTime > 0 && request.endTime <= 1)) {
        OPENVDB_THROW(openvdb::ValueError,
            "the end of a motion is at time " << request.endTime
                                              << ": it must be above 0, and 1 at most");
    }
    MotionLimits limits;
    limits.margin = request.securityMargin;
    // Two spheres that stay as near as doubles can tell would take steps without end.
    const double least = 1e-12 * radius;
    limits.tolerance = request.tolerance > 0 ? std::max(request.tolerance, least) : 1e-4 * radius;
    limits.end = request.endTime;
    limits.maxBlocks = blocksOrAny(request.maxBlocks);
    return limits;
}

} // namespace openvdb_spheretree::detail
