// SPDX-License-Identifier: Apache-2.0
/// @file TestSphereUnion.cc
/// @brief The rasteriser of sphere unions against brute force over every voxel of a box.

#include <openvdb_spheretree/sphere/SphereUnion.h>

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/kernel/LeafBall.h>
#include <openvdb_spheretree/sphere/SphereRaster.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstddef>
#include <random>

namespace {

using namespace openvdb_spheretree;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskTree;
using ExactSpheres = std::vector<ExactSphere>;

const CoordBBox kWide(Coord(-100000), Coord(100000));
const int kSubdivisions[] = {2, 4, 8, 16, 1024};

class SphereUnion : public ::testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }
};

ExactSphere ball(int64_t x2, int64_t y2, int64_t z2, int64_t radiusSq)
{
    return {{x2, y2, z2}, radiusSq};
}

bool inAny(const ExactSpheres& spheres, const Coord& q, int subdivision = 2)
{
    for (const ExactSphere& s : spheres) {
        int64_t sum = 0;
        for (int a = 0; a < 3; ++a) {
            const int64_t d = int64_t(subdivision) * q[a] - s.center[a];
            sum += d * d;
        }
        if (sum <= s.radiusSq) return true;
    }
    return false;
}

void expectLikeBruteForce(
    const ExactSpheres& spheres, const CoordBBox& clip, const CoordBBox& all, int subdivision = 2)
{
    const MaskTree::Ptr tree = sphereUnion(spheres, clip, {{}, subdivision});
    openvdb::tree::ValueAccessor<const MaskTree> voxels(*tree);
    int64_t expected = 0;
    for (auto q = all.begin(); q; ++q) {
        const bool in = clip.isInside(*q) && inAny(spheres, *q, subdivision);
        expected += in;
        ASSERT_EQ(voxels.isValueOn(*q), in) << *q;
    }
    EXPECT_EQ(int64_t(tree->activeVoxelCount()), expected); // nothing beyond `all`
    for (auto leaf = tree->cbeginLeaf(); leaf; ++leaf) EXPECT_FALSE(leaf->isEmpty());
}

/// Spheres of all sizes up to @a largest voxels around @a middle, up to half of @a spread away,
/// centres between voxels included.
ExactSpheres randomSpheres(std::mt19937& random, int count, const Coord& middle, int spread,
    int largest, int subdivision = 2)
{
    const int apart = spread * subdivision / 2;
    const auto pick = [&](int lo, int hi) {
        return std::uniform_int_distribution<int>(lo, hi)(random);
    };
    ExactSpheres spheres;
    for (int i = 0; i < count; ++i) {
        const int r = pick(0, subdivision * largest);
        ExactSphere sphere = ball(0, 0, 0, pick(-3, r * r));
        for (int a = 0; a < 3; ++a)
            sphere.center[a] = subdivision * middle[a] + pick(-apart, apart);
        spheres.push_back(sphere);
    }
    return spheres;
}

TEST_F(SphereUnion, MatchesBruteForceOnRandomSpheresAcrossNodeBorders)
{
    for (unsigned seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const Coord corners[] = {
            Coord(0), Coord(8, -128, 128), Coord(-4096, 4096, 0), Coord(3), Coord(128, 128, 4096)};
        const Coord middle = corners[seed % 5];
        const int largest = seed % 3 == 0 ? 3 : 14, units = kSubdivisions[seed / 5 % 5];
        const ExactSpheres spheres =
            randomSpheres(random, 1 + seed % 7, middle, 20, largest, units);
        CoordBBox all(middle, middle);
        all.expand(26);
        expectLikeBruteForce(spheres, kWide, all, units);
        const CoordBBox clip(middle.offsetBy(-7, -4, -9), middle.offsetBy(9, 12, 6));
        expectLikeBruteForce(spheres, clip, all, units);
    }
}

