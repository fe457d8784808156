// SPDX-License-Identifier: Apache-2.0
#include "ContinuousCollide.h"

#include "MotionKernels.h"
#include "PairAnswers.h"

#include <openvdb/Exceptions.h>

#include <algorithm>

namespace openvdb_spheretree {
namespace {

detail::MotionLimits limitsOf(
    const QueryTree& a, const QueryTree& b, const ContinuousCollisionRequest& request)
{
    detail::requireLength(request.tolerance, "the tolerance");
    if (!(request.endTime > 0 && request.endTime <= 1)) {
        OPENVDB_THROW(openvdb::ValueError,
            "the end of a motion is at time " << request.endTime
                                              << ": it must be above 0, and 1 at most");
    }
    detail::MotionLimits limits;
    limits.tolerance =
        request.tolerance > 0 ? request.tolerance : 1e-4 * std::min(a.radius(), b.radius());
    limits.end = request.endTime;
    limits.maxBlocks = detail::blocksOrAny(request.maxBlocks);
    return limits;
}

} // namespace

ContinuousCollisionResult continuousCollide(const QueryTree& a, const RigidTransform& poseA,
    const QueryTree& b, const RigidMotion& motionB, const ContinuousCollisionRequest& request)
{
    const detail::MotionLimits limits = limitsOf(a, b, request);
    detail::MotionFrame frame(a.data(), poseA, b.data(), motionB);
    ContinuousCollisionResult result;
    result.timeOfContact = result.freeUntil = limits.end;
    // Bodies that are farther apart than anything goes.
    if (frame.pair.rootGap() > frame.longestWay() + frame.pair.rounding) return result;
    frame.enterFloats();
    const detail::MotionEnd end = findFirstContact(frame, limits);
    result.blocks = end.blocks;
    result.isDecided = end.isDecided;
    result.freeUntil = end.free;
    result.isCollide = end.pair.a >= 0;
    if (!result.isCollide) return result;
    result.timeOfContact = end.time;
    const detail::BodyPair bodies(a, poseA, b, motionB.at(end.time));
    result.contact = bodies.contact(end.pair);
    return result;
}

} // namespace openvdb_spheretree
