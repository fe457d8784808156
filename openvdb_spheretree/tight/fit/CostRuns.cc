// SPDX-License-Identifier: Apache-2.0
#include "CostRuns.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/tight/fit/CostRuns.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::tight {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// @param runs   readable for kRunsAtOnce more, which have no samples
/// @param bound  stop when there are more, after every kRunsAtOnce
int64_t countInBall(const RunArrays& runs, std::size_t count, const LocalBall& ball, int64_t bound)
{
    const hn::CappedTag<float, 16> d;
    const hn::RebindToSigned<decltype(d)> di;
    const auto x = hn::Set(d, ball.x), y = hn::Set(d, ball.y), z = hn::Set(d, ball.z);
    const auto radiusSq = hn::Set(d, ball.radiusSq);
    const auto none = hn::Zero(di), one = hn::Set(di, 1), up = hn::Set(di, 15);
    int64_t sum = 0;
    for (std::size_t begin = 0; begin < count && sum <= bound; begin += kRunsAtOnce) {
        auto counts = none;
        for (std::size_t i = begin; i < begin + kRunsAtOnce; i += hn::Lanes(d)) {
            const auto dx = hn::Sub(hn::LoadU(d, runs.x + i), x);
            const auto dy = hn::Sub(hn::LoadU(d, runs.y + i), y);
            const auto left = hn::Sub(radiusSq, hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy)));
            const auto half = hn::Floor(hn::Sqrt(hn::Max(left, hn::Zero(d))));
            const auto from = hn::ConvertTo(di, hn::Sub(z, half));
            const auto to = hn::ConvertTo(di, hn::Add(z, half));
            const auto first =
                hn::Max(hn::ShiftRight<4>(hn::Add(from, up)), hn::LoadU(di, runs.first + i));
            const auto last = hn::Min(hn::ShiftRight<4>(to), hn::LoadU(di, runs.last + i));
            const auto held = hn::Max(none, hn::Add(hn::Sub(last, first), one));
            const auto meets = hn::RebindMask(di, hn::Ge(left, hn::Zero(d)));
            counts = hn::Add(counts, hn::IfThenElseZero(meets, held));
        }
        sum += int64_t(hn::GetLane(hn::SumOfLanes(di, counts)));
    }
    return sum;
}

} // namespace HWY_NAMESPACE
} // namespace openvdb_spheretree::tight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace openvdb_spheretree::tight {

HWY_EXPORT(countInBall);

float CostRuns::reachSq(const LocalBall& ball) const
{
    const float x = ball.x - mPlace.x, y = ball.y - mPlace.y, z = ball.z - mPlace.z;
    const float reach = std::sqrt(x * x + y * y + z * z) + std::sqrt(ball.radiusSq);
    return reach * reach;
}

void CostRuns::collect(const CostWindow& window, const LocalBall& place)
{
    mPlace = place;
    mShellsPerSq = float(kShells) / std::max(1.0f, place.radiusSq); // a point is a place, too
    mFound.clear();
    window.collect(place, mFound);
    std::array<uint32_t, kShells> sizes{};
    for (const CostRun& run : mFound) ++sizes[shellOf(run.distanceSq)];
    mShellBegin[0] = 0;
    for (int s = 0; s < kShells; ++s) mShellBegin[s + 1] = mShellBegin[s] + sizes[s];

    const std::size_t size = mFound.size() + kRunsAtOnce;
    if (mX.size() < size) {
        for (auto* axis : {&mX, &mY}) axis->resize(size, 0.0f);
        for (auto* samples : {&mFirst, &mLast}) samples->resize(size);
    }
    std::fill_n(mFirst.begin() + std::ptrdiff_t(mFound.size()), kRunsAtOnce, 0);
    std::fill_n(mLast.begin() + std::ptrdiff_t(mFound.size()), kRunsAtOnce, -1);
    auto next = mShellBegin;
    for (const CostRun& run : mFound) {
        const uint32_t i = next[shellOf(run.distanceSq)]++;
        mX[i] = run.x;
        mY[i] = run.y;
        mFirst[i] = run.first;
        mLast[i] = run.last;
    }
}

int64_t CostRuns::count(const LocalBall& ball, int64_t bound) const
{
    constexpr float kRounding = 1.0001f; // or the last sample of a ball may seem out of its reach
    const std::size_t within = mShellBegin[shellOf(reachSq(ball) * kRounding) + 1];
    const RunArrays runs{mX.data(), mY.data(), mFirst.data(), mLast.data()};
    return HWY_DYNAMIC_DISPATCH(countInBall)(runs, within, ball, bound);
}

} // namespace openvdb_spheretree::tight

#endif // HWY_ONCE