/// Balls whose farthest voxel is one of a leaf's border, or would be if a 16th were added.
TEST_F(SphereUnion, MatchesBruteForceOnBallsThatJustTouchLeaves)
{
    std::mt19937 random(17);
    for (int trial = 0; trial < 60; ++trial) {
        SCOPED_TRACE(trial);
        ExactSphere sphere = ball(0, 0, 0, 0);
        for (int64_t& c : sphere.center) c = int64_t(random() % 128) - 64;
        const Coord touched(8 * int(random() % 3) - 8, int(random() % 8), -1);
        for (int a = 0; a < 3; ++a) {
            const int64_t d = 16 * touched[(a + trial) % 3] - sphere.center[a];
            sphere.radiusSq += d * d;
        }
        const CoordBBox all(Coord(-40), Coord(40));
        expectLikeBruteForce({sphere}, kWide, all, 16);
        --sphere.radiusSq;
        expectLikeBruteForce({sphere}, kWide, all, 16);
    }
}

/// So many that most add nothing to the others, in a cell or a leaf; some stand twice.
TEST_F(SphereUnion, MatchesBruteForceOnManyBallsThatOverlap)
{
    for (unsigned seed = 100; seed < 112; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const Coord middle = seed % 2 ? Coord(3) : Coord(-128, 4096, 16);
        const int units = kSubdivisions[seed / 2 % 5];
        ExactSpheres spheres = randomSpheres(random, 120, middle, 24, 5 + int(seed % 4) * 4, units);
        spheres.insert(spheres.end(), spheres.begin(), spheres.begin() + 40);
        CoordBBox all(middle, middle);
        all.expand(32);
        expectLikeBruteForce(spheres, kWide, all, units);
    }
}

TEST_F(SphereUnion, MatchesBruteForceWhereTilesAndLeavesMix)
{
    const ExactSpheres spheres{ball(1, -3, 5, 4 * 41 * 41), ball(90, 10, -7, 4 * 25 * 25 + 3)};
    expectLikeBruteForce(spheres, kWide, CoordBBox(Coord(-48), Coord(80)));
    EXPECT_GT(sphereUnion(spheres, kWide)->activeTileCount(), 0u);
    const ExactSpheres fine{
        ball(7, -23, 41, 256 * 41 * 41 + 5), ball(723, 77, -55, 256 * 25 * 25 - 7)};
    expectLikeBruteForce(fine, kWide, CoordBBox(Coord(-48), Coord(80)), 16);
    EXPECT_GT(sphereUnion(fine, kWide, {{}, 16})->activeTileCount(), 0u);
}

/// @return the union, made of a few spheres at a time.
MaskTree unionByAFew(const ExactSpheres& spheres, const CoordBBox& clip)
{
    MaskTree all;
    for (std::size_t begin = 0; begin < spheres.size(); begin += 1000) {
        const auto from = spheres.begin() + std::ptrdiff_t(begin);
        const auto few = std::min<std::ptrdiff_t>(1000, spheres.end() - from);
        all.topologyUnion(*sphereUnion(ExactSpheres(from, from + few), clip));
    }
    return all;
}

/// More than are sorted in one go, in two of the root's cells. Large ones, which come first, fill
/// what later ones reach into: blocks of 128, then a root cell.
TEST_F(SphereUnion, ManySpheresAreAsAFewAtATime)
{
    std::mt19937 random(11);
    ExactSpheres spheres = randomSpheres(random, 40000, Coord(4096, 300, 300), 500, 4);
    const auto expectTheSame = [&](const CoordBBox& clip) {
        MaskTree expected = unionByAFew(spheres, clip);
        const auto voxels = expected.activeVoxelCount();
        const MaskTree::Ptr all = sphereUnion(spheres, clip);
        const MaskTree::Ptr within = detail::rasterSpheres(spheres, {}, clip, &expected, nullptr);
        EXPECT_EQ(all->activeVoxelCount(), voxels);
        EXPECT_EQ(within->activeVoxelCount(), voxels);
        expected.topologyUnion(*all);
        expected.topologyUnion(*within);
        EXPECT_EQ(expected.activeVoxelCount(), voxels);
    };
    expectTheSame(kWide);
    spheres.push_back(ball(2 * 4160, 2 * 320, 2 * 320, 4 * 150 * 150));
    expectTheSame(kWide);
    spheres.push_back(ball(2 * 2048, 2 * 2048, 2 * 2048, 4 * 3600 * 3600));
    expectTheSame(CoordBBox(Coord(0), Coord(4295, 4095, 4095)));
}

