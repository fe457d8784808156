// SPDX-License-Identifier: Apache-2.0
/// @file ExactSphere.h
/// @brief A closed sphere in exact integers, centered on a voxel or between voxels.

#pragma once

#include <openvdb_spheretree/voxel/Distance.h>

#include <openvdb/Types.h>

#include <cmath>
#include <cstdint>

namespace openvdb_spheretree {

/// What the spheres of a list have in common: the distance they are balls of, and the units of
/// their integers. Where only a distance is given, units are halves of a voxel.
struct SphereMetric {
    Distance distance;
    /// Units in a voxel: SphereTree::subdivision. A power of two, 2 to kMaxSubdivision.
    int subdivision = 2;

    static constexpr int kMaxSubdivision = 1024;

    SphereMetric() = default;
    SphereMetric(const Distance& metric, int parts = 2) : distance(metric), subdivision(parts) {}
};

/// The voxels q of the grid it is drawn on with |subdivision q - center|^2 <= radiusSq, where the
/// subdivision and the length are those of the SphereMetric beside it. Centers between voxels are
/// integers too, so which voxels a sphere holds is exact. An aggregate: ExactSphere() is empty.
struct ExactSphere {
    int64_t center[3] = {0, 0, 0}; ///< units
    int64_t radiusSq = -1;         ///< units squared; negative: the empty sphere

    /// @return the sphere around a voxel.
    static ExactSphere around(const openvdb::Coord& voxel, int64_t radiusSq, int subdivision = 2)
    {
        const int64_t units = subdivision;
        return {{units * voxel[0], units * voxel[1], units * voxel[2]}, radiusSq};
    }

    bool empty() const { return radiusSq < 0; }
    /// Units; the sphere must not be empty.
    double radius() const { return std::sqrt(double(radiusSq)); }
    bool operator==(const ExactSphere& o) const
    {
        return center[0] == o.center[0] && center[1] == o.center[1] && center[2] == o.center[2]
            && radiusSq == o.radiusSq;
    }
};

} // namespace openvdb_spheretree
