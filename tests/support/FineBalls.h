// SPDX-License-Identifier: Apache-2.0
/// @file FineBalls.h
/// @brief For tests of the parts of tight trees: balls in 1/16 voxel by their definition, and what
/// they are asked about.

#pragma once

#include "CoreStages.h"
#include "RandomObjects.h"

#include <openvdb_spheretree/tight/fit/FineSphere.h>
#include <openvdb_spheretree/tight/fit/SampledObject.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <hwy/highway.h>

#include <algorithm>
#include <vector>

namespace spheretree_test {

using openvdb_spheretree::ExactSphere;
using openvdb_spheretree::LeafMask;
using openvdb_spheretree::tight::SampledObject;

inline bool holds(const ExactSphere& ball, const Coord& voxel)
{
    __int128 sum = 0;
    for (int a = 0; a < 3; ++a) {
        const __int128 d = 16 * int64_t(voxel[a]) - ball.center[a];
        sum += d * d;
    }
    return sum <= ball.radiusSq;
}

/// sqrt(D) >= sqrt(a) + sqrt(b), in integers.
inline bool atLeastSum(__int128 D, __int128 a, __int128 b)
{
    return D >= a + b && (D - a - b) * (D - a - b) >= 4 * a * b;
}

inline __int128 centersApartSq(const ExactSphere& a, const ExactSphere& b)
{
    __int128 sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const __int128 d = a.center[axis] - b.center[axis];
        sum += d * d;
    }
    return sum;
}

/// All of @a held, not its voxels alone.
inline bool contains(const ExactSphere& ball, const ExactSphere& held)
{
    return atLeastSum(ball.radiusSq, centersApartSq(ball, held), held.radiusSq);
}

/// The smallest squared radius around the centre of @a ball that holds these voxels; -1 for none.
inline int64_t neededRadiusSq(const ExactSphere& ball, const Voxels& voxels)
{
    __int128 most = -1;
    for (const Coord& v : voxels) {
        most = std::max(most, centersApartSq(ball, openvdb_spheretree::tight::voxelBall(v)));
    }
    return int64_t(most);
}

/// @param low, high  of the centre, voxels
/// @param radius     at most, voxels
inline ExactSphere randomBall(Random& random, int low, int high, int radius)
{
    ExactSphere ball;
    for (int64_t& c : ball.center) c = random.between(16 * low, 16 * high);
    const int64_t r = random.between(0, 16 * radius);
    ball.radiusSq = r * r + random.between(0, int(r));
    return ball;
}

inline std::vector<ExactSphere> randomBalls(
    int count, Random& random, int low, int high, int radius)
{
    std::vector<ExactSphere> balls;
    for (int i = 0; i < count; ++i) balls.push_back(randomBall(random, low, high, radius));
    return balls;
}

inline SampledObject sampled(const Voxels& voxels)
{
    return SampledObject(openvdb_spheretree::LeafLayout(*maskOf(voxels)));
}

inline bool contains(const Voxels& voxels, const Coord& voxel)
{
    return std::binary_search(voxels.begin(), voxels.end(), voxel);
}

/// How many voxels balls hold together that are not the object's.
inline int64_t excess(const std::vector<ExactSphere>& balls, const Voxels& object)
{
    CoordBBox box;
    for (const ExactSphere& ball : balls) {
        const int reach = int(ball.radius() / 16) + 1;
        for (const int r : {-reach, reach}) {
            box.expand(Coord(int(ball.center[0] >> 4) + r, int(ball.center[1] >> 4) + r,
                int(ball.center[2] >> 4) + r));
        }
    }
    int64_t sum = 0;
    for (const Coord& v : voxelsOfBox(box)) {
        const bool held = std::any_of(
            balls.begin(), balls.end(), [&](const ExactSphere& ball) { return holds(ball, v); });
        sum += held && !contains(object, v);
    }
    return sum;
}

inline Voxels voxelsOf(const LeafMask& mask, const Coord& origin)
{
    Voxels voxels;
    for (int i = 0; i < 512; ++i) {
        if (mask[i >> 6] >> (i & 63) & 1)
            voxels.push_back(origin.offsetBy(i >> 6, i >> 3 & 7, i & 7));
    }
    return voxels;
}

/// Whether balls around any place that hold these points hold all the voxels: asked at some places.
/// The points must be some of the voxels.
inline testing::AssertionResult standFor(const Voxels& points, const Voxels& voxels, Random& random)
{
    for (const Coord& p : points) {
        if (!contains(voxels, p)) return testing::AssertionFailure() << p << " is none of them";
    }
    if (points.empty() != voxels.empty()) return testing::AssertionFailure() << "none, or too many";
    for (int i = 0; i < 60 && !voxels.empty(); ++i) {
        const int reach = i % 2 ? 30 : 3000;
        const Coord from = voxels.front() + random.coord(-reach, reach);
        const auto farthest = [&](const Voxels& some) {
            int64_t most = 0;
            for (const Coord& v : some) most = std::max(most, squaredDistance(v, from));
            return most;
        };
        if (farthest(points) == farthest(voxels)) continue;
        return testing::AssertionFailure() << "from " << from << " a voxel is further away";
    }
    return testing::AssertionSuccess();
}

/// Calls body() with every target of Highway that this machine has.
template <typename Body>
void forEachTarget(const Body& body)
{
    for (int64_t left = hwy::SupportedTargets(); left != 0; left &= left - 1) {
        const int64_t target = left & -left;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(target);
        SCOPED_TRACE(hwy::TargetName(target));
        body();
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
}

} // namespace spheretree_test