/// With radii on both sides of what the kernel for leaves takes, in units of all sizes.
TEST_F(SphereUnion, LargeSpheresMatchBruteForceInAWindow)
{
    for (int units : kSubdivisions) {
        for (int radius : {140, 280, 300, 700, 2400}) {
            SCOPED_TRACE(std::to_string(units) + " units, radius " + std::to_string(radius));
            const int64_t r = int64_t(units) * radius, c = r * 5 / 7;
            const ExactSpheres spheres{ball(-c + 3, -c - 5, 9, r * r + 11)};
            const CoordBBox clip(Coord(-20, -20, -30), Coord(40, 40, 30));
            expectLikeBruteForce(spheres, clip, clip, units);
        }
    }
}

TEST_F(SphereUnion, TheSameSpheresInOtherUnitsAreTheSameVoxels)
{
    std::mt19937 random(23);
    ExactSpheres spheres = randomSpheres(random, 400, Coord(64, -3, 9), 300, 30);
    const MaskTree::Ptr expected = sphereUnion(spheres, kWide);
    for (int units : {4, 8, 16}) {
        ExactSpheres finer = spheres;
        for (ExactSphere& s : finer) {
            for (int64_t& c : s.center) c *= units / 2;
            s.radiusSq *= units / 2 * units / 2;
        }
        const MaskTree::Ptr same = sphereUnion(finer, kWide, {{}, units});
        EXPECT_TRUE(expected->hasSameTopology(*same));
        EXPECT_EQ(expected->activeVoxelCount(), same->activeVoxelCount());
        EXPECT_EQ(boundingBox(finer, {{}, units}), boundingBox(spheres));
        const CoordBBox box(Coord(-100), Coord(100));
        EXPECT_DOUBLE_EQ(crossedRows(finer, box, {{}, units}), crossedRows(spheres, box));
    }
}

TEST_F(SphereUnion, UnitsThatAreNoPowerOfTwoInRangeAreAnError)
{
    for (int units : {-16, 0, 1, 3, 12, 2048}) {
        EXPECT_THROW(sphereUnion({ball(0, 0, 0, 9)}, kWide, {{}, units}), openvdb::ValueError)
            << units;
        EXPECT_THROW(boundingBox({ball(0, 0, 0, 9)}, {{}, units}), openvdb::ValueError) << units;
    }
}

TEST_F(SphereUnion, ASphereOfOneVoxelIsThatVoxel)
{
    const MaskTree::Ptr tree = sphereUnion({ball(-14, 16, 254, 0)}, kWide);
    EXPECT_EQ(tree->activeVoxelCount(), 1u);
    EXPECT_TRUE(tree->isValueOn(Coord(-7, 8, 127)));
}

TEST_F(SphereUnion, NegativeSquaresAndSpheresBetweenVoxelsAreEmpty)
{
    const ExactSpheres spheres{
        ball(0, 0, 0, -1), ball(1, 0, 0, 0), ball(1, 1, 0, 1), ball(1, 1, 1, 2)};
    const MaskTree::Ptr tree = sphereUnion(spheres, kWide);
    EXPECT_TRUE(tree->empty());
    EXPECT_TRUE(boundingBox(spheres).empty());
    EXPECT_EQ(sphereUnion({ball(1, 1, 1, 3)}, kWide)->activeVoxelCount(), 8u);
    EXPECT_TRUE(sphereUnion({}, kWide)->empty());
}

