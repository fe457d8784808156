// SPDX-License-Identifier: Apache-2.0
/// @file TestTerrain.cc
/// @brief Generated terrain against the sum of its octaves, and what a sheet must be: whole, and tight.

#include <openvdb_spheretree/base/Hash.h>
#include <openvdb_spheretree/input/shapes/HeightField.h>

#include "support/GeneratedShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;

/// A field's height in doubles, from the same random numbers.
double heightAt(uint64_t seed, int x, int y)
{
    const auto blend = [](double t) { return t * t * (3 - 2 * t); };
    double sum = 0;
    for (int bits = 3; bits <= 7; ++bits) {
        const int dim = 1 << bits, i = int(std::floor(double(x) / dim)),
                  j = int(std::floor(double(y) / dim));
        const auto corner = [&](int di, int dj) {
            const uint64_t place = uint64_t(uint32_t(i + di)) << 32 | uint32_t(j + dj);
            const uint64_t key = detail::hash(detail::hash(seed) + uint64_t(bits));
            return double(detail::hash(key ^ place) >> 52) / 4096;
        };
        const double u = blend(double(x - i * dim) / dim), v = blend(double(y - j * dim) / dim);
        sum += dim / 2
            * ((1 - v) * ((1 - u) * corner(0, 0) + u * corner(1, 0))
                + v * ((1 - u) * corner(0, 1) + u * corner(1, 1)));
    }
    return sum;
}

TEST(HeightField, IsTheSumOfItsOctaves)
{
    for (const uint64_t seed : {1, 7}) {
        const detail::HeightField field(seed);
        for (const int origin : {-200, 0, 1000}) {
            constexpr int kSide = 300;
            const std::vector<int> heights = field.heights(origin, origin + 5, kSide);
            for (int n = 0; n < kSide * kSide; ++n) {
                const double height = heightAt(seed, origin + n / kSide, origin + 5 + n % kSide);
                ASSERT_NEAR(heights[n] + 0.5, height, 1.3) << n << " seed " << seed;
                ASSERT_GE(heights[n], 0);
                ASSERT_LE(heights[n], detail::HeightField::kHighest);
            }
        }
    }
}

TEST(HeightField, IsTheSameThroughAnyWindow)
{
    const detail::HeightField field(3);
    const std::vector<int> all = field.heights(-20, 100, 90);
    for (int n = 0; n < 90 * 90; n += 7) {
        EXPECT_EQ(field.heights(-20 + n / 90, 100 + n % 90, 1).front(), all[n]);
    }
}

TEST(GeneratedTerrain, IsTheSheetAlongItsHeights)
{
    for (const int voxels : {1000, 200000}) {
        const auto grid = made(Shape::Terrain, voxels, 5);
        const Coord sides = boxOf(*grid).extents();
        EXPECT_EQ(sides[0], sides[1]);
        const int side = sides[0], wide = side + 2;
        const std::vector<int> heights = detail::HeightField(5).heights(-1, -1, wide);
        expectRule(*grid, CoordBBox(Coord(0), Coord(side - 1, side - 1, 127)), [&](const Coord& q) {
            const int at = (q[0] + 1) * wide + q[1] + 1;
            int lowest = heights[at];
            for (int dx : {-wide, 0, wide}) {
                for (int dy : {-1, 0, 1}) lowest = std::min(lowest, heights[at + dx + dy]);
            }
            return q[2] >= lowest && q[2] <= heights[at] + 2;
        });
    }
}

/// The voxels that can be reached from @a start by steps to the next one, while @a free.
uint64_t flood(const CoordBBox& box, const Coord& start, bool corners, const Rule& free,
    std::vector<bool>& reached)
{
    const Coord sides = box.extents();
    const auto index = [&](const Coord& q) {
        const Coord at = q - box.min();
        return (std::size_t(at[0]) * sides[1] + at[1]) * sides[2] + at[2];
    };
    reached.assign(box.volume(), false);
    std::vector<Coord> stack{start};
    reached[index(start)] = true;
    uint64_t count = 0;
    const CoordBBox steps(Coord(-1), Coord(1));
    for (; !stack.empty(); ++count) {
        const Coord from = stack.back();
        stack.pop_back();
        for (auto step = steps.begin(); step; ++step) {
            const Coord d = *step, to = from + d;
            if (!corners && std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]) > 1) continue;
            if (!box.isInside(to) || reached[index(to)] || !free(to)) continue;
            reached[index(to)] = true;
            stack.push_back(to);
        }
    }
    return count;
}

TEST(GeneratedTerrain, IsOnePartByFacesAndLetsNothingThroughByCorners)
{
    for (const uint64_t seed : {1, 2, 3}) {
        const auto grid = made(Shape::Terrain, 60000, seed);
        const auto accessor = grid->getConstAccessor();
        CoordBBox box = boxOf(*grid);
        box.min()[2] -= 1;
        box.max()[2] += 1;
        std::vector<bool> reached;
        const Rule on = [&](const Coord& q) { return accessor.isValueOn(q); };
        const Rule off = [&](const Coord& q) { return !accessor.isValueOn(q); };
        const Coord first = grid->tree().cbeginValueOn().getCoord();
        EXPECT_EQ(flood(box, first, false, on, reached), grid->activeVoxelCount());
        flood(box, box.max(), true, off, reached);
        const std::size_t below = 0; // the corner of the box
        EXPECT_FALSE(reached[below]) << "seed " << seed;
        EXPECT_TRUE(reached.back());
    }
}

} // namespace
