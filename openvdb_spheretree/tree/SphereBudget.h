// SPDX-License-Identifier: Apache-2.0
/// @file SphereBudget.h
/// @brief How many spheres the levels of a tight tree shall have: by count, by branching, or by the
/// error that is allowed.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace openvdb_spheretree {

/// Of which spheres the error is that a budget bounds.
enum class BoundOf {
    Stored,  ///< as files have them, with padding: StoredError
    Unpadded ///< without padding: LevelError, as in version 0.1
};

/// Nothing set: levels of 1, 8, 64, ... spheres, and all leaves.
struct SphereBudget {
    /// One level for each count, with at most so many spheres; in any order.
    std::vector<int64_t> spheres;
    /// Levels of 1, B, B^2, ... spheres, and all leaves; 0 stands for kDefaultBranching.
    int branching = 0;
    /// The level of fewest spheres whose Hamming error is at most this, in percent.
    std::optional<double> error;
    /// The level of fewest spheres that reach at most so far out of the object's voxel cubes, in
    /// world units, or in voxels. (Of unpadded spheres: whose one-sided Hausdorff distance is at
    /// most this.)
    std::optional<double> distance;
    bool distanceInVoxels = false;
    BoundOf bounds = BoundOf::Stored;

    static constexpr int kDefaultBranching = 8;
    static constexpr int kMaxBranching = 1 << 20;
    static constexpr int64_t kMaxSpheres = INT32_MAX;

    /// @return the bound on the distance, which must be set, in world units.
    double distanceWorld(double voxelSize) const
    {
        return distanceInVoxels ? *distance * voxelSize : *distance;
    }
    bool hasBound() const { return error || distance; }
    bool empty() const { return spheres.empty() && branching == 0 && !hasBound(); }

    /// @return the counts asked for of a tree with @a leaves leaves, finest first and falling,
    /// none above @a leaves; bounds on the error are not looked at.
    std::vector<int64_t> counts(int64_t leaves) const;

    /// @throw openvdb::ValueError naming the first setting that is out of range or contradicts
    ///        another one, and what is possible
    void validate() const;
};

/// @return "5", or "2vox" where it is in voxels; nothing where it is not set.
std::string distanceBoundToString(const SphereBudget& budget);
/// Sets the bound on the distance, or none if @a text is empty.
/// @throw openvdb::ValueError if it is no number, with or without "vox" behind it. A unit such as mm
///        is refused, with what to write: a grid does not say what its unit is.
void setDistanceBound(SphereBudget& budget, const std::string& text);

/// @return "8,64,512"
std::string countsToString(const std::vector<int64_t>& counts);
/// @throw openvdb::ValueError if @a text is no list of counts of 1 or more
std::vector<int64_t> countsFromString(const std::string& text);

} // namespace openvdb_spheretree