TEST_F(SphereUnion, TheSurfaceIsClosed)
{
    const ExactSpheres at{ball(0, 0, 0, 4 * 25)}, below{ball(0, 0, 0, 4 * 25 - 1)};
    for (const Coord& q : {Coord(5, 0, 0), Coord(-3, 4, 0), Coord(0, -3, -4)}) {
        EXPECT_TRUE(sphereUnion(at, kWide)->isValueOn(q)) << q;
        EXPECT_FALSE(sphereUnion(below, kWide)->isValueOn(q)) << q;
    }
}

TEST_F(SphereUnion, LargeSpheresBecomeTilesOfEveryNodeLevel)
{
    // Holds [0, 4095]^3: the farthest corner is 2048 sqrt(3) = 3547.3 away.
    const ExactSpheres spheres{ball(4095, 4095, 4095, int64_t(4) * 3560 * 3560)};
    const CoordBBox clip(Coord(-300, -10, -10), Coord(4095));
    const MaskTree::Ptr tree = sphereUnion(spheres, clip);
    EXPECT_TRUE(tree->isValueOn(Coord(2000)));
    EXPECT_EQ(tree->getValueDepth(Coord(2000)), 0);             // a tile of the root
    EXPECT_EQ(tree->getValueDepth(Coord(-64, 2048, 2048)), 1);  // 128^3
    EXPECT_EQ(tree->getValueDepth(Coord(-270, 2048, 2048)), 2); // 8^3, cut by x = -300
    EXPECT_EQ(tree->getValueDepth(Coord(-299, 2048, 2048)), 3);
    EXPECT_TRUE(tree->isValueOn(Coord(-300, 2048, 2048)));
    EXPECT_FALSE(tree->isValueOn(Coord(-301, 2048, 2048)));
    const MaskTree::Ptr both = sphereUnion({spheres[0], ball(4000, 4000, 4000, 1000)}, clip);
    EXPECT_EQ(both->getValueDepth(Coord(2000)), 0) << "a small one inside changes nothing";
}

TEST_F(SphereUnion, AClippedTileIsDescended)
{
    const CoordBBox clip(Coord(1, 0, 0), Coord(130, 127, 127));
    const MaskTree::Ptr tree = sphereUnion({ball(0, 0, 0, 4 * 1000000)}, clip);
    EXPECT_EQ(tree->activeVoxelCount(), clip.volume());
    CoordBBox active;
    ASSERT_TRUE(tree->evalActiveVoxelBoundingBox(active));
    EXPECT_EQ(active, clip);
}

TEST_F(SphereUnion, NodesGrowWithTheSurfaceOnly)
{
    const MaskTree::Ptr small = sphereUnion({ball(0, 0, 0, 4 * 250000)}, kWide);
    const MaskTree::Ptr large = sphereUnion({ball(0, 0, 0, 4 * 1000000)}, kWide);
    EXPECT_LT(small->leafCount(), 70000u); // 4 pi 500^2 / 64 = 49,087 leaf faces
    EXPECT_LT(large->leafCount(), 4.2 * small->leafCount());
    EXPECT_LT(large->activeTileCount(), 5 * small->activeTileCount());
    EXPECT_GT(large->activeVoxelCount(), 7.9 * small->activeVoxelCount());
}

/// Bits that lie in a ball, whose centre may be anywhere near or far.
void expectKernelsLikeBruteForce(const int64_t center[3], int64_t radiusSq, int shift)
{
    const ExactSpheres ball{{{center[0], center[1], center[2]}, radiusSq}};
    uint64_t expected[8] = {}, vector[8] = {}, portable[8] = {};
    for (int i = 0; i < 512; ++i) {
        if (inAny(ball, Coord(i >> 6, i >> 3 & 7, i & 7), 1 << shift))
            expected[i >> 6] |= 1ull << (i & 63);
    }
    detail::orBallIntoLeaf(center, radiusSq, shift, vector);
    detail::orBallIntoLeafPortable(center, radiusSq, shift, portable);
    for (int x = 0; x < 8; ++x) {
        ASSERT_EQ(vector[x], expected[x])
            << center[0] << ' ' << center[1] << ' ' << center[2] << ' ' << radiusSq << ' ' << shift;
        ASSERT_EQ(portable[x], expected[x]);
    }
}

