// SPDX-License-Identifier: Apache-2.0
/// @file Spheres.h
/// @brief Spheres with links to parents, as flat arrays: those of a tree, and those of its cuts.

#pragma once

#include <openvdb/Types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

/// One entry a sphere; its index is its id. All arrays are of one length.
struct Spheres {
    /// Index space of the source grid; multiples of 1 / subdivision of the tree.
    std::vector<openvdb::Vec3d> center;
    std::vector<double> radius; ///< voxels of level 0, covers voxel centers, no padding
    /// The exact form of `radius`: voxel center q is inside when
    /// |subdivision (q - center)|^2 <= coverRadiusSq. The length is that of settings.dist(), in its
    /// units.
    std::vector<int64_t> coverRadiusSq;
    /// World units, padded, rounded up. Of a norm: how far the ball reaches along an axis of index
    /// space; a sphere of this radius holds more than it (l1), or less (linf).
    std::vector<float> radiusWorld;
    std::vector<int32_t> parent; ///< id; -1 where there is none

    int32_t size() const { return int32_t(center.size()); }
    bool empty() const { return center.empty(); }

    void reserve(std::size_t count);
    /// New spheres are of radius 0 at the origin, with parent 0.
    void resize(std::size_t count);

    /// @return spheres begin to end - 1; their parents are still ids of these arrays.
    Spheres slice(int32_t begin, int32_t end) const;
    /// @return the spheres of these ids, in this order; their parents are still ids of these
    ///         arrays.
    Spheres take(const std::vector<int32_t>& ids) const;

    bool operator==(const Spheres& o) const;
    bool operator!=(const Spheres& o) const { return !(*this == o); }
};

} // namespace openvdb_spheretree
