// SPDX-License-Identifier: Apache-2.0
/// @file Ray.h
/// @brief A half-line with what box tests want precomputed.

#pragma once

#include <openvdb/Types.h>

#include <cmath>

namespace openvdb_spheretree::detail {

struct Ray {
    openvdb::Vec3d origin;
    openvdb::Vec3d direction; ///< of length 1
    /// One over the direction; never infinite, so that no product with it is a NaN.
    openvdb::Vec3d inverse;

    Ray(const openvdb::Vec3d& from, const openvdb::Vec3d& along) : origin(from), direction(along)
    {
        constexpr double kTiny = 1e-150;
        for (int axis = 0; axis < 3; ++axis) {
            const double d = along[axis];
            inverse[axis] = 1 / (std::abs(d) < kTiny ? std::copysign(kTiny, d) : d);
        }
    }
    openvdb::Vec3d at(double t) const { return origin + t * direction; }
};

} // namespace openvdb_spheretree::detail
