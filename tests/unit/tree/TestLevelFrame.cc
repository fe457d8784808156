// SPDX-License-Identifier: Apache-2.0
/// @file TestLevelFrame.cc
/// @brief Where a level's balls are, and how large: against the voxels that they have to hold, and
/// against the formulas in exact integers and in long double.

#include <openvdb_spheretree/tree/LevelFrame.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using openvdb::Coord;
using Wide = unsigned __int128;

const Coord kOrigin(-16, 8, 1024);

struct Pyramid {
    int factor, dim, level;
};

std::vector<Pyramid> somePyramids()
{
    return {{2, 3, 1}, {2, 3, 2}, {2, 3, 3}, {3, 3, 1}, {3, 3, 2}, {5, 3, 1}, {2, 2, 1}, {2, 2, 3},
        {3, 2, 2}, {2, 3, 0}, {3, 2, 0}};
}

SphereTreeSettings settingsOf(const Pyramid& pyramid, RadiusScale scale = RadiusScale::Tight)
{
    SphereTreeSettings settings = ReversibleOptions();
    settings.pyramid().factor = pyramid.factor;
    settings.dim = pyramid.dim;
    settings.pyramid().scale = scale;
    return settings;
}

int power(int base, int exponent) { return exponent == 0 ? 1 : base * power(base, exponent - 1); }

/// The offsets q - c of the digital ball { q : |q - c|^2 < radiusSq }.
std::vector<Coord> offsetsOfBall(int radiusSq, int dim)
{
    std::vector<Coord> offsets;
    for (int x = -radiusSq; x <= radiusSq; ++x) {
        for (int y = -radiusSq; y <= radiusSq; ++y) {
            for (int z = dim == 2 ? 0 : -radiusSq; z <= (dim == 2 ? 0 : radiusSq); ++z) {
                if (x * x + y * y + z * z < radiusSq) offsets.emplace_back(x, y, z);
            }
        }
    }
    return offsets;
}

/// The finest voxel centres of the block of a level's voxel, doubled.
std::vector<Doubled> blockOf(const Coord& voxel, const Pyramid& pyramid)
{
    const int side = power(pyramid.factor, pyramid.level), sideZ = pyramid.dim == 2 ? 1 : side;
    const Coord origin = pyramid.level == 0 ? Coord(0, 0, 0) : kOrigin;
    const Coord first(
        origin[0] + side * voxel[0], origin[1] + side * voxel[1], origin[2] + sideZ * voxel[2]);
    std::vector<Doubled> centres;
    for (int x = 0; x < side; ++x) {
        for (int y = 0; y < side; ++y) {
            for (int z = 0; z < sideZ; ++z) {
                centres.push_back({2 * (first[0] + x), 2 * (first[1] + y), 2 * (first[2] + z)});
            }
        }
    }
    return centres;
}

TEST(LevelFrame, SpheresHoldEveryFinestVoxelOfEveryVoxelOfTheirBall)
{
    const Coord center(5, -3, 4);
    for (const Pyramid& pyramid : somePyramids()) {
        for (const RadiusScale scale : {RadiusScale::Tight, RadiusScale::Paper}) {
            const LevelFrame frame(pyramid.level, kOrigin, settingsOf(pyramid, scale));
            for (int radiusSq : {1, 2, 3, 4, 5, 6, 9, 14}) {
                const int64_t coverSq = frame.radius(radiusSq).coverSq();
                for (const Coord& offset : offsetsOfBall(radiusSq, pyramid.dim)) {
                    for (const Doubled& voxel : blockOf(center + offset, pyramid)) {
                        ASSERT_LE(distanceSq(voxel, frame.center(center)), coverSq)
                            << "factor " << pyramid.factor << " dim " << pyramid.dim << " level "
                            << pyramid.level << " radiusSq " << radiusSq;
                    }
                }
            }
        }
    }
}

TEST(LevelFrame, ASingleVoxelsSphereReachesJustToTheCornersOfItsBlock)
{
    for (const Pyramid& pyramid : somePyramids()) {
        const LevelFrame frame(pyramid.level, kOrigin, settingsOf(pyramid));
        int64_t farthest = 0;
        for (const Doubled& voxel : blockOf(Coord(1, 2, 3), pyramid)) {
            farthest = std::max(farthest, distanceSq(voxel, frame.center(Coord(1, 2, 3))));
        }
        EXPECT_EQ(frame.radius(1).coverSq(), farthest);
        EXPECT_EQ(frame.growth().coverSq(), farthest);
    }
}