TEST_F(SphereUnion, TheLeafKernelsMatchBruteForceUpToTheirLimits)
{
    std::mt19937 random(5);
    const int64_t reach = detail::kLeafBallReach;
    for (int shift = 1; shift <= 4; ++shift) {
        const int64_t last = int64_t(7) << shift, middle = last / 2;
        for (int64_t range : {int64_t(0), 2 * last, 20 * last, reach - last}) {
            std::uniform_int_distribution<int64_t> offset(-range, range);
            for (int trial = 0; trial < 2000; ++trial) {
                const int64_t center[3] = {
                    middle + offset(random), middle + offset(random), middle + offset(random)};
                // Mostly a surface that passes through the leaf.
                int64_t square = 0;
                for (int64_t c : center)
                    square += (c - (int64_t(random() % 8) << shift)) * (c - middle);
                expectKernelsLikeBruteForce(
                    center, std::min(std::abs(square), reach * reach), shift);
            }
        }
        for (int64_t x : {last - reach, reach}) {
            for (int64_t radiusSq : {int64_t(0), reach * reach - 1, reach * reach}) {
                const int64_t alongX[3] = {x, 6, 7}, alongZ[3] = {7, 6, x}, diagonal[3] = {x, x, x};
                expectKernelsLikeBruteForce(alongX, radiusSq, shift);
                expectKernelsLikeBruteForce(alongZ, radiusSq, shift);
                expectKernelsLikeBruteForce(diagonal, radiusSq, shift);
            }
        }
    }
}

TEST_F(SphereUnion, HugeSpheresFarAwayDoNotOverflow)
{
    // Radius and distance 1.5 10^9, as many as the squares hold; the surface passes through x = 0.
    const int64_t r2 = 3000000000;
    const CoordBBox clip(Coord(-20, -3, -3), Coord(20, 3, 3));
    const MaskTree::Ptr tree = sphereUnion({ball(-r2, 0, 0, r2 * r2)}, clip);
    EXPECT_TRUE(tree->isValueOn(Coord(0, 0, 0)));
    EXPECT_FALSE(tree->isValueOn(Coord(0, 1, 0)));
    EXPECT_FALSE(tree->isValueOn(Coord(1, 0, 0)));
    EXPECT_TRUE(tree->isValueOn(Coord(-1, 3, 3)));
    EXPECT_EQ(tree->activeVoxelCount(), 20u * 49 + 1);
    EXPECT_EQ(boundingBox({ball(-r2, 0, 0, r2 * r2)}).max().x(), 0);

    // One less: doubles cannot tell the square from that of the radius.
    EXPECT_EQ(boundingBox({ball(-r2, 0, 0, r2 * r2 - 1)}).max().x(), -1);
    const MaskTree::Ptr below =
        sphereUnion({ball(0, 0, -r2, r2 * r2 - 1)}, CoordBBox(Coord(-3, -3, -20), Coord(3, 3, 20)));
    EXPECT_EQ(below->activeVoxelCount(), 20u * 49);

    // In 16ths of a voxel, so at an eighth of the distance.
    const CoordBBox near(Coord(-20, -1, -1), Coord(20, 1, 1));
    const ExactSpheres fine{ball(-r2, 0, 0, r2 * r2)};
    EXPECT_EQ(sphereUnion(fine, near, {{}, 16})->activeVoxelCount(), 20u * 9 + 1);
    EXPECT_EQ(boundingBox(fine, {{}, 16}).max().x(), 0);
    EXPECT_EQ(boundingBox({ball(-r2, 0, 0, r2 * r2 - 1)}, {{}, 16}).max().x(), -1);

    // The largest that there may be.
    const int64_t root = 3037000499, most = std::numeric_limits<int64_t>::max();
    EXPECT_EQ(sphereUnion({ball(-root, 0, 0, most)}, clip)->activeVoxelCount(), 21u * 49);
    EXPECT_EQ(boundingBox({ball(-root, 0, 0, most)}).max().x(), 0);
}

