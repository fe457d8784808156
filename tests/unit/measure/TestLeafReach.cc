// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/measure/LeafReach.h>

#include <gtest/gtest.h>

#include <random>
#include <vector>

using namespace openvdb_spheretree;
using detail::LeafReach;
using openvdb::Coord;
using openvdb::MaskTree;

namespace {

const std::vector<Distance> kDistances = {Distance(), Distance::l1(), Distance::linf(),
    Distance::chamfer(3, 4, 5), Distance::chamfer(5, 7, 8)};

/// The leaf's voxels that are farther from all of @a object, one by one.
LeafMask farByOne(const std::vector<Coord>& object, const Distance& distance, int64_t limitSq,
    const Coord& origin, const LeafMask& mask)
{
    LeafMask result = mask;
    for (int n = 0; n < kLeafVoxels; ++n) {
        const Coord q = origin.offsetBy(n >> 6, n >> 3 & 7, n & 7);
        for (const Coord& p : object) {
            const Coord d = p - q;
            if (distance.lengthSq(d[0], d[1], d[2]) > limitSq) continue;
            result[n >> 6] &= ~(uint64_t(1) << (n & 63));
        }
    }
    return result;
}

/// Up to @a most voxels in the leaf and in those around.
std::vector<Coord> voxelsAround(const Coord& origin, int most, std::mt19937& random)
{
    std::vector<Coord> voxels;
    for (int i = 1 + int(random() % uint32_t(most)); i > 0; --i) {
        const int side = 24, x = int(random() % side), y = int(random() % side);
        voxels.push_back(origin.offsetBy(x - 8, y - 8, int(random() % side) - 8));
    }
    return voxels;
}

MaskTree maskOf(const std::vector<Coord>& voxels)
{
    MaskTree mask;
    for (const Coord& voxel : voxels) mask.setValueOn(voxel);
    return mask;
}

} // namespace

TEST(LeafReach, TakesWhatIsNearAndNothingElse)
{
    std::mt19937 random(31);
    LeafReach reach;
    const Coord origin(-8, 120, 4096);
    for (int round = 0; round < 400; ++round) {
        const std::vector<Coord> object = voxelsAround(origin, 4, random);
        const MaskTree mask = maskOf(object);
        const Distance distance = kDistances[random() % kDistances.size()];
        const int64_t most = distance.lengthSq(LeafReach::kReach + 1, 0, 0) - 1;
        const int64_t limitSq = int64_t(random() % uint64_t(most + 1));
        LeafMask leaf;
        for (uint64_t& word : leaf) word = random() | uint64_t(random()) << 32;
        const LeafMask expected = farByOne(object, distance, limitSq, origin, leaf);
        reach.takeNear(mask, distance, limitSq, origin, leaf);
        ASSERT_EQ(leaf, expected) << toString(distance) << ' ' << limitSq;
    }
}

TEST(LeafReach, FindsTheNearestVoxelWhateverTheLimit)
{
    const std::vector<int64_t> kLimits = {-1, 0, 1, int64_t(1) << 60};
    std::mt19937 random(32);
    LeafReach reach;
    const Coord origin(-8, 120, 4096);
    int found = 0, beyond = 0;
    for (int round = 0; round < 60; ++round) {
        const std::vector<Coord> object = voxelsAround(origin, 40, random);
        const MaskTree mask = maskOf(object);
        const Distance distance = kDistances[random() % kDistances.size()];
        LeafMask leaf = LeafMask::full();
        reach.takeNear(mask, distance, kLimits[random() % kLimits.size()], origin, leaf);
        for (int i = 0; i < 512; ++i) {
            const Coord voxel = origin.offsetBy(i >> 6, i >> 3 & 7, i & 7);
            const auto distSqTo = [&](const Coord& other) {
                const Coord d = other - voxel;
                return distance.lengthSq(d[0], d[1], d[2]);
            };
            int64_t least = distSqTo(object.front());
            for (const Coord& other : object) least = std::min(least, distSqTo(other));
            const bool isBeyond = least >= distance.lengthSq(LeafReach::kReach + 1, 0, 0);
            Coord nearest;
            ASSERT_EQ(reach.nearest(voxel, nearest), isBeyond ? -1 : least) << toString(distance);
            (isBeyond ? beyond : found) += 1;
            if (isBeyond) continue;
            ASSERT_EQ(distSqTo(nearest), least);
            ASSERT_TRUE(mask.isValueOn(nearest));
        }
    }
    EXPECT_GT(found, 5000);
    EXPECT_GT(beyond, 500);
}

TEST(LeafReach, ReachesNoFartherThanItsReachWhateverTheLimit)
{
    MaskTree mask;
    const Coord origin(0, 0, 0), voxel(4, 4, -8);
    mask.setValueOn(voxel);
    LeafReach reach;
    for (const Distance& distance : kDistances) {
        const int64_t most = distance.lengthSq(LeafReach::kReach + 1, 0, 0) - 1;
        LeafMask leaf = LeafMask::full();
        reach.takeNear(mask, distance, int64_t(1) << 60, origin, leaf);
        EXPECT_EQ(leaf, farByOne({voxel}, distance, most, origin, LeafMask::full()))
            << toString(distance);
    }
}

TEST(LeafReach, ATileIsAllOfItsVoxels)
{
    MaskTree mask;
    mask.addTile(1, Coord(-8, 0, 0), true, true);
    LeafReach reach;
    LeafMask leaf = LeafMask::full();
    reach.takeNear(mask, {}, 9, Coord(0), leaf); // three slices
    for (int x = 0; x < 8; ++x) EXPECT_EQ(leaf[x], x < 3 ? 0 : ~uint64_t(0)) << x;
    Coord nearest;
    EXPECT_EQ(reach.nearest(Coord(7, 2, 3), nearest), 64);
    EXPECT_EQ(nearest, Coord(-1, 2, 3));
}

TEST(LeafReach, WhereNothingIsNearAllStays)
{
    LeafReach reach;
    LeafMask leaf = LeafMask::full();
    reach.takeNear(MaskTree(), {}, 50, Coord(0), leaf);
    EXPECT_TRUE(leaf.all());
    MaskTree mask;
    mask.setValueOn(Coord(3, 3, 3));
    reach.takeNear(mask, {}, -1, Coord(0), leaf);
    EXPECT_TRUE(leaf.all());
    reach.takeNear(mask, {}, 0, Coord(0), leaf);
    EXPECT_EQ(leaf.count(), 511);
}

TEST(LeafReach, SeesNothingBeyondTheEndsOfCoordinates)
{
    LeafReach reach;
    const Coord last(INT32_MAX - 7), first(INT32_MIN);
    MaskTree atFirst, atLast;
    atFirst.setValueOn(first);
    atLast.setValueOn(Coord(INT32_MAX));
    for (const Distance& distance : kDistances) {
        LeafMask mask = LeafMask::full();
        reach.takeNear(atFirst, distance, 25, last, mask); // the other end of the world is not near
        EXPECT_EQ(mask.count(), kLeafVoxels);
        Coord nearest;
        EXPECT_EQ(reach.nearest(Coord(INT32_MAX), nearest), -1);
        reach.takeNear(atLast, distance, 0, last, mask);
        EXPECT_EQ(mask.count(), kLeafVoxels - 1);
        EXPECT_EQ(reach.nearest(Coord(INT32_MAX), nearest), 0);
        EXPECT_EQ(nearest, Coord(INT32_MAX));
        mask = LeafMask::full();
        reach.takeNear(atFirst, distance, 0, first, mask);
        EXPECT_EQ(mask.count(), kLeafVoxels - 1);
    }
}
