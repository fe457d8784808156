// SPDX-License-Identifier: Apache-2.0
/// @file TimeOfContact.cc
/// @brief The same steps as those of MotionKernels.cc, of two spheres, in doubles, up to the tolerance.
#include "MotionKernels.h"

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::detail {

using openvdb::Vec3d;

double timeOfContact(const MotionFrame& frame, const FloatSphere& ofA, const FloatSphere& ofB,
    double from, double end, double tolerance, double& gap)
{
    const auto& screw = frame.ofB;
    const Vec3d axis(screw.axis[0], screw.axis[1], screw.axis[2]);
    const Vec3d start = frame.pair.pose * Vec3d(ofB.x, ofB.y, ofB.z);
    const Vec3d q = start - Vec3d(screw.point[0], screw.point[1], screw.point[2]);
    const Vec3d v = axis.cross(q), k = axis * axis.dot(q) - q, slide = screw.slide * axis;
    const Vec3d between = start - Vec3d(ofA.x, ofA.y, ofA.z);
    const double turn = screw.turn, acceleration = turn * turn * v.length();
    const double speedSq = turn * turn * v.lengthSqr() + slide.lengthSqr();
    const double radii = double(ofA.r) + ofB.r;
    for (double time = from; time <= end;) {
        const double half = std::sin(0.5 * turn * time), sine = std::sin(turn * time);
        const double versine = 2 * half * half;
        const Vec3d away = between + sine * v + versine * k + time * slide;
        gap = away.length() - radii;
        if (gap <= tolerance) return time;
        const Vec3d velocity = turn * ((1 - versine) * v + sine * k) + slide;
        const double calm = acceleration > 0 ? std::sqrt(gap / acceleration) : INFINITY;
        const double span = std::min(calm, std::max(end - time, 1e-12));
        const double reach = radii + 0.5 * acceleration * span * span;
        const double towards = away.dot(velocity), outside = away.lengthSqr() - reach * reach;
        const double discriminant = towards * towards - speedSq * outside;
        double step = span;
        if (towards < 0 && discriminant >= 0)
            step = std::min(step, outside / (std::sqrt(discriminant) - towards));
        time += std::max(step, 1e-15); // time moves on, whatever rounding does
    }
    return INFINITY;
}

} // namespace openvdb_spheretree::detail