TEST_F(SphereUnion, AtTheCornersOfItsBoxAHugeSphereHoldsNothing)
{
    const Coord corner(1490000000);
    for (int i = 0; i < 8; ++i) {
        const Coord at((i & 4 ? -1 : 1) * corner[0], (i & 2 ? -1 : 1) * corner[1],
            (i & 1 ? -1 : 1) * corner[2]);
        const CoordBBox clip(at - Coord(20), at + Coord(20));
        EXPECT_TRUE(sphereUnion({ball(0, 0, 0, int64_t(9000000000000000000))}, clip)->empty());
    }
}

TEST_F(SphereUnion, WorksAtTheLastCoordinates)
{
    const int32_t last = std::numeric_limits<int32_t>::max();
    const Coord corner(last - 5, -last + 5, last - 5);
    const CoordBBox clip(Coord(last - 9, -last, last - 9), Coord(last, -last + 9, last));
    const auto center = [](int32_t c) { return 2 * int64_t(c); };
    const MaskTree::Ptr tree =
        sphereUnion({ball(center(corner[0]), center(corner[1]), center(corner[2]), 4 * 9)}, clip);
    EXPECT_EQ(tree->activeVoxelCount(), 123u); // lattice points within 3
    EXPECT_TRUE(tree->isValueOn(corner.offsetBy(3, 0, 0)));
}

TEST_F(SphereUnion, DoesNotDependOnThreadsNorOnTheOrderOfSpheres)
{
    std::mt19937 random(7);
    ExactSpheres spheres = randomSpheres(random, 30000, Coord(2048), 1500, 12); // sorted in parts
    const auto draw = [&](int threads) {
        tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return sphereUnion(spheres, kWide);
    };
    const MaskTree::Ptr one = draw(1), two = draw(2);
    std::shuffle(spheres.begin(), spheres.end(), random);
    const MaskTree::Ptr shuffled = draw(2);
    for (const MaskTree::Ptr& other : {two, shuffled}) {
        EXPECT_TRUE(one->hasSameTopology(*other));
        EXPECT_EQ(one->activeTileCount(), other->activeTileCount());
        EXPECT_EQ(one->activeVoxelCount(), other->activeVoxelCount());
    }
}

TEST_F(SphereUnion, DrawnWithinAMaskTheVoxelsOfTheMaskAreTheSame)
{
    std::mt19937 random(13);
    MaskTree mask(false);
    mask.addTile(3, Coord(-4096, 0, 0), true, true);
    mask.addTile(2, Coord(0, 0, 0), true, true);
    mask.addTile(1, Coord(256, 8, 0), true, true);
    for (int i = 0; i < 3000; ++i) {
        mask.setValueOn(Coord(128 + int(random() % 200), int(random() % 90), -int(random() % 90)));
    }
    for (int trial = 0; trial < 6; ++trial) {
        ExactSpheres spheres = randomSpheres(random, 40, Coord(100, 40, 0), 500, 60);
        if (trial > 2) spheres.push_back(ball(-300, 100, 7, int64_t(4) * 5000 * 5000 / trial));
        const MaskTree::Ptr drawn =
            detail::rasterSpheres(spheres, Distance(), kWide, &mask, nullptr);
        const MaskTree::Ptr expected = sphereUnion(spheres, kWide);
        drawn->topologyIntersection(mask);
        expected->topologyIntersection(mask);
        EXPECT_EQ(drawn->activeVoxelCount(), expected->activeVoxelCount());
        drawn->topologyDifference(*expected);
        EXPECT_EQ(drawn->activeVoxelCount(), 0u) << "trial " << trial;
    }
}

