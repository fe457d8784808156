// SPDX-License-Identifier: Apache-2.0
/// @file GainWindow.h
/// @brief A small box of samples of the object, for one decision on one sphere: what the sphere would gain
/// there, given all others.
///
/// A sample in no other sphere counts +1 if it is the object's, which is then no longer missing, and -1 if
/// it is outside, which is then excess. One that another sphere holds counts 0, whatever happens. So a
/// sphere that gains more has exactly that much less excess + missing.
///
/// 1. reset(): the object's samples; nothing is covered
/// 2. cover(): the samples in another sphere no longer count
/// 3. sum(): running sums along the rows (z)
/// 4. gain(): of a sphere, two look-ups a row
///
/// Coordinates are relative to the window, in 1/16 of a sample. At sample level 0 samples are voxels, and all
/// is exact; above it, centers and radii are rounded, and a sample stands for 8^level voxels.
/// Cost: linear in the samples of the box; gain(), a square root for each row. Tests: TestGainWindow.cc.

#pragma once

#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree::nearest {

/// A sphere in a window's coordinates.
struct LocalSphere {
    int64_t center[3] = {0, 0, 0};
    int64_t radiusSq = -1;
};

class GainWindow {
public:
    /// Starts anew: the samples of @a box, and what the object has of them.
    /// @param level  of samples
    /// @param flat   only those with z = 0: the object is flat there
    void reset(const tight::SampledObject& object, const tight::FineBox& box, int level, bool flat);
    /// Another sphere holds its samples, in the window or not.
    void cover(const ExactSphere& sphere);
    /// All others have been covered.
    void sum();

    /// @return object samples less others, of those in @a sphere and in no other one.
    int64_t gain(const LocalSphere& sphere) const;
    /// @return whether all samples of @a sphere are in the window.
    bool holds(const LocalSphere& sphere) const;

    LocalSphere toLocal(const ExactSphere& sphere) const;
    /// @return @a sphere moved as @a to is from @a from, both local.
    ExactSphere moved(
        const ExactSphere& sphere, const LocalSphere& from, const LocalSphere& to) const;

private:
    template <typename Visit>
    void visitRows(const LocalSphere& sphere, const Visit& visit) const;

    int mLevel = 0;
    int64_t mFineOrigin[3] = {0, 0, 0}; ///< 1/16 voxel
    int32_t mSize[3] = {0, 0, 0};       ///< samples
    int32_t mWords = 0;                 ///< of a row
    std::vector<uint64_t> mObject;      ///< bits, row after row, y fastest
    std::vector<uint64_t> mFree;        ///< the same: in no other sphere
    std::vector<int32_t> mSums;         ///< of the samples of a row before each, and of all
};

} // namespace openvdb_spheretree::nearest
