// SPDX-License-Identifier: Apache-2.0
/// @file TestRounding.cc
/// @brief Every result is the smallest number of its type that is not below the true value: checked
/// in 128-bit integers, which hold the true values of products, squares and conversions.

#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/base/Rounding.h>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace openvdb_spheretree::detail;
using Wide = __int128;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kTrials = 200000;

double before(double x) { return std::nextafter(x, -kInfinity); }

/// An integer of up to @a bits bits; small ones are as frequent as large ones.
int64_t randomInteger(std::mt19937_64& random, int bits)
{
    const int wanted = 1 + int(random() % uint64_t(bits));
    return int64_t(random() >> (64 - wanted));
}

TEST(RoundUp, AddsExactlyWhereTheSumIsADouble)
{
    EXPECT_EQ(addUp(1.5, 2.25), 3.75);
    EXPECT_EQ(addUp(0, 0), 0);
    EXPECT_EQ(addUp(0x1p53, 2), 0x1p53 + 2);
    EXPECT_EQ(addUp(1e300, -1e300), 0);
}

TEST(RoundUp, AddsUpwardsWhereSomethingGetsLost)
{
    EXPECT_EQ(addUp(1, 0x1p-60), nextUp(1));
    EXPECT_EQ(addUp(0x1p-60, 1), nextUp(1));
    EXPECT_EQ(addUp(0x1p53, 1), 0x1p53 + 2);
    EXPECT_EQ(addUp(1, -0x1p-60), 1);
}

TEST(RoundUp, SumsAreTheSmallestDoubleNotBelow)
{
    std::mt19937_64 random(1);
    for (int i = 0; i < kTrials; ++i) {
        // Multiples of one unit: their sum is an integer of that unit.
        const int64_t m = randomInteger(random, 53), n = randomInteger(random, 53);
        const int shift = int(random() % 40);
        const double a = double(m), b = std::ldexp(double(n), shift);
        const Wide sum = m + (Wide(n) << shift);
        const double up = addUp(a, b);
        ASSERT_GE(Wide(up), sum) << a << " + " << b;
        if (up > 0) {
            ASSERT_LT(Wide(before(up)), sum) << a << " + " << b;
        }
        ASSERT_EQ(addUp(b, a), up);
    }
}

TEST(RoundUp, ProductsAreTheSmallestDoubleNotBelow)
{
    EXPECT_EQ(multiplyUp(0.5, 7), 3.5);
    std::mt19937_64 random(2);
    for (int i = 0; i < kTrials; ++i) {
        const int64_t m = 1 + randomInteger(random, 52), n = 1 + randomInteger(random, 52);
        const double up = multiplyUp(double(m), double(n));
        ASSERT_GE(Wide(up), Wide(m) * n) << m << " * " << n;
        ASSERT_LT(Wide(before(up)), Wide(m) * n) << m << " * " << n;
    }
}

/// x as an integer times 2^-shift, with shift = 52 - ilogb(x).
Wide mantissa(double x, int shift) { return Wide(std::ldexp(x, shift)); }

TEST(RoundUp, QuotientsAreTheSmallestDoubleNotBelow)
{
    EXPECT_EQ(divideUp(3.5, 7), 0.5);
    std::mt19937_64 random(8);
    for (int i = 0; i < kTrials; ++i) {
        const int64_t m = 1 + randomInteger(random, 52), n = 1 + randomInteger(random, 52);
        const double up = divideUp(double(m), double(n));
        const int shift = 52 - std::ilogb(up);
        const Wide quotient = mantissa(up, shift), exact = Wide(m) << shift; // times n, below 2^106
        ASSERT_GE(quotient * n, exact) << m << " / " << n;
        ASSERT_LT((quotient - 1) * n, exact) << m << " / " << n;
    }
}

TEST(RoundUp, RootsAreTheSmallestDoubleNotBelow)
{
    std::mt19937_64 random(3);
    for (int i = 0; i < kTrials; ++i) {
        const int64_t x = 1 + randomInteger(random, 52);
        const double up = sqrtUp(double(x));
        const int shift = 52 - std::ilogb(up);
        const Wide square = Wide(x) << (2 * shift);
        ASSERT_GE(mantissa(up, shift) * mantissa(up, shift), square) << x;
        const Wide low = mantissa(up, shift) - 1;
        ASSERT_LT(low * low, square) << x;
    }
}

TEST(RoundUp, RootsOfSquaresAreExact)
{
    for (int64_t n = 0; n < 100000; n += 7) EXPECT_EQ(sqrtUp(double(n * n)), double(n));
    EXPECT_EQ(sqrtUp(0.25), 0.5);
}

