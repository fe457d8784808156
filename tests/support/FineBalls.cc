// SPDX-License-Identifier: Apache-2.0
#include "FineBalls.h"

#include <hwy/highway.h>

#include <algorithm>

namespace spheretree_test {

bool holds(const ExactSphere& ball, const Coord& voxel)
{
    __int128 sum = 0;
    for (int a = 0; a < 3; ++a) {
        const __int128 d = 16 * int64_t(voxel[a]) - ball.center[a];
        sum += d * d;
    }
    return sum <= ball.radiusSq;
}

bool atLeastSum(__int128 D, __int128 a, __int128 b)
{
    return D >= a + b && (D - a - b) * (D - a - b) >= 4 * a * b;
}

__int128 centersApartSq(const ExactSphere& a, const ExactSphere& b)
{
    __int128 sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const __int128 d = a.center[axis] - b.center[axis];
        sum += d * d;
    }
    return sum;
}

bool contains(const ExactSphere& ball, const ExactSphere& held)
{
    return atLeastSum(ball.radiusSq, centersApartSq(ball, held), held.radiusSq);
}

int64_t neededRadiusSq(const ExactSphere& ball, const Voxels& voxels)
{
    __int128 most = -1;
    for (const Coord& v : voxels) {
        most = std::max(most, centersApartSq(ball, openvdb_spheretree::tight::voxelBall(v)));
    }
    return int64_t(most);
}

ExactSphere randomBall(Random& random, int low, int high, int radius)
{
    ExactSphere ball;
    for (int64_t& c : ball.center) c = random.between(16 * low, 16 * high);
    const int64_t r = random.between(0, 16 * radius);
    ball.radiusSq = r * r + random.between(0, int(r));
    return ball;
}

std::vector<ExactSphere> randomBalls(int count, Random& random, int low, int high, int radius)
{
    std::vector<ExactSphere> balls;
    for (int i = 0; i < count; ++i) balls.push_back(randomBall(random, low, high, radius));
    return balls;
}

std::vector<ExactSphere> fineBalls(const std::vector<openvdb_spheretree::MedialBall>& balls)
{
    std::vector<ExactSphere> fine;
    for (const auto& ball : balls) fine.push_back(openvdb_spheretree::tight::fineBall(ball));
    return fine;
}

SampledObject sampled(const Voxels& voxels)
{
    return SampledObject(openvdb_spheretree::LeafLayout(*maskOf(voxels)));
}

bool contains(const Voxels& voxels, const Coord& voxel)
{
    return std::binary_search(voxels.begin(), voxels.end(), voxel);
}

int64_t excess(const std::vector<ExactSphere>& balls, const Voxels& object)
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

Voxels voxelsOf(const LeafMask& mask, const Coord& origin)
{
    Voxels voxels;
    for (int i = 0; i < 512; ++i) {
        if (mask[i >> 6] >> (i & 63) & 1)
            voxels.push_back(origin.offsetBy(i >> 6, i >> 3 & 7, i & 7));
    }
    return voxels;
}

testing::AssertionResult standFor(const Voxels& points, const Voxels& voxels, Random& random)
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

void forEachTarget(const std::function<void()>& body)
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
