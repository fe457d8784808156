// SPDX-License-Identifier: Apache-2.0
/// @file ExactSphere.h
/// @brief A closed sphere in exact integers, centred on a voxel or between voxels.

#pragma once

#include <openvdb_spheretree/voxel/Distance.h>

#include <cstdint>

namespace openvdb_spheretree {

/// What the spheres of a list have in common: the distance they are balls of, and the units of
/// their integers. Where only a distance is given, units are halves of a voxel.
struct SphereMetric {
    Distance distance;
    /// Units in a voxel: SphereTree::subdivision. A power of two, 2 to kMaxSubdivision.
    int subdivision = 2;

    static constexpr int kMaxSubdivision = 16;

    SphereMetric() = default;
    SphereMetric(const Distance& distance, int subdivision = 2)
        : distance(distance), subdivision(subdivision)
    {}
};

/// The closed sphere { q : |subdivision q - center|^2 <= coverSq } of voxels q of the grid it is
/// drawn on; subdivision and length are those of the SphereMetric beside it. So centres between
/// voxels stay integers.
struct ExactSphere {
    int64_t center[3];
    int64_t coverSq; ///< negative: empty
};

} // namespace openvdb_spheretree