TEST(RoundUp, IntegersBecomeTheSmallestDoubleNotBelow)
{
    std::mt19937_64 random(4);
    for (int i = 0; i < kTrials; ++i) {
        const int64_t sign = random() % 2 ? 1 : -1, x = sign * randomInteger(random, 63);
        const double up = toDoubleUp(x);
        ASSERT_GE(Wide(up), Wide(x));
        ASSERT_TRUE(up == double(x) || Wide(double(x)) < x) << x;
        ASSERT_LE(up, nextUp(double(x)));
        if (std::abs(x) <= int64_t(1) << 53) {
            ASSERT_EQ(Wide(up), Wide(x));
        }
    }
    EXPECT_EQ(toDoubleUp((int64_t(1) << 53) + 1), 0x1p53 + 2);
    const volatile int64_t most = std::numeric_limits<int64_t>::max(); // not known to the compiler
    EXPECT_EQ(toDoubleUp(most), 0x1p63);
    EXPECT_EQ(toDoubleUp(std::numeric_limits<int64_t>::min()), -0x1p63);
}

TEST(RoundUp, DoublesBecomeTheSmallestFloatNotBelow)
{
    std::mt19937_64 random(5);
    for (int i = 0; i < kTrials; ++i) {
        const double x = std::ldexp(double(randomInteger(random, 53)), int(random() % 60) - 70);
        const float up = toFloatUp(x);
        ASSERT_GE(double(up), x);
        ASSERT_TRUE(x == 0 || double(std::nextafter(up, -1.0f)) < x) << x;
    }
    EXPECT_EQ(toFloatUp(1.5), 1.5f);
    EXPECT_EQ(toFloatUp(0), 0.0f);
    EXPECT_EQ(toFloatUp(16777217), 16777218.0f);
    EXPECT_EQ(toFloatUp(1e300), std::numeric_limits<float>::infinity());
}

TEST(RoundUp, IntegerRootIsTheLargestWhoseSquareIsNotAbove)
{
    using Unsigned = unsigned __int128;
    std::mt19937_64 random(6);
    for (int i = 0; i < kTrials; ++i) {
        const int64_t n = 1 + randomInteger(random, 61);
        const Unsigned square = Unsigned(n) * Unsigned(n);
        ASSERT_EQ(floorSqrtWide(square), n);
        ASSERT_EQ(floorSqrtWide(square - 1), n - 1);
        ASSERT_EQ(floorSqrtWide(square + Unsigned(n) + Unsigned(n)), n);
        ASSERT_EQ(floorSqrtWide(square + Unsigned(n) + Unsigned(n) + 1), n + 1);
    }
    EXPECT_EQ(floorSqrtWide(0), 0);
}

TEST(RoundUp, RootsOfIntegersLieOnBothSidesOfTheTrueOne)
{
    std::mt19937_64 random(9);
    for (int i = 0; i < kTrials; ++i) {
        const int64_t n = 2 + randomInteger(random, 31), nSq = n * n;
        for (const int64_t root : {floorSqrt(nSq), ceilSqrt(nSq), ceilSqrt(nSq - 1)}) {
            ASSERT_EQ(root, n);
        }
        ASSERT_EQ(floorSqrt(nSq - 1), n - 1);
        ASSERT_EQ(floorSqrt(nSq + 2 * n), n);
        ASSERT_EQ(ceilSqrt(nSq + 1), n + 1);
    }
}

TEST(RoundDown, NeverComesOutAboveAndIsNextToTheTrueValue)
{
    std::mt19937 random(5);
    for (int i = 0; i < 100000; ++i) {
        const double a = double(random()), b = double(random()); // their product has 64 bits
        const auto product = (long double)(a) * (long double)(b);
        EXPECT_LE((long double)(multiplyDown(a, b)), product);
        EXPECT_GT((long double)(std::nextafter(multiplyDown(a, b), INFINITY)), product);
        const double root = sqrtDown(a);
        EXPECT_LE((long double)(root) * (long double)(root), (long double)(a));
        EXPECT_LE(double(toFloatDown(b / 3)), b / 3);
        EXPECT_GT(double(std::nextafter(toFloatDown(b / 3), INFINITY)), b / 3);
    }
    EXPECT_EQ(sqrtDown(0), 0);
    EXPECT_EQ(sqrtDown(1 << 20), 1 << 10);
    EXPECT_EQ(toFloatDown(0.5), 0.5f);
    EXPECT_EQ(toFloatDown(1e39), INFINITY);
}

} // namespace
