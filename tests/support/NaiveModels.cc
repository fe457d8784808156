// SPDX-License-Identifier: Apache-2.0
#include "NaiveModels.h"

#include <algorithm>
#include <set>

namespace spheretree_test {

namespace {

/// The offsets of a digital ball, or of a disc in the plane of x and y.
Voxels ballOffsets(int radius, int dim)
{
    Voxels offsets;
    const int high = dim == 3 ? radius : 0;
    for (const Coord& q :
        voxelsOfBox(CoordBBox(Coord(-radius, -radius, -high), Coord(radius, radius, high)))) {
        if (squaredDistance(q, Coord(0, 0, 0)) <= radius * radius) offsets.push_back(q);
    }
    return offsets;
}

} // namespace

Voxels naiveClosing(const Voxels& voxels, int radius, int dim)
{
    const Voxels ball = ballOffsets(radius, dim);
    std::set<Coord> dilated;
    for (const Coord& voxel : voxels) {
        for (const Coord& q : ball) dilated.insert(voxel + q);
    }
    Voxels closed;
    for (const Coord& voxel : dilated) {
        const auto within = [&](const Coord& q) { return dilated.count(voxel + q) > 0; };
        if (std::all_of(ball.begin(), ball.end(), within)) closed.push_back(voxel);
    }
    return closed;
}

} // namespace spheretree_test
