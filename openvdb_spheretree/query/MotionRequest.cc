// SPDX-License-Identifier: Apache-2.0
#include "MotionRequest.h"

#include "PairAnswers.h"

#include <openvdb/Exceptions.h>

#include <algorithm>

namespace openvdb_spheretree::detail {

MotionLimits motionLimits(const ContinuousCollisionRequest& request, double radius)
{
    requireLength(request.tolerance, "the tolerance");
    if (!(request.endTime > 0 && request.endTime <= 1)) {
        OPENVDB_THROW(openvdb::ValueError,
            "the end of a motion is at time " << request.endTime
                                              << ": it must be above 0, and 1 at most");
    }
    MotionLimits limits;
    // Two spheres that stay as near as doubles can tell would take steps without end.
    const double least = 1e-12 * radius;
    limits.tolerance = request.tolerance > 0 ? std::max(request.tolerance, least) : 1e-4 * radius;
    limits.end = request.endTime;
    limits.maxBlocks = blocksOrAny(request.maxBlocks);
    return limits;
}

} // namespace openvdb_spheretree::detail
