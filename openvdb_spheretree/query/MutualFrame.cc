// SPDX-License-Identifier: Apache-2.0
#include "MutualFrame.h"

#include <openvdb_spheretree/base/Rounding.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Vec3d;

/// Of a body's screw, without its slide.
Screw<double> turnOf(const RigidMotion& motion, const RigidTransform& toFrame, const Vec3d& origin)
{
    return {numbers(toFrame * motion.point() - origin), numbers(toFrame.rotate(motion.axis())),
        motion.radians(), 0};
}

std::array<float, 3> rounded(const Vec3d& v) { return {float(v[0]), float(v[1]), float(v[2])}; }

double wayAround(const Screw<double>& screw, const Vec3d& center, double extent)
{
    const double fromAxis = (center - vector(screw.point)).cross(vector(screw.axis)).length();
    return std::abs(screw.turn) * (fromAxis + extent);
}

} // namespace

MutualFrame::MutualFrame(const QueryData& dataA, const RigidMotion& motionA, const QueryData& dataB,
    const RigidMotion& motionB)
    : pair(dataA, motionA.start(), dataB, motionB.start())
{
    const RigidTransform toA = motionA.start().inverse();
    ofA = turnOf(motionA, toA, dataA.origin);
    ofB = turnOf(motionB, toA, dataA.origin);
    drift = toA.rotate(motionB.slide() * motionB.axis() - motionA.slide() * motionA.axis());
}

double MutualFrame::longestWay() const
{
    return wayAround(ofA, Vec3d(0.0), pair.a->extent)
        + wayAround(ofB, pair.pose.translation(), pair.b->extent) + drift.length();
}

void MutualFrame::enterFloats()
{
    requireWay(longestWay());
    pair.enterFloats();
    const RigidTransform toB = pair.pose.inverse();
    const Screw<double> ofAInB = moved(toB, ofA), ofBInB = moved(toB, ofB);
    inA = {rounded(ofA), rounded(ofB), rounded(drift)};
    inB = {rounded(ofBInB), rounded(ofAInB), rounded(-toB.rotate(drift))};
    // As of a MotionFrame, of both turns: some 80 roundings of the way that each makes, 30 of these of a velocity over its step;
    // and those of the distance.
    double ways = drift.length();
    for (const Screw<double>* screw : {&ofA, &ofB}) {
        const Screw<double>& again = screw == &ofA ? ofAInB : ofBInB;
        const double points = vector(screw->point).length() + vector(again.point).length();
        ways += std::min(2.0, std::abs(screw->turn)) * (pair.reach() + points);
    }
    pad = toFloatUp(double(pair.pad) + 0x1p-24 * (112 * ways + 16 * pair.reach()));
}

} // namespace openvdb_spheretree::detail
