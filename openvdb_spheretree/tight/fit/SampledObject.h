// SPDX-License-Identifier: Apache-2.0
/// @file SampledObject.h
/// @brief The object at falling resolutions: level k holds every 2^k-th voxel along each axis (of a
/// flat object along two).
///
/// Balls are compared by how much they hold outside the object. The time to count voxels grows with
/// the volume of a ball. Samples are chosen so that a radius has at most 16 to 40 of them
/// (FitEffort): that bounds the time for a ball. They only decide which ball is chosen. What a ball
/// has to cover is always every voxel.
///
/// These are samples and not an OR-pyramid, in which a thin sheet would be as thick as a coarse
/// voxel. (The finest level may be of a coarser object: HalvedObject.h.) Memory: up to 80 bytes for
/// each leaf of each level: a mask, an origin, and where a column begins. Solids have 1.15 times
/// the object's leaves on all levels, flat objects 1.33 times.

#pragma once

#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <openvdb/util/NullInterrupter.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace openvdb_spheretree::tight {

/// Leaves of 8^3 samples, ordered by origin, x first.
class SampleLevel {
public:
    /// @param origins  ascending
    SampleLevel(std::vector<openvdb::Coord> origins, std::vector<LeafMask> masks);

    std::size_t leafCount() const { return mOrigins.size(); }
    const openvdb::Coord& origin(std::size_t leaf) const { return mOrigins[leaf]; }
    const LeafMask& mask(std::size_t leaf) const { return mMasks[leaf]; }

    /// Calls body(leaf) for every leaf that meets the box, in order.
    template <typename Body>
    void forEachLeaf(const openvdb::CoordBBox& box, const Body& body) const
    {
        const openvdb::Coord lo = box.min() & ~7;
        for (std::size_t c = firstColumn(lo[0], lo[1]); c + 1 < mColumnBegin.size();) {
            const openvdb::Coord& at = mOrigins[mColumnBegin[c]];
            if (at[0] > box.max()[0]) return;
            if (at[1] < lo[1]) {
                c = firstColumn(at[0], lo[1]);
            } else if (at[1] > box.max()[1]) {
                c = firstColumn(int64_t(at[0]) + 8, lo[1]); // beyond 32 bits at the end
            } else {
                for (std::size_t leaf = firstLeaf(c, lo[2]);
                     leaf < mColumnBegin[c + 1] && mOrigins[leaf][2] <= box.max()[2]; ++leaf) {
                    body(leaf);
                }
                ++c;
            }
        }
    }

private:
    /// @return the first column at or after (x, y).
    std::size_t firstColumn(int64_t x, int32_t y) const;
    /// @return the first leaf of a column at or above z.
    std::size_t firstLeaf(std::size_t column, int32_t z) const;

    std::vector<openvdb::Coord> mOrigins;
    std::vector<LeafMask> mMasks;
    std::vector<uint32_t> mColumnBegin; ///< of leaves with the same x and y, and the end
};

class SampledObject {
public:
    /// Of an object without voxels.
    SampledObject() : mLevels(1, SampleLevel({}, {})) {}
    /// @param isFlat  its voxels have one z, and balls are discs: samples of other z cost nothing
    /// @param interrupter  may be null
    explicit SampledObject(const LeafLayout& object, bool isFlat = false,
        openvdb::util::NullInterrupter* interrupter = nullptr);
    explicit SampledObject(SampleLevel finest, bool isFlat = false,
        openvdb::util::NullInterrupter* interrupter = nullptr);

    /// @param k  0 or more; levels beyond the last one have no samples
    const SampleLevel& level(int k) const
    {
        return mLevels[std::min(std::size_t(k), mLevels.size() - 1)];
    }
    int levels() const { return int(mLevels.size()); }
    int dim() const { return mPlane ? 2 : 3; }
    /// @return the z of a level's samples, if the object is flat: halved for each level and rounded
    /// down, or an odd z would leave no samples.
    std::optional<int32_t> plane(int k) const
    {
        return mPlane ? std::optional<int32_t>(*mPlane >> k) : std::nullopt;
    }

private:
    std::optional<int32_t> mPlane;    ///< z of a flat object
    std::vector<SampleLevel> mLevels; ///< the last one is empty
};

} // namespace openvdb_spheretree::tight
