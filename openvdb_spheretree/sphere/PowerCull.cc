// SPDX-License-Identifier: Apache-2.0
#include "PowerCull.h"

#include <algorithm>
#include <cstdlib>

namespace openvdb_spheretree::detail {

namespace {

/// Fewer balls are as soon drawn.
constexpr std::size_t kFew = 8;

/// In units, the largest radius, and the farthest center along an axis: powers are between -3 *
/// 2^58 and 2^58, so they and their differences fit 62 bits.
constexpr int64_t kFarthest = int64_t(1) << 29;

} // namespace

/// @return false if the balls are such that they are left alone.
bool PowerCull::collect(const ClippedSphere* balls, const int32_t origin[3], int32_t size,
    const std::vector<int32_t>& list)
{
    mEntries.clear();
    for (const int32_t index : list) {
        const ClippedSphere& ball = balls[index];
        if (!ball.distance.isEuclidean() || ball.radiusSq > kFarthest * kFarthest) return false;
        Entry entry{ball.radiusSq, {}};
        for (int a = 0; a < 3; ++a) {
            const int64_t middle = 2 * int64_t(origin[a]) + size - 1; // in halves of a voxel
            const int64_t d = ball.center[a] - inUnits(middle, ball.shift - 1);
            if (std::abs(d) > kFarthest) return false;
            entry.center[a] = d;
            entry.power -= d * d;
        }
        mEntries.push_back(entry);
    }
    return true;
}

PowerCull::Champions PowerCull::champions(int64_t reach) const
{
    std::array<int64_t, kPlaces> best;
    best.fill(INT64_MIN);
    Champions result{};
    for (std::size_t i = 0; i < mEntries.size(); ++i) {
        const Entry& entry = mEntries[i];
        const int64_t x = 2 * reach * entry.center[0], y = 2 * reach * entry.center[1],
                      z = 2 * reach * entry.center[2];
        for (std::size_t place = 0; place < kPlaces; ++place) {
            // The power there, but for what is the same for all balls. The center is place 0: it is
            // what exceeded() tries first.
            const std::size_t corner = place - 1;
            const int64_t atCorner =
                (corner & 4 ? x : -x) + (corner & 2 ? y : -y) + (corner & 1 ? z : -z);
            const int64_t there = entry.power + (place == 0 ? 0 : atCorner);
            if (there <= best[place]) continue;
            best[place] = there;
            result[place] = i;
        }
    }
    return result;
}

/// Whether a champion has at least the entry's power in all of the cube. Champions stay, or two
/// that are alike would drop each other.
bool PowerCull::exceeded(std::size_t entry, const Champions& champions, int64_t reach) const
{
    const Entry& own = mEntries[entry];
    for (const std::size_t champion : champions) {
        const Entry& other = mEntries[champion];
        int64_t apart = 0;
        for (int a = 0; a < 3; ++a) apart += std::abs(other.center[a] - own.center[a]);
        if (other.power - own.power < 2 * reach * apart) continue;
        return std::find(champions.begin(), champions.end(), entry) == champions.end();
    }
    return false;
}

void PowerCull::cull(
    const ClippedSphere* balls, const int32_t origin[3], int32_t size, std::vector<int32_t>& list)
{
    if (list.size() <= kFew || !collect(balls, origin, size, list)) return;
    // From the center to the last voxels.
    const int64_t reach = inUnits(size - 1, balls[list[0]].shift - 1);
    const Champions best = champions(reach);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        if (!exceeded(i, best, reach)) list[kept++] = list[i];
    }
    list.resize(kept);
}

} // namespace openvdb_spheretree::detail
