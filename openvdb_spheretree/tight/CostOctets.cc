// SPDX-License-Identifier: Apache-2.0
#include "CostOctets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/tight/CostOctets.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#ifndef OPENVDB_SPHERETREE_TIGHT_COST_OCTETS_ONCE
#define OPENVDB_SPHERETREE_TIGHT_COST_OCTETS_ONCE
namespace openvdb_spheretree {
namespace tight {

constexpr std::size_t kBlock = 32; // octets; a multiple of the lanes of every target

struct OctetArrays {
    const float *x, *y, *z;
    const int32_t* bits;
};

} // namespace tight
} // namespace openvdb_spheretree
#endif

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree {
namespace tight {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// @param octets  readable for kBlock more, which have no bits
/// @param bound   stop when there are more, after every block
int64_t countInBall(
    const OctetArrays& octets, std::size_t count, const LocalBall& ball, int64_t bound)
{
    const hn::CappedTag<float, 16> d;
    const hn::RebindToSigned<decltype(d)> di;
    const hn::RebindToUnsigned<decltype(d)> du;
    const auto x = hn::Set(d, ball.x), y = hn::Set(d, ball.y), z = hn::Set(d, ball.z);
    const auto radiusSq = hn::Set(d, ball.radiusSq);
    const auto none = hn::Zero(di), all = hn::Set(di, 8), one = hn::Set(di, 1);
    int64_t sum = 0;
    for (std::size_t begin = 0; begin < count && sum <= bound; begin += kBlock) {
        auto counts = hn::Zero(du);
        for (std::size_t i = begin; i < begin + kBlock; i += hn::Lanes(d)) {
            const auto dx = hn::Sub(hn::LoadU(d, octets.x + i), x);
            const auto dy = hn::Sub(hn::LoadU(d, octets.y + i), y);
            const auto dz = hn::Sub(z, hn::LoadU(d, octets.z + i));
            const auto left = hn::Sub(radiusSq, hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)));
            const auto half = hn::Floor(hn::Sqrt(hn::Max(left, hn::Zero(d))));
            const auto from = hn::ConvertTo(di, hn::Sub(dz, half));
            const auto to = hn::ConvertTo(di, hn::Add(dz, half));
            const auto first = hn::ShiftRight<4>(hn::Add(from, hn::Set(di, 15)));
            const auto beyond = hn::Add(hn::ShiftRight<4>(to), one);
            const auto lo = hn::Max(none, hn::Min(first, all));
            const auto hi = hn::Max(lo, hn::Min(beyond, all));
            const auto mask = hn::Sub(hn::Shl(one, hi), hn::Shl(one, lo));
            const auto meets = hn::RebindMask(di, hn::Ge(left, hn::Zero(d)));
            const auto held =
                hn::IfThenElseZero(meets, hn::And(mask, hn::LoadU(di, octets.bits + i)));
            counts = hn::Add(counts, hn::PopulationCount(hn::BitCast(du, held)));
        }
        sum += int64_t(hn::GetLane(hn::SumOfLanes(du, counts)));
    }
    return sum;
}

} // namespace HWY_NAMESPACE
} // namespace tight
} // namespace openvdb_spheretree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace openvdb_spheretree {
namespace tight {

HWY_EXPORT(countInBall);

float CostOctets::reachSq(const LocalBall& ball) const
{
    const float x = ball.x - mPlace.x, y = ball.y - mPlace.y, z = ball.z - mPlace.z;
    const float reach = std::sqrt(x * x + y * y + z * z) + std::sqrt(ball.radiusSq);
    return reach * reach;
}

void CostOctets::collect(const CostWindow& window, const LocalBall& place)
{
    mPlace = place;
    mShellsPerSq = float(kShells) / std::max(1.0f, place.radiusSq); // a point is a place, too
    mFound.clear();
    window.collect(place, mFound);
    std::array<uint32_t, kShells> sizes{};
    for (const Octet& octet : mFound) ++sizes[shellOf(octet.distanceSq)];
    mShellBegin[0] = 0;
    for (int s = 0; s < kShells; ++s) mShellBegin[s + 1] = mShellBegin[s] + sizes[s];

    const std::size_t size = mFound.size() + kBlock;
    if (mBits.size() < size) {
        for (auto* axis : {&mX, &mY, &mZ}) axis->resize(size, 0.0f);
        mBits.resize(size);
    }
    std::fill_n(mBits.begin() + std::ptrdiff_t(mFound.size()), kBlock, 0);
    auto next = mShellBegin;
    for (const Octet& octet : mFound) {
        const uint32_t i = next[shellOf(octet.distanceSq)]++;
        mX[i] = octet.x;
        mY[i] = octet.y;
        mZ[i] = octet.z;
        mBits[i] = octet.bits;
    }
}

int64_t CostOctets::count(const LocalBall& ball, int64_t bound) const
{
    const std::size_t within = mShellBegin[shellOf(reachSq(ball)) + 1];
    const OctetArrays octets{mX.data(), mY.data(), mZ.data(), mBits.data()};
    return HWY_DYNAMIC_DISPATCH(countInBall)(octets, within, ball, bound);
}

} // namespace tight
} // namespace openvdb_spheretree

#endif // HWY_ONCE