TEST(LevelFrame, OnLevel0SpheresHoldJustTheVoxelsOfTheBall)
{
    for (const RadiusScale scale : {RadiusScale::Tight, RadiusScale::Paper}) {
        const LevelFrame frame(0, kOrigin, settingsOf({2, 3, 0}, scale));
        for (int radiusSq = 1; radiusSq < 30; ++radiusSq) {
            const int64_t coverSq = frame.radius(radiusSq).coverSq();
            for (int64_t distSq = 0; distSq < 40; ++distSq) {
                EXPECT_EQ(4 * distSq <= coverSq, distSq < radiusSq) << radiusSq << ' ' << distSq;
            }
        }
    }
}

TEST(LevelFrame, CentresAreTheMiddleOfTheVoxelsBlock)
{
    const Coord voxel(-7, 0, 11);
    for (const Pyramid& pyramid : somePyramids()) {
        const std::vector<Doubled> block = blockOf(voxel, pyramid);
        openvdb::Vec3d sum(0);
        for (const Doubled& at : block) sum += at.halved();
        const LevelFrame frame(pyramid.level, kOrigin, settingsOf(pyramid));
        EXPECT_EQ(frame.center(voxel).halved(), sum / double(block.size()));
        EXPECT_EQ(frame.scale(), power(pyramid.factor, pyramid.level));
    }
}

TEST(LevelFrame, RadiiFollowTheFormula)
{
    for (const Pyramid& pyramid : somePyramids()) {
        const long double scale = power(pyramid.factor, pyramid.level);
        const long double growth = std::sqrt((long double)(pyramid.dim)) * (scale - 1) / 2;
        const LevelFrame tight(pyramid.level, kOrigin, settingsOf(pyramid));
        const LevelFrame paper(pyramid.level, kOrigin, settingsOf(pyramid, RadiusScale::Paper));
        for (int radiusSq = 1; radiusSq < 400; ++radiusSq) {
            const long double expected = scale * std::sqrt((long double)(radiusSq - 1)) + growth;
            EXPECT_NEAR(
                tight.radius(radiusSq).radius(), double(expected), 1e-12 * double(expected));
            const long double covered = pyramid.level == 0 ? radiusSq - 1 : radiusSq;
            const long double loose = scale * std::sqrt(covered) + growth;
            EXPECT_NEAR(paper.radius(radiusSq).radius(), double(loose), 1e-12 * double(loose));
        }
    }
}

/// sqrt(D) <= sqrt(a) + sqrt(b), without roots: D - a - b <= 2 sqrt(a b).
bool notAbove(int64_t D, const RootSum& sum)
{
    const __int128 rest = __int128(D) - sum.a - sum.b;
    return rest <= 0 || Wide(rest) * Wide(rest) <= 4 * Wide(sum.a) * Wide(sum.b);
}

std::vector<RootSum> someRootSums()
{
    std::vector<RootSum> sums{{0, 0}, {0, 1}, {1, 0}, {4, 9}, {2, 8}, {int64_t(1) << 60, 0},
        {(int64_t(1) << 60) - 1, (int64_t(1) << 60) + 1}, {int64_t(1) << 60, int64_t(1) << 60}};
    std::mt19937_64 random(1);
    for (int i = 0; i < 100000; ++i) {
        const int shiftA = int(random() % 60) + 3, shiftB = int(random() % 60) + 3;
        sums.push_back({int64_t(random() >> shiftA), int64_t(random() >> shiftB)});
        if (sums.back().a > int64_t(1) << 60) sums.back().a >>= 2; // the sum has to fit
        if (sums.back().b > int64_t(1) << 60) sums.back().b >>= 2;
    }
    for (int64_t n = 1; n < 2000; ++n) sums.push_back({n * n, 3 * (n - 1) * (n - 1)});
    return sums;
}

TEST(LevelFrame, CoverSqIsTheLargestIntegerBound)
{
    for (const RootSum& sum : someRootSums()) {
        const int64_t coverSq = sum.coverSq();
        ASSERT_TRUE(notAbove(coverSq, sum)) << sum.a << ' ' << sum.b;
        ASSERT_FALSE(notAbove(coverSq + 1, sum)) << sum.a << ' ' << sum.b;
    }
}

TEST(LevelFrame, BoundsOfThreeRootsAreThoseOfTwoWhenOneIsZero)
{
    for (const RootSum& sum : someRootSums()) {
        const int64_t coverSq = sum.coverSq();
        ASSERT_EQ(coverSqOfRoots(sum.a, sum.b, 0), coverSq) << sum.a << ' ' << sum.b;
        ASSERT_EQ(coverSqOfRoots(sum.a, 0, sum.b), coverSq) << sum.a << ' ' << sum.b;
        ASSERT_EQ(coverSqOfRoots(0, sum.a, sum.b), coverSq) << sum.a << ' ' << sum.b;
    }
}

