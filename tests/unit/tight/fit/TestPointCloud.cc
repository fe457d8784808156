// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/fit/PointCloud.h>

#include "support/FineBalls.h"

#include <cmath>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// @param spread  of the points: where it is small, some are as far as others
void expectFarthest(int count, int spread, bool radii, Random& random)
{
    PointCloud cloud;
    cloud.add(9, 9, 9, 9); // to be forgotten
    cloud.clear();
    std::vector<Coord> points;
    std::vector<int> radius;
    for (int i = 0; i < count; ++i) {
        points.push_back(random.coord(-spread, spread));
        radius.push_back(radii ? random.between(0, 30) : 0);
        const Coord& p = points.back();
        cloud.add(float(p[0]), float(p[1]), float(p[2]), float(radius.back()));
    }
    cloud.finish();
    ASSERT_EQ(cloud.size(), points.size());
    for (int turn = 0; turn < 20; ++turn) {
        const Coord from = random.coord(-60, 60);
        double most = -1;
        std::size_t first = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double reach =
                std::sqrt(double(squaredDistance(points[i], from))) + double(radius[i]);
            if (reach * reach > most) first = i;
            most = std::max(most, reach * reach);
        }
        const auto far = cloud.farthest(float(from[0]), float(from[1]), float(from[2]));
        ASSERT_EQ(far.distanceSq, cloud.farthestSq(float(from[0]), float(from[1]), float(from[2])));
        if (radii) {
            ASSERT_NEAR(far.distanceSq, most, 1e-5 * most);
            continue;
        }
        ASSERT_EQ(double(far.distanceSq), std::rint(most));
        ASSERT_EQ(squaredDistance(points[far.point], from), squaredDistance(points[first], from));
        for (std::size_t i = 0; i < far.point; ++i) { // of equals, the first
            ASSERT_LT(squaredDistance(points[i], from), int64_t(far.distanceSq));
        }
    }
}

TEST(PointCloud, FindsTheFarthestPointWithEveryTarget)
{
    forEachTarget([] {
        Random random(1);
        for (int count = 1; count < 70; ++count) {
            for (const int spread : {1, 3, 40}) {
                ASSERT_NO_FATAL_FAILURE(expectFarthest(count, spread, false, random));
                ASSERT_NO_FATAL_FAILURE(expectFarthest(count, spread, true, random));
            }
        }
    });
}

} // namespace
