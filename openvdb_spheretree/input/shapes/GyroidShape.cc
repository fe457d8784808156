// SPDX-License-Identifier: Apache-2.0
#include "GyroidShape.h"

#include "NearCube.h"

#include <array>

namespace openvdb_spheretree {
namespace detail {

namespace {

using openvdb::Coord;

constexpr int kLeaves = kGyroidPeriod / kLeafDim; ///< of a period, along an axis

/// round(4096 sin(2 pi i / 64)) of the first quarter.
constexpr std::array<int, 17> kQuarterSine{0, 401, 799, 1189, 1567, 1931, 2276, 2598, 2896, 3166,
    3406, 3612, 3784, 3920, 4017, 4076, 4096};

int64_t sine(int i)
{
    const int at = i & (kGyroidPeriod - 1), half = at & 31;
    const int value = kQuarterSine[half <= 16 ? half : 32 - half];
    return at < 32 ? value : -value;
}

int64_t cosine(int i) { return sine(i + kGyroidPeriod / 4); }

/// How many voxels of the gyroid lie in a box that starts at the origin.
class GyroidCounts {
public:
    explicit GyroidCounts(const std::vector<LeafMask>& period)
        : mCounts(std::size_t(kSide) * kSide * kSide)
    {
        for (int x = 1; x < kSide; ++x) {
            for (int y = 1; y < kSide; ++y) {
                int row = 0; // voxels of this x and y
                for (int z = 1; z < kSide; ++z) {
                    const Coord at(x - 1, y - 1, z - 1);
                    const int leaf =
                        ((at[0] >> 3) * kLeaves + (at[1] >> 3)) * kLeaves + (at[2] >> 3);
                    row += period[std::size_t(leaf)].isOn(leafIndex(at));
                    count(x, y, z) =
                        row + count(x - 1, y, z) + count(x, y - 1, z) - count(x - 1, y - 1, z);
                }
            }
        }
    }

    int64_t inBox(const Coord& sides) const
    {
        int64_t sum = 0;
        for (int choice = 0; choice < 8; ++choice) { // along each axis: whole periods, or the rest
            int64_t times = 1;
            Coord part;
            for (int axis = 0; axis < 3; ++axis) {
                const bool rest = choice >> axis & 1;
                times *= rest ? 1 : sides[axis] / kGyroidPeriod;
                part[axis] = rest ? sides[axis] % kGyroidPeriod : kGyroidPeriod;
            }
            sum += times * mCounts[index(part[0], part[1], part[2])];
        }
        return sum;
    }

private:
    static constexpr int kSide = kGyroidPeriod + 1;
    static std::size_t index(int x, int y, int z)
    {
        return std::size_t((x * kSide + y) * kSide + z);
    }
    int& count(int x, int y, int z) { return mCounts[index(x, y, z)]; }

    std::vector<int> mCounts; ///< in the box of sides x, y, z of the period
};

std::vector<LeafMask> onePeriod()
{
    std::vector<LeafMask> leaves(std::size_t(kLeaves) * kLeaves * kLeaves, LeafMask{});
    for (uint32_t leaf = 0; leaf < leaves.size(); ++leaf) {
        const Coord origin(leaf / 64 * 8, leaf / 8 % 8 * 8, leaf % 8 * 8);
        for (uint32_t n = 0; n < kLeafVoxels; ++n) {
            const bool on = isOnGyroid(origin.offsetBy(n >> 6, n >> 3 & 7, n & 7));
            leaves[leaf][n >> 6] |= uint64_t(on) << (n & 63);
        }
    }
    return leaves;
}

} // namespace

bool isOnGyroid(const Coord& ijk)
{
    const int64_t sx = sine(ijk[0]), sy = sine(ijk[1]), sz = sine(ijk[2]);
    const int64_t cx = cosine(ijk[0]), cy = cosine(ijk[1]), cz = cosine(ijk[2]);
    const int64_t f = sx * cy + sy * cz + sz * cx; // below 2^26
    const int64_t gx = cx * cy - sz * sx, gy = cy * cz - sx * sy, gz = cz * cx - sy * sz;
    // The gradient is (gx, gy, gz) 2 pi / 64 a voxel, and (3 * 2 pi / 64)^2 is 88.8 / 1024.
    return 1024 * f * f <= 89 * (gx * gx + gy * gy + gz * gz); // below 2^62
}

GyroidShape::GyroidShape(int64_t voxels) : mPeriod(onePeriod())
{
    const GyroidCounts counts(mPeriod);
    mBox = boxOfSides(nearCubeOf(voxels, [&](const Coord& sides) { return counts.inBox(sides); }));
}

LeafMask GyroidShape::leaf(const Coord& origin) const
{
    const auto at = [&](int axis) { return origin[axis] / kLeafDim % kLeaves; };
    return mPeriod[std::size_t((at(0) * kLeaves + at(1)) * kLeaves + at(2))];
}

} // namespace detail
} // namespace openvdb_spheretree
