// SPDX-License-Identifier: Apache-2.0
/// @file LineReference.h
/// @brief Distances and power labels of larger objects, on a dense box, line by line: O(n^2) a
/// line, in 64 bits, without cutting lines at background, without pruning and without any kernel.
///
/// Slower than the library by orders of magnitude, faster than NaiveReference.h by as many; a test
/// holds the two references against each other.

#pragma once

#include "NaiveReference.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace spheretree_test {

class LineReference {
public:
    /// A site, and how well it covers the voxel it was asked for.
    struct Site {
        int64_t value = std::numeric_limits<int64_t>::min();
        int64_t distSq = 0;
        Coord at;

        bool exists() const { return distSq > 0; }
        bool winsOver(const Site& o) const
        {
            if (value != o.value) return value > o.value;
            if (distSq != o.distSq) return distSq > o.distSq;
            return at < o.at;
        }
    };

    /// From the object: computes the distances.
    explicit LineReference(const Voxels& voxels, int dim = 3);

    /// From distances known otherwise, 0 for background.
    LineReference(
        const CoordBBox& box, const std::function<int64_t(const Coord&)>& distSq, int dim);

    const CoordBBox& box() const { return mBox; }
    int64_t distSq(const Coord& ijk) const { return mDistSq[index(ijk)]; }

    /// @return the label of every voxel of the plane z, at size(1) * x + y counted from the box.
    std::vector<Site> labelsOfPlane(int z) const;

    /// @return the label of voxel @a ijk among those of its plane.
    const Site& labelIn(const std::vector<Site>& plane, const Coord& ijk) const;

private:
    int size(int axis) const { return mBox.max()[axis] - mBox.min()[axis] + 1; }

    std::size_t index(const Coord& ijk) const
    {
        const Coord at = ijk - mBox.min();
        return (std::size_t(at[0]) * size(1) + at[1]) * size(2) + at[2];
    }

    void distancesAlong(int axis);

    Site bestOfColumn(const Coord& q) const;

    /// Replaces every site of a line of @a n by the best of the line as seen from there.
    static void bestAlong(std::vector<Site>& sites, std::size_t begin, std::size_t stride, int n);

    int mDim;
    CoordBBox mBox;
    std::vector<int64_t> mDistSq;
};

} // namespace spheretree_test
