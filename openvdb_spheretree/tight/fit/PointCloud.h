// SPDX-License-Identifier: Apache-2.0
/// @file PointCloud.h
/// @brief The points that a ball has to hold, or balls around them, in arrays for vector units.

#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace openvdb_spheretree::tight {

/// Points in a window's coordinates. Arrays are padded with copies of the first point.
class PointCloud {
public:
    void clear() { mCount = 0; }
    std::size_t size() const { return mCount; }
    /// @param radius  of a ball around the point that has to be held with it
    void add(float x, float y, float z, float radius = 0);
    /// To be called when all points are there, before the first query.
    void finish();

    struct Farthest {
        std::size_t point;
        float distanceSq; ///< squared radius that a ball needs; exact for integers below 2^12
    };
    /// @return the first of the points that are farthest.
    Farthest farthest(float x, float y, float z) const;
    /// The same without the point, in half the time.
    float farthestSq(float x, float y, float z) const;

    float coordinate(int axis, std::size_t point) const { return mAxis[axis][point]; }

private:
    std::array<const float*, 4> axes() const;

    std::vector<float> mAxis[4]; ///< x, y, z, radius
    std::size_t mCount = 0;
    bool mHasRadii = false;
};

} // namespace openvdb_spheretree::tight
