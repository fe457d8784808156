// SPDX-License-Identifier: Apache-2.0
#include "LineReference.h"

#include <algorithm>

namespace spheretree_test {

LineReference::LineReference(const Voxels& voxels, int dim) : mDim(dim), mBox(boxOf(voxels))
{
    mBox.expand(1);
    // Any value that no distance in the box exceeds stands for "not known yet".
    const int64_t unknown = squaredDistance(mBox.min(), mBox.max()) + 1;
    mDistSq.assign(mBox.volume(), 0);
    for (const Coord& voxel : voxels) mDistSq[index(voxel)] = unknown;
    for (int axis = 0; axis < dim; ++axis) distancesAlong(axis);
}

LineReference::LineReference(
    const CoordBBox& box, const std::function<int64_t(const Coord&)>& distSq, int dim)
    : mDim(dim), mBox(box), mDistSq(box.volume())
{
    for (const Coord& voxel : voxelsOfBox(box)) mDistSq[index(voxel)] = distSq(voxel);
}

std::vector<LineReference::Site> LineReference::labelsOfPlane(int z) const
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

const LineReference::Site& LineReference::labelIn(
    const std::vector<Site>& plane, const Coord& ijk) const
{
    const Coord at = ijk - mBox.min();
    return plane[std::size_t(at[0]) * size(1) + at[1]];
}

void LineReference::distancesAlong(int axis)
{
    CoordBBox starts = mBox;
    starts.max()[axis] = starts.min()[axis];
    const std::size_t stride = axis == 0 ? std::size_t(size(1)) * size(2) : axis == 1 ? size(2) : 1;
    const int n = size(axis);
    std::vector<int64_t> line(n);
    for (const Coord& start : voxelsOfBox(starts)) {
        int64_t* values = mDistSq.data() + index(start);
        for (int i = 0; i < n; ++i) line[i] = values[i * stride];
        for (int i = 0; i < n; ++i) {
            if (line[i] == 0) continue; // of the background
            int64_t nearest = line[i];
            for (int64_t j = 0; j < n; ++j) {
                nearest = std::min(nearest, line[j] + (i - j) * (i - j));
            }
            values[i * stride] = nearest;
        }
    }
}

LineReference::Site LineReference::bestOfColumn(const Coord& q) const
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

void LineReference::bestAlong(
    std::vector<Site>& sites, std::size_t begin, std::size_t stride, int n)
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

} // namespace spheretree_test
