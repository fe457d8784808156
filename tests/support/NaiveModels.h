// SPDX-License-Identifier: Apache-2.0
/// @file NaiveModels.h
/// @brief Pyramid models voxel by voxel, on sets of coordinates.

#pragma once

#include "NaiveReference.h"

#include <algorithm>
#include <set>

namespace spheretree_test {

/// The offsets of a digital ball, or of a disc in the plane of x and y.
inline Voxels ballOffsets(int radius, int dim)
{
    Voxels offsets;
    const int high = dim == 3 ? radius : 0;
    for (const Coord& q :
        voxelsOfBox(CoordBBox(Coord(-radius, -radius, -high), Coord(radius, radius, high)))) {
        if (squaredDistance(q, Coord(0, 0, 0)) <= radius * radius) offsets.push_back(q);
    }
    return offsets;
}

/// Dilation, then erosion: a voxel stays whose whole ball has been dilated to.
inline Voxels naiveClosing(const Voxels& voxels, int radius, int dim = 3)
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
