// SPDX-License-Identifier: Apache-2.0
/// @file TimeOfContact.cc
/// @brief The same steps as those of MotionLanes-inl.h, of two spheres, in doubles, up to the tolerance.
#include "MotionKernels.h"

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Vec3d;

/// A center on its way about an axis.
struct Helix {
    Vec3d v, k, slide; ///< of MotionFrame.h
    double turn;

    Helix(const Screw<double>& screw, const Vec3d& start)
        : slide(screw.slide * vector(screw.axis)), turn(screw.turn)
    {
        const Vec3d axis = vector(screw.axis);
        const Vec3d q = start - vector(screw.point);
        v = axis.cross(q), k = axis * axis.dot(q) - q;
    }
    double acceleration() const { return turn * turn * v.length(); }
    /// From the start to where it is at a time, and how quick it is there.
    void at(double time, Vec3d& way, Vec3d& velocity) const
    {
        const double half = std::sin(0.5 * turn * time), sine = std::sin(turn * time);
        const double versine = 2 * half * half;
        way = sine * v + versine * k + time * slide;
        velocity = turn * ((1 - versine) * v + sine * k) + slide;
    }
};

/// @param at  of a time: the vector between both centers, and its velocity
template <typename At>
double firstWithin(const At& at, double radii, double acceleration, double from, double end,
    const MotionLimits& limits, double& gap)
{
    const double within = radii + limits.margin;
    for (double time = from; time <= end;) {
        Vec3d away, velocity;
        at(time, away, velocity);
        gap = away.length() - radii;
        const double left = away.length() - within;
        if (left <= limits.tolerance) return time;
        const double calm = acceleration > 0 ? std::sqrt(left / acceleration) : INFINITY;
        const double span = std::min(calm, std::max(end - time, 1e-12));
        const double reach = within + 0.5 * acceleration * span * span;
        const double towards = away.dot(velocity), speedSq = velocity.lengthSqr();
        const double outside = away.lengthSqr() - reach * reach;
        double step = span;
        if (towards < 0) {
            const Vec3d beside =
                away - (towards / speedSq) * velocity; // the way goes by so far off
            const double discriminant = speedSq * (reach * reach - beside.lengthSqr());
            if (discriminant >= 0)
                step = std::min(step, outside / (std::sqrt(discriminant) - towards));
        }
        time += std::max(step, 1e-15); // time moves on, whatever rounding does
    }
    return INFINITY;
}

Vec3d centerOf(const FloatSphere& sphere) { return {sphere.x, sphere.y, sphere.z}; }

} // namespace

double timeOfContact(const MotionFrame& frame, const FloatSphere& ofA, const FloatSphere& ofB,
    double from, double end, const MotionLimits& limits, double& gap)
{
    const Vec3d start = frame.pair.pose * centerOf(ofB), between = start - centerOf(ofA);
    const Helix helix(frame.ofB, start);
    const auto at = [&](double time, Vec3d& away, Vec3d& velocity) {
        Vec3d way;
        helix.at(time, way, velocity);
        away = between + way;
    };
    const double radii = double(ofA.r) + ofB.r;
    return firstWithin(at, radii, helix.acceleration(), from, end, limits, gap);
}

double timeOfContact(const MutualFrame& frame, const FloatSphere& ofA, const FloatSphere& ofB,
    double from, double end, const MotionLimits& limits, double& gap)
{
    const Vec3d startA = centerOf(ofA), startB = frame.pair.pose * centerOf(ofB);
    const Vec3d between = startB - startA;
    const Helix helixA(frame.ofA, startA), helixB(frame.ofB, startB);
    const auto at = [&](double time, Vec3d& away, Vec3d& velocity) {
        Vec3d wayA, wayB, velocityA, velocityB;
        helixA.at(time, wayA, velocityA);
        helixB.at(time, wayB, velocityB);
        away = between + (wayB - wayA) + time * frame.drift;
        velocity = velocityB - velocityA + frame.drift;
    };
    const double radii = double(ofA.r) + ofB.r;
    return firstWithin(
        at, radii, helixA.acceleration() + helixB.acceleration(), from, end, limits, gap);
}

} // namespace openvdb_spheretree::detail
