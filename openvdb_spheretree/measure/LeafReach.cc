// SPDX-License-Identifier: Apache-2.0
#include "LeafReach.h"

#include <openvdb_spheretree/voxel/NearestBit.h>

#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <optional>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Coord;
using openvdb::MaskTree;

constexpr uint64_t kEveryByte = 0x0101010101010101u;

/// Bytes of which the upper n bits are on, or the lower ones.
constexpr uint64_t upper(int n) { return kEveryByte * (0xffu & (0xff00u >> n)); }
constexpr uint64_t lower(int n) { return kEveryByte * (0xffu & ~(0xffu << n)); }

/// @return the origin of the leaf so many leaves away; none beyond the ends of coordinates.
std::optional<Coord> leafBeside(const Coord& origin, int dx, int dy, int dz)
{
    const int64_t at[3] = {
        int64_t(origin[0]) + 8 * dx, int64_t(origin[1]) + 8 * dy, int64_t(origin[2]) + 8 * dz};
    for (const int64_t c : at) {
        if (c != int32_t(c)) return std::nullopt;
    }
    return Coord(int32_t(at[0]), int32_t(at[1]), int32_t(at[2]));
}

} // namespace

/// The rows that the ball reaches, for as long as distance and limit stay the same.
void LeafReach::order(const Distance& distance, int64_t limitSq)
{
    limitSq = std::min(limitSq, distance.lengthSq(kReach + 1, 0, 0) - 1);
    if (limitSq == mLimitSq && distance == mDistance) return;
    mLimitSq = limitSq;
    mDistance = distance;
    mOffsets.clear();
    for (int dx = -kReach; dx <= kReach; ++dx) {
        for (int dy = -kReach; dy <= kReach; ++dy) {
            const int64_t reach = distance.reach(dx, dy, limitSq);
            if (reach < 0) continue;
            // A norm may leave z free where another coordinate is larger.
            mOffsets.push_back({dx, dy, int(std::min<int64_t>(reach, kReach))});
        }
    }
    std::sort(mOffsets.begin(), mOffsets.end(), [&](const Offset& a, const Offset& b) {
        return a.dx * a.dx + a.dy * a.dy < b.dx * b.dx + b.dy * b.dy;
    });
}

/// @return whether the object has anything around.
bool LeafReach::gather(const MaskTree& object, const Coord& origin)
{
    const openvdb::tree::ValueAccessor<const MaskTree, false> accessor(object);
    Rows* const planes[3] = {&mBelow, &mMiddle, &mAbove};
    mOrigin = origin;
    bool any = false;
    for (int n = 0; n < 27; ++n) {
        const int x = n / 9, y = n / 3 % 3, z = n % 3;
        const std::optional<Coord> at = leafBeside(origin, x - 1, y - 1, z - 1);
        const MaskTree::LeafNodeType* leaf = at ? accessor.probeConstLeaf(*at) : nullptr;
        const uint64_t tile = at && !leaf && accessor.isValueOn(*at) ? ~uint64_t(0) : 0;
        any = any || leaf || tile;
        for (int i = 0; i < 8; ++i) {
            const uint64_t word = leaf ? leaf->getValueMask().getWord<uint64_t>(i) : tile;
            (*planes[z])[kSide / 8 * (8 * x + i) + y] = word;
        }
    }
    return any;
}

void LeafReach::widen()
{
    const int far = mOffsets.front().reach;
    std::copy(mMiddle, mMiddle + kRows / 8, mWidened[0]);
    for (int n = 1; n <= far; ++n) {
        const uint64_t up = upper(8 - n), down = lower(8 - n), in = lower(n), out = upper(n);
        for (int i = 0; i < kRows / 8; ++i) {
            const uint64_t towardsUp =
                n == 8 ? mBelow[i] : (mMiddle[i] << n & up) | (mBelow[i] >> (8 - n) & in);
            const uint64_t towardsDown =
                n == 8 ? mAbove[i] : (mMiddle[i] >> n & down) | (mAbove[i] << (8 - n) & out);
            mWidened[n][i] = mWidened[n - 1][i] | towardsUp | towardsDown;
        }
    }
}

void LeafReach::takeNear(const MaskTree& object, const Distance& distance, int64_t limitSq,
    const Coord& origin, LeafMask& mask)
{
    order(distance, limitSq);
    if (!gather(object, origin) || limitSq < 0) return;
    widen();
    LeafMask left = mask;
    for (const Offset& offset : mOffsets) {
        uint64_t any = 0;
        for (int x = 0; x < 8; ++x) {
            uint64_t slice; // eight rows along y
            const int row = kSide * (kReach + x + offset.dx) + kReach + offset.dy;
            const auto* rows = reinterpret_cast<const char*>(mWidened[offset.reach]);
            std::memcpy(&slice, rows + row, sizeof(slice));
            left[x] &= ~slice;
            any |= left[x];
        }
        if (!any) break;
    }
    mask = left;
}

/// @return the 24 voxels of a row along z, from kReach below the leaf.
uint32_t LeafReach::column(int row) const
{
    uint32_t bits = 0;
    const Rows* const planes[3] = {&mBelow, &mMiddle, &mAbove};
    for (int z = 0; z < 3; ++z) {
        bits |= uint32_t((*planes[z])[row / 8] >> (8 * (row % 8)) & 0xff) << (8 * z);
    }
    return bits;
}

int64_t LeafReach::nearest(const Coord& voxel, Coord& nearest) const
{
    const Coord at = voxel - mOrigin;
    const int64_t beyond = mDistance.lengthSq(kReach + 1, 0, 0);
    int64_t best = beyond;
    // In squares around the voxel, each a ring of rows.
    for (int ring = 0; ring <= kReach && mDistance.lengthSq(ring, 0, 0) < best; ++ring) {
        for (int dx = -ring; dx <= ring; ++dx) {
            const int step = std::abs(dx) == ring ? 1 : 2 * ring;
            for (int dy = -ring; dy <= ring; dy += step) {
                if (mDistance.lengthSq(dx, dy, 0) >= best) continue;
                const uint32_t bits = column(kSide * (kReach + at[0] + dx) + kReach + at[1] + dy);
                if (bits == 0) continue;
                const int z = nearestBit(bits, 2 * (kReach + at[2])) - kReach;
                const int64_t distSq = mDistance.lengthSq(dx, dy, z - at[2]);
                if (distSq >= best) continue;
                best = distSq;
                nearest = mOrigin.offsetBy(at[0] + dx, at[1] + dy, z);
            }
        }
    }
    return best < beyond ? best : -1;
}

} // namespace openvdb_spheretree::detail
