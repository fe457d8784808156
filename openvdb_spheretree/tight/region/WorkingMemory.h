// SPDX-License-Identifier: Apache-2.0
/// @file WorkingMemory.h
/// @brief What making levels takes of memory, about, and its refusal where there may not be as
/// much.

#pragma once

#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree::tight {

/// Parts add up. Each is an estimate from above for solids, sheets and noise.
struct WorkingMemory {
    double bytes = 0;

    /// Samples of an object of so many leaf nodes (SampledObject.h).
    WorkingMemory& addSamples(std::size_t leafNodes, int dim);
    /// Merging so many balls: what they hold, their neighbours, the merged balls.
    WorkingMemory& addMerging(std::size_t balls);
    /// The voxels of each ball of a level (VoxelRegion.h), and below those of the next coarser one.
    /// Parallel; a look at each leaf node that a ball meets.
    /// @param interrupter  may be null
    WorkingMemory& addRegions(const std::vector<ExactSphere>& balls, const SampleLevel& object,
        openvdb::util::NullInterrupter* interrupter);
    /// About the same for an object that is not there, of so many leaf nodes.
    WorkingMemory& guessRegions(const std::vector<ExactSphere>& balls, std::size_t leafNodes);

    /// About the same for a cover of so many balls that nobody knows yet, from above: in solids,
    /// sheets and hairs a ball meets leaf nodes up to 2.3 beyond its share of them.
    /// @param dim  2 where the object is flat
    WorkingMemory& guessCover(double balls, std::size_t leafNodes, int dim);

    /// @param memory  SphereTreeSettings::memory: what is allowed; 0: all that the machine has
    /// @return whether it is no more
    bool fits(int64_t memory) const;
    /// @param memory  as of fits()
    /// @throw openvdb::ValueError if it is more
    void require(int64_t memory, const std::string& what) const;

private:
    struct RegionSize {
        double leaves = 0, whole = 0; ///< leaf nodes, and those that it has all voxels of
    };
    void addRegion(const RegionSize& size);
};

/// @return what regions of so many leaves take together.
/// @param whole  those of which a region has all voxels of the object
double regionBytes(double leaves, double whole);

} // namespace openvdb_spheretree::tight
