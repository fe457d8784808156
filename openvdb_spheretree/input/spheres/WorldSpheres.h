// SPDX-License-Identifier: Apache-2.0
/// @file WorldSpheres.h
/// @brief Spheres of any origin, in world space: what other tools make, and what they are read as.

#pragma once

#include <openvdb/Types.h>

#include <cstddef>
#include <string>
#include <vector>

namespace openvdb_spheretree {

/// One entry a sphere, in the order of the file.
struct WorldSpheres {
    std::string name;                   ///< of the file or grid they are from
    std::vector<openvdb::Vec3d> center; ///< world units, finite
    std::vector<double> radius;         ///< world units, above 0 and finite
    /// What the reader took for granted, as a sentence for people; empty if nothing.
    std::string assumption;

    std::size_t size() const { return center.size(); }
};

} // namespace openvdb_spheretree
