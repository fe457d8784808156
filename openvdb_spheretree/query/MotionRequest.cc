// SPDX-License-Identifier: Apache-2.0
#include "MotionRequest.h"

#include "PairAnswers.h"

#include <openvdb/Exceptions.h>

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
    limits.tolerance = request.tolerance > 0 ? request.tolerance : 1e-4 * radius;
    limits.end = request.endTime;
    limits.maxBlocks = blocksOrAny(request.maxBlocks);
    return limits;
}

} // namespace openvdb_spheretree::detail
