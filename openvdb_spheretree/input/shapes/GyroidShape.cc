// SPDX-License-Identifier: Apache-2.0
#include "GyroidShape.h"

#include <array>

namespace openvdb_spheretree::detail {

namespace {

using openvdb::Coord;

constexpr int kPeriod = 64;                 ///< voxels
constexpr int kLeaves = kPeriod / kLeafDim; ///< of a period, along an axis
constexpr int kSides = kPeriod + 1;         ///< 0 to kPeriod

/// round(4096 sin(2 pi i / 64)) of the first quarter.
constexpr std::array<int, 17> kQuarterSine{0, 401, 799, 1189, 1567, 1931, 2276, 2598, 2896, 3166,
    3406, 3612, 3784, 3920, 4017, 4076, 4096};

int64_t sine(int i)
{
    const int at = i & (kPeriod - 1), half = at & 31;
    const int value = kQuarterSine[half <= 16 ? half : 32 - half];
    return at < 32 ? value : -value;
}

bool isOnGyroid(const Coord& ijk)
{
    const auto cosine = [](int i) { return sine(i + kPeriod / 4); };
    const int64_t sx = sine(ijk[0]), sy = sine(ijk[1]), sz = sine(ijk[2]);
    const int64_t cx = cosine(ijk[0]), cy = cosine(ijk[1]), cz = cosine(ijk[2]);
    const int64_t f = sx * cy + sy * cz + sz * cx; // below 2^26
    const int64_t gx = cx * cy - sz * sx, gy = cy * cz - sx * sy, gz = cz * cx - sy * sz;
    // The gradient is (gx, gy, gz) 2 pi / 64 a voxel, and (3 * 2 pi / 64)^2 is 88.8 / 1024.
    return 1024 * f * f <= 89 * (gx * gx + gy * gy + gz * gz); // below 2^62
}

/// @return the index in a period of the leaf that holds a voxel.
std::size_t leafInPeriod(const Coord& ijk)
{
    const auto at = [&](int axis) { return ijk[axis] / kLeafDim % kLeaves; };
    return std::size_t((at(0) * kLeaves + at(1)) * kLeaves + at(2));
}

std::size_t indexOfSides(int x, int y, int z) { return std::size_t((x * kSides + y) * kSides + z); }

/// @return by indexOfSides(), how many voxels the box of these sides has at the origin.
std::vector<int> countsOf(const std::vector<LeafMask>& period)
{
    std::vector<int> counts(std::size_t(kSides) * kSides * kSides);
    for (int x = 1; x <= kPeriod; ++x) {
        for (int y = 1; y <= kPeriod; ++y) {
            int row = 0; // voxels of this x and y
            for (int z = 1; z <= kPeriod; ++z) {
                const Coord at(x - 1, y - 1, z - 1);
                row += period[leafInPeriod(at)].isOn(leafIndex(at));
                counts[indexOfSides(x, y, z)] = row + counts[indexOfSides(x - 1, y, z)]
                    + counts[indexOfSides(x, y - 1, z)] - counts[indexOfSides(x - 1, y - 1, z)];
            }
        }
    }
    return counts;
}

} // namespace

GyroidShape::GyroidShape(int64_t voxels) : mPeriod(kLeaves * kLeaves * kLeaves, LeafMask{})
{
    for (const Coord& ijk : openvdb::CoordBBox(Coord(0), Coord(kPeriod - 1))) {
        if (isOnGyroid(ijk)) mPeriod[leafInPeriod(ijk)].setOn(leafIndex(ijk));
    }
    const std::vector<int> counts = countsOf(mPeriod);
    mBox = nearCubeOf(voxels, [&](const Coord& sides) {
        int64_t sum = 0;
        for (int choice = 0; choice < 8; ++choice) { // along each axis: whole periods, or the rest
            int64_t times = 1;
            Coord part;
            for (int axis = 0; axis < 3; ++axis) {
                const bool rest = choice >> axis & 1;
                times *= rest ? 1 : sides[axis] / kPeriod;
                part[axis] = rest ? sides[axis] % kPeriod : kPeriod;
            }
            sum += times * counts[indexOfSides(part[0], part[1], part[2])];
        }
        return sum;
    });
}

LeafMask GyroidShape::leaf(const Coord& origin) const { return mPeriod[leafInPeriod(origin)]; }

} // namespace openvdb_spheretree::detail