TEST_F(SphereUnion, DrawnWithinAMaskNodesWithoutVoxelsOfTheMaskAreLeftOut)
{
    MaskTree mask(false);
    mask.setValueOn(Coord(0));
    mask.setValueOn(Coord(1000));
    mask.setValueOn(Coord(70000));
    const ExactSpheres surface{ball(70000, 70000, 70000, int64_t(3) * 70000 * 70000)};
    const MaskTree::Ptr cut = detail::rasterSpheres(surface, Distance(), kWide, &mask, nullptr);
    EXPECT_EQ(cut->leafCount(), 1u);       // of (70000, 70000, 70000), the last voxel that it holds
    EXPECT_EQ(cut->activeTileCount(), 1u); // the 4096^3 voxels at the origin are all inside
    for (int c : {0, 1000, 70000}) EXPECT_TRUE(cut->isValueOn(Coord(c))) << c;
    const ExactSpheres inside{ball(2000, 2000, 2000, int64_t(12) * 1100 * 1100)};
    const MaskTree::Ptr whole = detail::rasterSpheres(inside, Distance(), kWide, &mask, nullptr);
    EXPECT_EQ(whole->leafCount(), 0u);
    EXPECT_LE(whole->activeTileCount(), 2u); // of the leaves of (0, 0, 0) and (1000, 1000, 1000)
    EXPECT_TRUE(whole->isValueOn(Coord(0)) && whole->isValueOn(Coord(1000)));
    MaskTree last(false);
    last.setValueOn(Coord(70000));
    const MaskTree::Ptr far = detail::rasterSpheres(surface, Distance(), kWide, &last, nullptr);
    EXPECT_EQ(far->activeTileCount(), 0u); // none for the 4096^3 voxels at the origin
}

/// The mask has more nodes than the ball's box: those of the box are looked up, one by one.
TEST_F(SphereUnion, DrawnWithinAMaskOfManyNodesThoseBesideItAreLeftOut)
{
    constexpr int kNode = 4096;
    MaskTree mask(false);
    for (int i = 2; i < 20; ++i) {
        for (int k = 0; k < 2; ++k) mask.setValueOn(Coord(kNode * i, kNode * k, 0));
    }
    const ExactSpheres around{ball(kNode, kNode, kNode, int64_t(4) * 3600 * 3600)};
    const MaskTree::Ptr drawn = detail::rasterSpheres(around, Distance(), kWide, &mask, nullptr);
    EXPECT_FALSE(drawn->isValueOn(Coord(kNode / 2))); // the ball holds all of that node
    EXPECT_EQ(drawn->activeVoxelCount(), 0u);
}

TEST_F(SphereUnion, StopsWhenInterrupted)
{
    struct Stop : openvdb::util::NullInterrupter {
        bool wasInterrupted(int) override { return true; }
    } stop;
    EXPECT_THROW(sphereUnion({ball(0, 0, 0, 100)}, kWide, {}, &stop), Interrupted);
}

TEST_F(SphereUnion, BoundingBoxIsTheSmallestOne)
{
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
        const SphereMetric metric({}, kSubdivisions[i % 5]);
        const ExactSpheres spheres =
            randomSpheres(random, 1 + i % 3, Coord(-5, 3, 9), 12, 1 + i % 5, metric.subdivision);
        CoordBBox expected;
        sphereUnion(spheres, kWide, metric)->evalActiveVoxelBoundingBox(expected);
        EXPECT_EQ(boundingBox(spheres, metric), expected) << "trial " << i;
    }
}

TEST_F(SphereUnion, ABlockOfNothingButFullLeavesIsKept)
{
    const openvdb_spheretree::ExactSphere large{{0, 0, 0}, 4 * 1000000};
    const auto covered = openvdb_spheretree::sphereUnion(
        {large}, openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(7)));
    EXPECT_EQ(covered->activeVoxelCount(), 512u);
}

} // namespace
