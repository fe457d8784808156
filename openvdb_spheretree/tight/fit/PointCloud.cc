// SPDX-License-Identifier: Apache-2.0
#include "PointCloud.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/tight/fit/PointCloud.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::tight {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// @param axes  x, y, z, and radii or null
/// @return the squared radii that balls around (x, y, z) need for the points from @a i on.
template <class D, class V = hn::VFromD<D>>
HWY_INLINE V neededSq(D d, const float* const axes[4], std::size_t i, V x, V y, V z)
{
    const V dx = hn::Sub(hn::LoadU(d, axes[0] + i), x);
    const V dy = hn::Sub(hn::LoadU(d, axes[1] + i), y);
    const V dz = hn::Sub(hn::LoadU(d, axes[2] + i), z);
    const V square = hn::Add(hn::Mul(dx, dx), hn::Add(hn::Mul(dy, dy), hn::Mul(dz, dz)));
    if (!axes[3]) return square;
    const V far = hn::Add(hn::Sqrt(square), hn::LoadU(d, axes[3] + i));
    return hn::Mul(far, far);
}

/// @param count  a multiple of kPadding
/// @param at     the point from which to measure
PointCloud::Farthest farthestOf(const float* const axes[4], std::size_t count, const float at[3])
{
    const hn::CappedTag<float, 16> d;
    const hn::RebindToSigned<decltype(d)> di;
    const auto x = hn::Set(d, at[0]), y = hn::Set(d, at[1]), z = hn::Set(d, at[2]);
    auto most = hn::Set(d, -1.0f);
    auto where = hn::Zero(di);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        const auto square = neededSq(d, axes, i, x, y, z);
        const auto farther = hn::Gt(square, most);
        most = hn::IfThenElse(farther, square, most);
        where = hn::IfThenElse(hn::RebindMask(di, farther), hn::Iota(di, int32_t(i)), where);
    }
    const auto best = hn::MaxOfLanes(d, most);
    const auto isBest = hn::RebindMask(di, hn::Eq(most, best));
    const auto first = hn::MinOfLanes(di, hn::IfThenElse(isBest, where, hn::Set(di, INT32_MAX)));
    return {std::size_t(hn::GetLane(first)), hn::GetLane(best)};
}

float farthestSqOf(const float* const axes[4], std::size_t count, const float at[3])
{
    const hn::CappedTag<float, 16> d;
    const auto x = hn::Set(d, at[0]), y = hn::Set(d, at[1]), z = hn::Set(d, at[2]);
    auto most = hn::Set(d, -1.0f);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
        most = hn::Max(most, neededSq(d, axes, i, x, y, z));
    }
    return hn::GetLane(hn::MaxOfLanes(d, most));
}

} // namespace HWY_NAMESPACE
} // namespace openvdb_spheretree::tight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace openvdb_spheretree::tight {

HWY_EXPORT(farthestOf);
HWY_EXPORT(farthestSqOf);

constexpr std::size_t kPadding = 16;

void PointCloud::add(float x, float y, float z, float radius)
{
    if (mCount == 0) {
        for (auto& axis : mAxis) axis.clear();
        mHasRadii = false;
    }
    const float values[4] = {x, y, z, radius};
    for (int a = 0; a < 4; ++a) mAxis[a].push_back(values[a]);
    mHasRadii = mHasRadii || radius > 0;
    ++mCount;
}

void PointCloud::finish()
{
    for (auto& axis : mAxis) {
        const float first = mCount > 0 ? axis.front() : 0;
        axis.resize((mCount + kPadding - 1) / kPadding * kPadding, first);
    }
}

PointCloud::Farthest PointCloud::farthest(float x, float y, float z) const
{
    const float at[3] = {x, y, z};
    return HWY_DYNAMIC_DISPATCH(farthestOf)(axes().data(), mAxis[0].size(), at);
}

float PointCloud::farthestSq(float x, float y, float z) const
{
    const float at[3] = {x, y, z};
    return HWY_DYNAMIC_DISPATCH(farthestSqOf)(axes().data(), mAxis[0].size(), at);
}

std::array<const float*, 4> PointCloud::axes() const
{
    return {
        mAxis[0].data(), mAxis[1].data(), mAxis[2].data(), mHasRadii ? mAxis[3].data() : nullptr};
}

} // namespace openvdb_spheretree::tight

#endif // HWY_ONCE
