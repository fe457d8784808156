// SPDX-License-Identifier: Apache-2.0
#include "MengerShape.h"

#include <algorithm>
#include <array>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

/// How many voxels there are, by the first digits of their coordinates. Bit i of the index is set
/// if the digits along axis i are those of the box's side, so that the next may not be greater.
using PrefixCounts = std::array<int64_t, 8>;

/// @param limit  the next digits of the box's sides
PrefixCounts withNextDigit(const PrefixCounts& before, const std::array<int, 3>& limit)
{
    PrefixCounts after{};
    for (int digits = 0; digits < 27; ++digits) {
        const std::array<int, 3> digit{digits / 9, digits / 3 % 3, digits % 3};
        if (std::count(digit.begin(), digit.end(), 1) > 1) continue;
        for (int tight = 0; tight < 8; ++tight) {
            int still = 0;
            bool beyond = false;
            for (int axis = 0; axis < 3; ++axis) {
                if (!(tight >> axis & 1)) continue;
                beyond = beyond || digit[axis] > limit[axis];
                still |= int(digit[axis] == limit[axis]) << axis;
            }
            if (!beyond) after[still] += before[tight];
        }
    }
    return after;
}

/// @return how many voxels of the sponge lie in the box of these sides, at its corner.
int64_t mengerCount(const Coord& sides)
{
    constexpr int kHighest = 1162261467; // 3^19, the largest power of 3 within 31 bits
    PrefixCounts counts{};
    counts[7] = 1; // no digit yet
    for (int power = kHighest; power > 0; power /= 3) {
        counts = withNextDigit(
            counts, {sides[0] / power % 3, sides[1] / power % 3, sides[2] / power % 3});
    }
    return counts[0]; // below the side along each axis
}

} // namespace

MengerShape::MengerShape(int64_t voxels) : mBox(nearCubeOf(voxels, mengerCount))
{
    const int end = (mBox.max()[0] / kLeafDim + 1) * kLeafDim; // x is the longest side
    mOnes.resize(std::size_t(end), 0);
    for (int i = 1; i < end; ++i) { // the digits of i / 3, and a last one
        mOnes[std::size_t(i)] = mOnes[std::size_t(i / 3)] << 1 | uint32_t(i % 3 == 1);
    }
}

Filling MengerShape::filling(const CoordBBox& cube) const
{
    std::array<uint32_t, 3> common; // digits that are 1 all along the cube
    for (int axis = 0; axis < 3; ++axis) {
        const int last = std::min(cube.max()[axis], mBox.max()[axis]);
        common[axis] = ~uint32_t(0);
        for (int i = cube.min()[axis]; i <= last; ++i) common[axis] &= mOnes[std::size_t(i)];
    }
    const auto [x, y, z] = common;
    return (x & y) | (y & z) | (z & x) ? Filling::None : Filling::Part;
}

LeafMask MengerShape::leaf(const Coord& origin) const
{
    const auto ones = [&](int axis, int i) { return mOnes[std::size_t(origin[axis] + i)]; };
    LeafMask mask{};
    for (int x = 0; x < kLeafDim; ++x) {
        for (int y = 0; y < kLeafDim; ++y) {
            const uint32_t both = ones(0, x) & ones(1, y), any = ones(0, x) | ones(1, y);
            if (both) continue;
            for (int z = 0; z < kLeafDim; ++z) {
                mask[x] |= uint64_t((any & ones(2, z)) == 0) << (8 * y + z);
            }
        }
    }
    return mask;
}

} // namespace openvdb_spheretree::detail
