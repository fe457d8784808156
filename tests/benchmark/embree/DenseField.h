// SPDX-License-Identifier: Apache-2.0
/// @file DenseField.h
/// @brief The usual alternative for points: the signed distance at every voxel of a box, and
/// between them by interpolation. Much larger, and never exact, but a look-up takes no search.

#pragma once

#include <openvdb_spheretree/query/QueryTree.h>

#include <openvdb/math/Vec3.h>

#include <array>
#include <cstddef>
#include <vector>

namespace spheretree_benchmark {

class DenseField {
public:
    static constexpr std::size_t kMostValues = 40000000;

    /// @param low, high  corners of the box; without a field if it takes more than kMostValues
    DenseField(const openvdb_spheretree::QueryTree& tree, const openvdb::Vec3d& low,
        const openvdb::Vec3d& high, double voxel);

    bool isThere() const { return !mValues.empty(); }
    std::size_t bytes() const { return mValues.size() * sizeof(float); }

    /// @return the distance at a point; outside of the box that at its border.
    float at(const openvdb::Vec3s& point) const
    {
        std::array<std::size_t, 3> cell;
        std::array<float, 3> part;
        for (int axis = 0; axis < 3; ++axis) {
            const float most = float(mSize[axis]) - 1.001f;
            const float place = (point[axis] - mLow[axis]) * mPerWorld;
            const float inside = place < 0 ? 0 : place > most ? most : place;
            cell[axis] = std::size_t(inside);
            part[axis] = inside - float(cell[axis]);
        }
        const std::size_t row = mSize[2], slice = mSize[1] * row;
        const float* const v = &mValues[cell[0] * slice + cell[1] * row + cell[2]];
        const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
        const auto edge = [&](std::size_t i) { return mix(v[i], v[i + 1], part[2]); };
        return mix(mix(edge(0), edge(row), part[1]), mix(edge(slice), edge(slice + row), part[1]),
            part[0]);
    }

private:
    std::array<std::size_t, 3> mSize;
    openvdb::Vec3s mLow;
    float mPerWorld;
    std::vector<float> mValues;
};

} // namespace spheretree_benchmark
