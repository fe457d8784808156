// SPDX-License-Identifier: Apache-2.0
/// @file CostWindow.h
/// @brief A small box of samples, with a bit for each sample that costs. These are outside the
/// object and in no other ball of the cover. The cost of a ball is the number of bits in it.
///
/// A window is made for one decision, and only reads the object and the cover. So many decisions
/// can be made in parallel. (Counts for all voxels outside, kept up to date, would take memory with
/// the volume of the largest ball.)
///
/// Coordinates are relative to the window's origin, in 1/16 of a sample. At sample level 0 they are
/// exact for balls that fit in the window. Above it, centers and radii are rounded, and a bit
/// stands for 8^level voxels; in a flat object, of which only samples of its z cost, for 4^level.
/// Cost: to fill, a byte for 8 samples; to count, a square root for each row and a word for 64
/// samples.

#pragma once

#include "FineSphere.h"
#include "SampledObject.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

namespace openvdb_spheretree::tight {

/// A ball in a window's coordinates: integers, stored as floats for the vector units.
struct LocalBall {
    float x = 0, y = 0, z = 0, radiusSq = -1;
};

/// Consecutive samples along z that cost.
struct CostRun {
    float x, y;          ///< in the window's coordinates
    int32_t first, last; ///< samples of the window
    float distanceSq;    ///< of the nearest one, to the place around which they were collected

    /// Made in place: an aggregate that is copied waits for its parts to be stored.
    CostRun(float rowX, float rowY, int32_t from, int32_t to, float nearestSq)
        : x(rowX), y(rowY), first(from), last(to), distanceSq(nearestSq)
    {}
};

class CostWindow {
public:
    /// @return the finest level of samples that has no more than @a samples in @a radius.
    static int levelFor(double radius, int samples);

    /// Starts anew: every sample of the box that is outside the object costs; of a flat one, where
    /// it has its z.
    void reset(const SampledObject& object, const FineBox& box, int level);
    /// Clears the bits in @a ball: another ball of the cover.
    void cover(const ExactSphere& ball) { cover(toLocal(ball)); }
    void cover(const LocalBall& ball);

    /// @return how many samples of a ball cost. The ball must lie in the window.
    int64_t count(const LocalBall& ball) const;
    /// Appends the runs of such samples. The ball may reach out of the window.
    void collect(const LocalBall& ball, std::vector<CostRun>& found) const;

    LocalBall toLocal(const ExactSphere& ball) const;
    /// @return an empty ball with the center of a local one.
    ExactSphere centerOf(const LocalBall& ball) const;
    int level() const { return mLevel; } ///< a sample stands for 2^level voxels along each axis
    int64_t voxelsPerSample() const { return int64_t(1) << std::min(mDim * mLevel, 60); }

private:
    /// Every sample of the box costs; with a plane only those in it.
    void fill(const std::optional<int32_t>& plane, int64_t originZ);
    /// The object's samples cost nothing.
    void clear(const SampleLevel& samples, const int64_t (&origin)[3]);

    int mLevel = 0;
    int mDim = 3;        ///< of the object
    double mToLocal = 1; ///< 2^-level
    int64_t mFineOrigin[3] = {0, 0, 0};
    int32_t mSize[3] = {0, 0, 0}; ///< samples
    int32_t mWords = 0;           ///< of a row along z
    std::vector<uint64_t> mBits;  ///< row after row, y fastest
};

} // namespace openvdb_spheretree::tight
