// SPDX-License-Identifier: Apache-2.0
#include "ContinuousCollide.h"

#include "MotionKernels.h"
#include "MotionRequest.h"
#include "PairAnswers.h"

#include <algorithm>

namespace openvdb_spheretree {
namespace {

detail::MotionLimits limitsOf(
    const QueryTree& a, const QueryTree& b, const ContinuousCollisionRequest& request)
{
    return detail::motionLimits(request, std::min(a.radius(), b.radius()));
}

/// @param frame     MotionFrame or MutualFrame of both
/// @param poseA,poseB  of a time
template <class Frame, typename PoseA, typename PoseB>
ContinuousCollisionResult firstContact(Frame& frame, const QueryTree& a, const PoseA& poseA,
    const QueryTree& b, const PoseB& poseB, const detail::MotionLimits& limits)
{
    ContinuousCollisionResult result;
    result.timeOfContact = result.freeUntil = limits.end;
    // Bodies that are farther apart than anything goes.
    if (frame.pair.rootGap() > frame.longestWay() + limits.margin + frame.pair.rounding)
        return result;
    frame.enterFloats();
    const detail::MotionEnd end = findFirstContact(frame, limits);
    result.blocks = end.blocks;
    result.isDecided = end.isDecided;
    result.freeUntil = end.free;
    result.isCollide = end.pair.a >= 0;
    if (!result.isCollide) return result;
    result.timeOfContact = end.time;
    const RigidTransform placeA = poseA(end.time), placeB = poseB(end.time);
    result.contact = detail::BodyPair(a, placeA, b, placeB).contact(end.pair);
    return result;
}

} // namespace

ContinuousCollisionResult continuousCollide(const QueryTree& a, const RigidTransform& poseA,
    const QueryTree& b, const RigidMotion& motionB, const ContinuousCollisionRequest& request)
{
    const detail::MotionLimits limits = limitsOf(a, b, request);
    detail::MotionFrame frame(a.data(), poseA, b.data(), motionB);
    return firstContact(
        frame, a, [&](double) { return poseA; }, b, [&](double t) { return motionB.at(t); },
        limits);
}

ContinuousCollisionResult continuousCollide(const QueryTree& a, const RigidMotion& motionA,
    const QueryTree& b, const RigidMotion& motionB, const ContinuousCollisionRequest& request)
{
    const detail::MotionLimits limits = limitsOf(a, b, request);
    const auto poseA = [&](double t) { return motionA.at(t); };
    const auto poseB = [&](double t) { return motionB.at(t); };
    if (motionA.radians() != 0 || (motionA.slide() != 0 && motionB.radians() != 0)) {
        detail::MutualFrame frame(a.data(), motionA, b.data(), motionB);
        return firstContact(frame, a, poseA, b, poseB, limits);
    }
    // a stands still, or neither turns and b goes along a line as a sees it.
    const auto seen = motionA.slide() == 0
        ? motionB
        : RigidMotion::line(
            motionB.start(), motionB.slide() * motionB.axis() - motionA.slide() * motionA.axis());
    detail::MotionFrame frame(a.data(), motionA.start(), b.data(), seen);
    return firstContact(frame, a, poseA, b, poseB, limits);
}

} // namespace openvdb_spheretree
