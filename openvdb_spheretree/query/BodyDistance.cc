// SPDX-License-Identifier: Apache-2.0
#include "BodyDistance.h"

#include "PairAnswers.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {
namespace {

using detail::BodyPair;
using detail::LeafPair;
using detail::NearestLimits;
using detail::SearchEnd;

NearestLimits limitsOf(const DistanceRequest& request)
{
    detail::requireLength(request.relErr, "relErr");
    detail::requireLength(request.absErr, "absErr");
    if (std::isnan(request.upperBound) || std::isnan(request.stopBelow)) {
        OPENVDB_THROW(openvdb::ValueError, "upperBound or stopBelow of a distance is not a number");
    }
    NearestLimits limits;
    limits.below = request.upperBound;
    limits.relErr = std::min(request.relErr, 1.0);
    limits.absErr = request.absErr;
    limits.stopBelow = request.stopBelow;
    if (!request.enableSignedDistance) limits.stopBelow = std::max(limits.stopBelow, 0.0);
    limits.maxBlocks = detail::blocksOrAny(request.maxBlocks);
    return limits;
}

void setObjects(DistanceResult& result, const BodyPair& bodies, const LeafPair& pair)
{
    if (bodies.a.holdsObject() && bodies.b.holdsObject()) {
        result.objectsLower = std::max(0.0, result.lowerBound - bodies.frame.rounding);
    }
    if (pair.a >= 0) result.objectsUpper = bodies.objectsUpper(pair);
}

} // namespace

DistanceResult distance(const QueryTree& a, const RigidTransform& poseA, const QueryTree& b,
    const RigidTransform& poseB, const DistanceRequest& request)
{
    const NearestLimits limits = limitsOf(request);
    BodyPair bodies(a, poseA, b, poseB);
    bodies.frame.enterFloats();
    LeafPair nearest;
    int count = 0;
    nearest = bodies.leaves(request.warmStart);
    if (nearest.gap < limits.below) count = 1;
    SearchEnd end;
    // Leaves may reach beyond the spheres above them.
    end.lowerBound = std::min(bodies.frame.rootGap() - bodies.frame.rounding, nearest.gap);
    const bool isEnough = count > 0 && nearest.gap <= limits.stopBelow;
    if (!isEnough) end = findNearest(bodies.frame, limits, &nearest, count);
    const double least = request.enableSignedDistance ? -INFINITY : 0.0;

    DistanceResult result;
    result.blocks = end.blocks;
    result.isDecided = end.isDecided;
    result.lowerBound = std::max(least, end.lowerBound);
    if (count > 0) {
        result.contact = bodies.contact(nearest);
        result.distance = std::max(least, nearest.gap);
    }
    setObjects(result, bodies, count > 0 ? nearest : LeafPair());
    return result;
}

} // namespace openvdb_spheretree
