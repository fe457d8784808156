// SPDX-License-Identifier: Apache-2.0
#include "PairAnswers.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::detail {

using openvdb::Vec3d;

BodyPair::BodyPair(const QueryTree& treeA, const RigidTransform& inWorldA, const QueryTree& treeB,
    const RigidTransform& inWorldB)
    : a(treeA), b(treeB), poseA(inWorldA), frame(treeA.data(), inWorldA, treeB.data(), inWorldB)
{}

Contact BodyPair::contact(const LeafPair& pair) const
{
    const FloatSphere ofA = frame.a->leaf(pair.a), ofB = frame.b->leaf(pair.b);
    const Vec3d centerA(ofA.x, ofA.y, ofA.z);
    const Vec3d between = frame.pose * Vec3d(ofB.x, ofB.y, ofB.z) - centerA;
    const double length = between.length();
    const Vec3d normal = length > 0 ? between / length : Vec3d(1, 0, 0);
    const Vec3d pointA = centerA + double(ofA.r) * normal;
    const Vec3d pointB = centerA + between - double(ofB.r) * normal;
    Contact result;
    result.nodes = {a.nodeId(pair.a), b.nodeId(pair.b)};
    result.distance = pair.gap;
    result.normal = poseA.rotate(normal);
    result.pointA = poseA * (a.data().origin + pointA);
    result.pointB = poseA * (a.data().origin + pointB);
    return result;
}

LeafPair BodyPair::leaves(const NodePair& nodes) const
{
    LeafPair pair;
    if (nodes == NodePair()) return pair;
    pair.a = a.leafOf(nodes.a);
    pair.b = b.leafOf(nodes.b);
    pair.gap = frame.leafGap(pair.a, pair.b);
    return pair;
}

bool BodyPair::objectsMeet(const LeafPair& pair) const { return objectsUpper(pair) <= 0; }

double BodyPair::objectsUpper(const LeafPair& pair) const
{
    const double a0 = frame.a->leaf(pair.a).r, b0 = frame.b->leaf(pair.b).r;
    // Shrunk leaves lie in the objects: what is left of them, or their centers.
    const double shrunk = pair.gap + std::min(a0, a.leafInset()) + std::min(b0, b.leafInset());
    const double byInset = std::isfinite(a.leafInset() + b.leafInset()) ? shrunk : INFINITY;
    // Every point of a leaf is near its object; a common one is near both.
    const double byReach = std::max(pair.gap, 0.0) + a.leafReach() + b.leafReach();
    return std::max(0.0, std::min(byInset, byReach) + frame.rounding);
}

int64_t blocksOrAny(int64_t maxBlocks)
{
    if (maxBlocks == -1) return std::numeric_limits<int64_t>::max();
    if (maxBlocks >= 1) return maxBlocks;
    OPENVDB_THROW(openvdb::ValueError,
        "a question with maxBlocks " << maxBlocks << ": give 1 or more, or -1 for any number");
}

void requireLength(double length, const char* what)
{
    if (length >= 0 && std::isfinite(length)) return;
    OPENVDB_THROW(
        openvdb::ValueError, what << " is " << length << ": it must be 0 or more, and finite");
}

} // namespace openvdb_spheretree::detail
