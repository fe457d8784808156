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

/// Nothing set: levels of 1, 8, 64, ... spheres, and all leaves.
struct SphereBudget {
    /// One level for each count, with at most so many spheres; in any order.
    std::vector<int64_t> spheres;
    /// Levels of 1, B, B^2, ... spheres, and all leaves; 0 stands for kDefaultBranching.
    int branching = 0;
    /// The level of fewest spheres whose Hamming error is at most this, in percent.
    std::optional<double> error;
    /// The level of fewest spheres whose one-sided Hausdorff distance is at most this, world units.
    std::optional<double> distance;

    static constexpr int kDefaultBranching = 8;
    static constexpr int kMaxBranching = 1 << 20;
    static constexpr int64_t kMaxSpheres = INT32_MAX;

    bool hasBound() const { return error || distance; }
    bool empty() const { return spheres.empty() && branching == 0 && !hasBound(); }

    /// @return the counts asked for of a tree with @a leaves leaves, finest first and falling,
    /// none above @a leaves; bounds on the error are not looked at.
    std::vector<int64_t> counts(int64_t leaves) const;

    /// @throw openvdb::ValueError naming the first setting that is out of range or contradicts
    ///        another one, and what is possible
    void validate() const;
};

/// @return "8,64,512"
std::string countsToString(const std::vector<int64_t>& counts);
/// @throw openvdb::ValueError if @a text is no list of counts of 1 or more
std::vector<int64_t> countsFromString(const std::string& text);

} // namespace openvdb_spheretree
