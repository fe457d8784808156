// SPDX-License-Identifier: Apache-2.0
/// @file NaiveSpheres.h
/// @brief Spheres in 1/16 voxel, voxel by voxel: what tests of nearest spheres are held against.

#pragma once

#include "support/BuiltTrees.h"

#include <openvdb_spheretree/sphere/ExactSphere.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace spheretree_test {

inline bool isIn(const Voxels& voxels, const Coord& v)
{
    return std::find(voxels.begin(), voxels.end(), v) != voxels.end();
}

inline Voxels inPlaneZero(const Voxels& voxels)
{
    std::set<Coord> flat;
    for (const Coord& v : voxels) flat.insert(Coord(v[0], v[1], 0));
    return Voxels(flat.begin(), flat.end());
}

inline bool holdsVoxel(const openvdb_spheretree::ExactSphere& sphere, const Coord& v)
{
    int64_t distSq = 0;
    for (int a = 0; a < 3; ++a) {
        distSq += (16 * v[a] - sphere.center[a]) * (16 * v[a] - sphere.center[a]);
    }
    return distSq <= sphere.radiusSq;
}

/// @param flat  only those with z = 0
inline std::set<Coord> naiveVoxels(
    const std::vector<openvdb_spheretree::ExactSphere>& spheres, bool flat)
{
    std::set<Coord> voxels;
    for (const auto& sphere : spheres) {
        if (sphere.empty()) continue;
        const int reach = int(sphere.radius()) / 16 + 2;
        const Coord at(
            int(sphere.center[0] >> 4), int(sphere.center[1] >> 4), int(sphere.center[2] >> 4));
        for (int x = -reach; x <= reach; ++x) {
            for (int y = -reach; y <= reach; ++y) {
                for (int z = -reach; z <= reach; ++z) {
                    const Coord v = at.offsetBy(x, y, z);
                    if (holdsVoxel(sphere, v) && (!flat || v[2] == 0)) voxels.insert(v);
                }
            }
        }
    }
    return voxels;
}

/// @return excess + missing
inline int64_t naiveWrong(
    const Voxels& object, const std::vector<openvdb_spheretree::ExactSphere>& spheres, bool flat)
{
    const std::set<Coord> held = naiveVoxels(spheres, flat);
    int64_t both = 0;
    for (const Coord& v : object) both += int64_t(held.count(v));
    return int64_t(held.size()) + int64_t(object.size()) - 2 * both;
}

/// @return a sphere around a place near a random voxel of the object.
inline openvdb_spheretree::ExactSphere randomSphere(const Voxels& object, Random& random, bool flat)
{
    const Coord at = object[std::size_t(random.between(0, int(object.size()) - 1))];
    openvdb_spheretree::ExactSphere sphere;
    for (int a = 0; a < 3; ++a) sphere.center[a] = 16 * at[a] + random.between(-20, 20);
    if (flat) sphere.center[2] = 0;
    const int64_t radius = random.between(4, 70);
    sphere.radiusSq = radius * radius + random.between(0, 9);
    return sphere;
}

} // namespace spheretree_test