TEST(LevelFrame, BoundsOfThreeRootsAreExactWhereTheSumIs)
{
    // (l + m + n)^2 r is the bound, and one more is not.
    std::mt19937_64 random(2);
    for (int i = 0; i < 100000; ++i) {
        const int64_t r = 1 + int64_t(random() % 1000);
        const int shift = 40 + int(random() % 20);
        const int64_t l = int64_t(random() >> shift), m = int64_t(random() >> shift);
        const int64_t n = int64_t(random() >> shift), sum = l + m + n;
        ASSERT_EQ(coverSqOfRoots(l * l * r, m * m * r, n * n * r), sum * sum * r);
        if (sum == 0) continue;
        ASSERT_LT(coverSqOfRoots(l * l * r - (l > 0), m * m * r - (l == 0 && m > 0),
                      n * n * r - (l == 0 && m == 0)),
            sum * sum * r);
    }
}

TEST(LevelFrame, BoundsOfThreeRootsAgreeWithLongDouble)
{
    std::mt19937_64 random(3);
    for (int i = 0; i < 100000; ++i) {
        const int shift = 36 + int(random() % 20);
        const int64_t a = int64_t(random() >> shift), b = int64_t(random() >> shift);
        const int64_t c = int64_t(random() >> (36 + int(random() % 20)));
        const auto root = [](int64_t x) { return std::sqrt((long double)(x)); };
        const long double sum = root(a) + root(b) + root(c), square = sum * sum;
        if (std::abs(square - std::round(square)) < 1e-6L) continue; // too close to call
        ASSERT_EQ(coverSqOfRoots(a, b, c), int64_t(square)) << a << ' ' << b << ' ' << c;
    }
}

TEST(LevelFrame, RadiiAreNeverBelowTheTrueOnesAndHardlyAbove)
{
    for (const RootSum& sum : someRootSums()) {
        const long double root =
            (std::sqrt((long double)(sum.a)) + std::sqrt((long double)(sum.b))) / 2;
        const long double doubt = root * 0x1p-61L; // of the line above
        ASSERT_GE((long double)(sum.radius()), root - doubt) << sum.a << ' ' << sum.b;
        ASSERT_LE((long double)(sum.radius()), root * (1 + 0x1p-50L)) << sum.a << ' ' << sum.b;
    }
}

TEST(LevelFrame, RadiiThatAreDoublesAreExact)
{
    EXPECT_EQ((RootSum{4, 9}.radius()), 2.5);
    EXPECT_EQ((RootSum{0, 0}.radius()), 0.0);
    EXPECT_EQ((RootSum{int64_t(1) << 60, 1}.radius()), 0x1p29 + 0.5);
}

TEST(LevelFrame, LargeLevelsDoNotOverflow)
{
    const LevelFrame frame(28, Coord(-8, 0, 0), settingsOf({2, 3, 28}));
    const int64_t side = int64_t(1) << 28;
    const Doubled center = frame.center(Coord(0, 0, 0));
    EXPECT_EQ(center.x, side - 17);
    EXPECT_EQ(center.y, side - 1);
    EXPECT_EQ(frame.radius(1).coverSq(), 3 * (side - 1) * (side - 1));
}

TEST(LevelFrame, RejectsALevelWhoseVoxelsAreTooWide)
{
    EXPECT_NO_THROW(LevelFrame(29, kOrigin, settingsOf({2, 3, 29})));
    EXPECT_THROW(LevelFrame(30, kOrigin, settingsOf({2, 3, 30})), openvdb::ValueError);
    EXPECT_THROW(LevelFrame(5, kOrigin, settingsOf({64, 3, 5})), openvdb::ValueError);
    const LevelFrame widest(29, kOrigin, settingsOf({2, 3, 29}, RadiusScale::Paper));
    const double fourRSq = std::pow(2 * widest.radius(1).radius(), 2);
    EXPECT_NEAR(double(widest.radius(1).coverSq()), fourRSq, 1e-9 * fourRSq);
}

TEST(LevelFrame, RejectsBallsOfANormWhoseSquareDoesNotFit)
{
    using openvdb_spheretree::Distance;
    SphereTreeSettings settings = ReversibleOptions();
    settings.pyramid().factor = 2900;
    settings.pyramid().dist = Distance::chamfer(255, 255, 255);
    settings.pyramid().scale = RadiusScale::Paper;
    EXPECT_NO_THROW(LevelFrame(1, kOrigin, settings).radius(255 * 255));
    EXPECT_THROW(LevelFrame(2, kOrigin, settings).radius(255 * 255), openvdb::ValueError);
    settings.pyramid().scale = RadiusScale::Tight; // a single voxel has no width
    EXPECT_NO_THROW(LevelFrame(2, kOrigin, settings).radius(255 * 255));
}

} // namespace
