// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/level/CarriedLevels.h>

#include "support/MergedLeaves.h"

#include <openvdb_spheretree/pyramid/OrPyramid.h>

#include <set>

namespace {

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

Voxels parentsOf(const Voxels& voxels, const PyramidStep& step)
{
    std::set<Coord> parents;
    for (const Coord& v : voxels) parents.insert(step.parentVoxel(v));
    return Voxels(parents.begin(), parents.end());
}

TEST(CarriedLevels, ALiftedBallHoldsTheChildrenOfItsVoxels)
{
    Random random(1);
    for (int turn = 0; turn < 300; ++turn) {
        PyramidStep step;
        step.dim = turn % 3 == 0 ? 2 : 3;
        step.origin = Coord(-8, 16, step.dim == 2 ? 0 : 24);
        ExactSphere ball = randomBall(random, -3, 3, 5);
        if (step.dim == 2) ball.center[2] = 0;
        const ExactSphere fine = lifted(ball, step);
        int children = 0;
        for (const Coord& fineVoxel : CoordBBox(Coord(-30, -6, -6), Coord(14, 38, 46))) {
            if (step.dim == 2 && fineVoxel[2] != 0) continue;
            if (!holds(ball, step.parentVoxel(fineVoxel))) continue;
            ++children;
            EXPECT_TRUE(holds(fine, fineVoxel)) << fineVoxel;
        }
        EXPECT_TRUE(children % (step.dim == 2 ? 4 : 8) == 0);
        EXPECT_LE(fine.radius(), 2 * ball.radius() + 17);
    }
}

/// @return the voxels outside in all levels, as they are carried and as they are after that.
std::pair<int64_t, int64_t> expectCarried(
    const Voxels& voxels, const std::vector<int64_t>& counts, bool flat)
{
    PyramidStep step;
    step.dim = flat ? 2 : 3;
    step.origin = Coord(-8, -8, flat ? 0 : -8);
    const MergedLeaves fine(voxels, flat), coarse(parentsOf(voxels, step), flat);
    std::pair<int64_t, int64_t> around;
    const auto levels = coarse.levels(counts);
    for (const TightLevel& level : levels) {
        for (const ExactSphere& ball : level.balls) {
            around.first += excess({lifted(ball, step)}, fine.voxels);
        }
    }
    const int64_t most = counts.front() * 3 / 4;
    const auto carried = carriedDown(levels, step, most, fine.maker);
    EXPECT_EQ(carried.size(), counts.size());
    for (const int64_t some : expectChains(carried, fine.voxels)) around.second += some;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        EXPECT_LE(carried[k].balls.size(), std::size_t(k == 0 ? most : counts[k]));
    }
    return around;
}

TEST(CarriedLevels, KeepChainsAndAreTightOnTheFineObject)
{
    Random random(2);
    for (const double rate : {0.1, 0.5, 0.05, 0.2, 0.3}) {
        const Voxels voxels = shapes::noise(Coord(13, 12, 11), rate, random);
        for (const std::vector<int64_t>& counts :
            {std::vector<int64_t>{20, 7, 3, 1}, {30, 14, 9, 5, 3}, {9, 2}, {12}}) {
            const auto [before, after] = expectCarried(voxels, counts, false);
            EXPECT_LT(after, before);
        }
    }
}

TEST(CarriedLevels, OfAFlatObject)
{
    Random random(3);
    const Voxels voxels = shapes::noise(Coord(24, 25, 1), 0.4, random);
    const auto [before, after] = expectCarried(voxels, {15, 5, 1}, true);
    EXPECT_LT(after, before);
}

} // namespace
