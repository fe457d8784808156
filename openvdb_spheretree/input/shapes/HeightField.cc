// SPDX-License-Identifier: Apache-2.0
/// Corners have 12 bits and the weight along each axis 8, so a blend has 28 bits. It is halved once
/// for each octave below the largest, so the sum of all is below 2^29. The largest octave is 64
/// voxels high, which are 2^28.
#include "HeightField.h"

#include <openvdb_spheretree/base/Hash.h>

#include <algorithm>

namespace openvdb_spheretree::detail {

namespace {

constexpr int kCornerBits = 12, kWeightBits = 8;
constexpr int kWhole = 1 << kWeightBits;
constexpr int kVoxelBits = kCornerBits + 2 * kWeightBits - 6;

} // namespace

HeightField::HeightField(uint64_t seed) : mKey(hash(seed)), mWeights()
{
    for (int bits = kFewestBits; bits <= kMostBits; ++bits) {
        const int64_t dim = int64_t(1) << bits;
        for (int64_t t = 0; t < dim; ++t) { // 3 (t / dim)^2 - 2 (t / dim)^3, in parts of kWhole
            mWeights[bits][t] = int(t * t * (3 * dim - 2 * t) << kWeightBits >> (3 * bits));
        }
    }
}

int HeightField::corner(int bits, int i, int j) const
{
    const uint64_t place = uint64_t(uint32_t(i)) << 32 | uint32_t(j);
    return int(hash(hash(mKey + uint64_t(bits)) ^ place) >> (64 - kCornerBits));
}

void HeightField::addCell(int bits, int i, int j, const Window& window) const
{
    const int dim = 1 << bits;
    const auto& weights = mWeights[bits];
    const int x1 = std::min((i + 1) * dim, window.x0 + window.side);
    const int y1 = std::min((j + 1) * dim, window.y0 + window.side);
    const int c00 = corner(bits, i, j), c01 = corner(bits, i, j + 1);
    const int c10 = corner(bits, i + 1, j), c11 = corner(bits, i + 1, j + 1);
    for (int x = std::max(i * dim, window.x0); x < x1; ++x) {
        const int w = weights[x - i * dim];
        const int a = c00 * (kWhole - w) + c10 * w, b = c01 * (kWhole - w) + c11 * w;
        int* const row = window.sums.data() + (x - window.x0) * window.side;
        for (int y = std::max(j * dim, window.y0); y < y1; ++y) {
            const int v = weights[y - j * dim];
            row[y - window.y0] += (a * (kWhole - v) + b * v) >> (kMostBits - bits);
        }
    }
}

std::vector<int> HeightField::heights(int x0, int y0, int side) const
{
    std::vector<int> sums(std::size_t(side) * std::size_t(side), 0);
    const Window window{x0, y0, side, sums};
    for (int bits = kFewestBits; bits <= kMostBits; ++bits) {
        for (int i = x0 >> bits; i <= (x0 + side - 1) >> bits; ++i) {
            for (int j = y0 >> bits; j <= (y0 + side - 1) >> bits; ++j) addCell(bits, i, j, window);
        }
    }
    for (int& sum : sums) sum >>= kVoxelBits;
    return sums;
}

} // namespace openvdb_spheretree::detail
