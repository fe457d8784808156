// SPDX-License-Identifier: Apache-2.0
/// @file RayFrame.h
/// @brief Rays of the world as kernels take them: floats about the origin of the blocks, starting
/// near the tree, and how far rounding may be off.
///
/// A line is cut to what passes the root's sphere: its origin becomes the point nearest to the
/// center of that. So floats are as fine as the tree is large, however far the ray comes.
///
/// *Rounding.* Let e = 2^-24 and E the extent of the blocks. Centers and the new origin are within
/// 2 E of each other. The direction is off by 2 e, the origin by e E, products and differences of
/// the cross product by 4 e E, its length by 6 e E, and the squared radius by a few e E^2: all
/// together moves a sphere by less than 32 e E. That far doubles are off, too, if a ray starts not
/// more than 2^26 E away; those further away are refused. Spheres grow by this `slack`, and where a
/// ray enters is less by it.

#pragma once

#include "PointFrame.h"
#include "QueryData.h"
#include "RayKernel.h"
#include "RayQuery.h"

#include <openvdb/math/Vec3.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::detail {

struct LocalRay {
    static constexpr double kFarthestStart = 0x1p26; ///< times the extent
    /// Directions whose squared length is beyond these are scaled first.
    static constexpr double kLeastSq = 1e-300, kMostSq = 1e300;

    static double largestOf(const openvdb::Vec3d& v)
    {
        return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
    }
    /// @return t 2^exponent; most rays have no exponent, and need no call.
    static double scaled(double t, int exponent) { return exponent ? std::ldexp(t, exponent) : t; }

    /// @param ray  as intersect() takes it
    LocalRay(const QueryData& tree, const QueryRay& ray)
    {
        const FloatSphere& root = tree.spheres.root;
        const openvdb::Vec3d center(root.x, root.y, root.z), from = ray.origin - tree.origin;
        const double extent = tree.spheres.extent, slack = 32 * kFloatError * extent;
        openvdb::Vec3d direction = ray.direction;
        double lengthSq = direction.lengthSqr();
        if (!(lengthSq >= kLeastSq && lengthSq <= kMostSq)) {
            exponent = std::ilogb(largestOf(direction));
            for (int axis = 0; axis < 3; ++axis)
                direction[axis] = std::ldexp(direction[axis], -exponent);
            lengthSq = direction.lengthSqr();
        }
        const double length = std::sqrt(lengthSq);
        shift = (center - from).dot(direction) / lengthSq;
        perWorld = 1 / length;
        const openvdb::Vec3d middle = from + shift * direction;
        const double reach = root.r + 2 * slack;
        const double near = (scaled(ray.tNear, exponent) - shift) * length;
        const double far = (scaled(ray.tFar, exponent) - shift) * length;
        misses = (middle - center).lengthSqr() > reach * reach || near > reach || far < -reach
            || near > far;
        for (int axis = 0; axis < 3; ++axis) {
            question.origin[axis] = float(middle[axis]);
            question.direction[axis] = float(direction[axis] * perWorld);
        }
        // Nothing is beyond `reach`, but empty lanes are.
        question.near = float(std::max(near, -2 * reach) - slack);
        question.far = float(std::min(far, 2 * reach) + 2 * slack);
        question.slack = float(slack);
        question.leavesStart = ray.leavesStart;
        question.anyHit = false;
    }

    /// @return where the ray enters what a kernel found.
    double entry(float key, const QueryRay& ray) const
    {
        const double t = scaled(shift + (double(key) - question.slack) * perWorld, -exponent);
        return std::min(std::max(t, ray.tNear), ray.tFar);
    }

    RayQuestion question;
    double shift;    ///< of the ray, where the kernel's numbers along it are 0
    double perWorld; ///< of the ray, for one world unit
    int exponent =
        0; ///< shift and perWorld count by 2^exponent, so that no square leaves the range of doubles
    bool misses; ///< the root's sphere: then there is no question
};

} // namespace openvdb_spheretree::detail
