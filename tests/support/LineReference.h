// SPDX-License-Identifier: Apache-2.0
/// @file LineReference.h
/// @brief Distances and power labels of larger objects, on a dense box, line by line: O(n^2) a
/// line, in 64 bits, without cutting lines at background, without pruning and without any kernel.
///
/// Slower than the library by orders of magnitude, faster than NaiveReference.h by as many; a test
/// holds the two references against each other.

#pragma once

#include "NaiveReference.h"

#include <functional>
#include <utility>

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
    explicit LineReference(const Voxels& voxels, int dim = 3) : mDim(dim), mBox(boxOf(voxels))
    {
        mBox.expand(1);
        // Any value that no distance in the box exceeds stands for "not known yet".
        const int64_t unknown = squaredDistance(mBox.min(), mBox.max()) + 1;
        mDistSq.assign(mBox.volume(), 0);
        for (const Coord& voxel : voxels) mDistSq[index(voxel)] = unknown;
        for (int axis = 0; axis < dim; ++axis) distancesAlong(axis);
    }

    /// From distances known otherwise, 0 for background.
    LineReference(const CoordBBox& box, const std::function<int64_t(const Coord&)>& distSq, int dim)
        : mDim(dim), mBox(box), mDistSq(box.volume())
    {
        for (const Coord& voxel : voxelsOfBox(box)) mDistSq[index(voxel)] = distSq(voxel);
    }

    const CoordBBox& box() const { return mBox; }
    int64_t distSq(const Coord& ijk) const { return mDistSq[index(ijk)]; }

    /// @return the label of every voxel of the plane z, at size(1) * x + y counted from the box.
    std::vector<Site> labelsOfPlane(int z) const
    {
        std::vector<Site> sites(std::size_t(size(0)) * size(1));
        for (int x = 0; x < size(0); ++x) {
            for (int y = 0; y < size(1); ++y) {
                sites[std::size_t(x) * size(1) + y] =
                    bestOfColumn(mBox.min() + Coord(x, y, z - mBox.min()[2]));
            }
        }
        for (int x = 0; x < size(0); ++x) bestAlong(sites, std::size_t(x) * size(1), 1, size(1));
        for (int y = 0; y < size(1); ++y) bestAlong(sites, y, size(1), size(0));
        return sites;
    }

    /// @return the label of voxel @a ijk among those of its plane.
    const Site& labelIn(const std::vector<Site>& plane, const Coord& ijk) const
    {
        const Coord at = ijk - mBox.min();
        return plane[std::size_t(at[0]) * size(1) + at[1]];
    }

private:
    int size(int axis) const { return mBox.max()[axis] - mBox.min()[axis] + 1; }

    std::size_t index(const Coord& ijk) const
    {
        const Coord at = ijk - mBox.min();
        return (std::size_t(at[0]) * size(1) + at[1]) * size(2) + at[2];
    }

    void distancesAlong(int axis)
    {
        CoordBBox starts = mBox;
        starts.max()[axis] = starts.min()[axis];
        const std::size_t stride = axis == 0 ? std::size_t(size(1)) * size(2)
            : axis == 1                      ? size(2)
                                             : 1;
        const int n = size(axis);
        std::vector<int64_t> line(n);
        for (const Coord& start : voxelsOfBox(starts)) {
            int64_t* values = mDistSq.data() + index(start);
            for (int i = 0; i < n; ++i) line[i] = values[i * stride];
            for (int i = 0; i < n; ++i) {
                int64_t nearest = line[i];
                for (int64_t j = 0; j < n; ++j) {
                    nearest = std::min(nearest, line[j] + (i - j) * (i - j));
                }
                values[i * stride] = nearest;
            }
        }
    }

    Site bestOfColumn(const Coord& q) const
    {
        Site best;
        const int first = mDim == 2 ? q[2] : mBox.min()[2], last = mDim == 2 ? q[2] : mBox.max()[2];
        for (Coord p(q[0], q[1], first); p[2] <= last; ++p[2]) {
            const int64_t own = distSq(p);
            const Site site{own - squaredDistance(p, q), own, p};
            if (site.exists() && (!best.exists() || site.winsOver(best))) best = site;
        }
        return best;
    }

    /// Replaces every site of a line of @a n by the best of the line as seen from there.
    static void bestAlong(std::vector<Site>& sites, std::size_t begin, std::size_t stride, int n)
    {
        std::vector<Site> line(n);
        for (int i = 0; i < n; ++i) line[i] = sites[begin + i * stride];
        for (int i = 0; i < n; ++i) {
            Site best;
            for (int64_t j = 0; j < n; ++j) {
                if (!line[j].exists()) continue;
                const int64_t value = line[j].value - (i - j) * (i - j);
                if (best.exists() && value < best.value) continue;
                Site site = line[j];
                site.value = value;
                if (!best.exists() || site.winsOver(best)) best = site;
            }
            sites[begin + i * stride] = best;
        }
    }

    int mDim;
    CoordBBox mBox;
    std::vector<int64_t> mDistSq;
};

} // namespace spheretree_test
