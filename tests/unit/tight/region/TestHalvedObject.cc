// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/region/HalvedObject.h>

#include "support/MergedLeaves.h"

#include <cstdlib>
#include <set>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

Voxels parentsOf(const Voxels& voxels, const HalvedObject& halved)
{
    std::set<Coord> parents;
    for (const Coord& v : voxels) parents.insert(halved.step().parentVoxel(v));
    return Voxels(parents.begin(), parents.end());
}

TEST(HalvedObject, HasTheParentsOfVoxelsAndRegions)
{
    Random random(1);
    for (int turn = 0; turn < 100; ++turn) {
        const bool flat = turn % 3 == 0;
        const Coord size(40, 35, flat ? 1 : 30);
        const Voxels voxels = translated(
            shapes::noise(size, turn % 2 ? 0.01 : 0.4, random), Coord(-17, -9, flat ? 0 : 5));
        const SampledObject fine = sampled(voxels);
        const HalvedObject halved(fine.level(0), flat);
        const SampleLevel& level = halved.object().level(0);
        const ExactSphere everything{{0, 0, 0}, int64_t(1) << 40};
        ASSERT_EQ(
            voxelsOf({regionOf(everything, level)}, level).front(), parentsOf(voxels, halved));
        const VoxelRegion region = regionOf(randomBall(random, -15, 25, 15), fine.level(0));
        ASSERT_EQ(voxelsOf({halved.regionOf(region)}, level).front(),
            parentsOf(voxelsOf({region}, fine.level(0)).front(), halved));
    }
}

TEST(HalvedObject, CentersStayWhereTheyAreInTheObject)
{
    for (const bool flat : {false, true}) {
        const SampledObject fine = sampled({Coord(0)});
        const HalvedObject halved(fine.level(0), flat);
        for (const Coord& v : CoordBBox(Coord(-5, -6, flat ? 0 : -3), Coord(4, 3, flat ? 0 : 2))) {
            const ExactSphere center = halved.centerOf(voxelBall(v));
            const ExactSphere parent = voxelBall(halved.step().parentVoxel(v));
            EXPECT_EQ(center.radiusSq, 0);
            for (int a = 0; a < 3; ++a) {
                const bool isHalved = a < halved.step().dim;
                EXPECT_EQ(std::abs(center.center[a] - parent.center[a]), isHalved ? kFine / 4 : 0);
            }
        }
    }
}

} // namespace
