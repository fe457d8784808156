// SPDX-License-Identifier: Apache-2.0
#include "PointCloud.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/tight/PointCloud.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree {
namespace tight {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// @param axes  x, y, z, and radii or null; `count` is a multiple of kPadding
/// @param at    the point from which to measure
PointCloud::Farthest farthestOf(const float* const axes[4], std::size_t count, const float at[3])
{
    const hn::CappedTag<float, 16> d;
    const hn::RebindToSigned<decltype(d)> di;
    const std::size_t lanes = hn::Lanes(d);
    const auto x = hn::Set(d, at[0]), y = hn::Set(d, at[1]), z = hn::Set(d, at[2]);
    auto most = hn::Set(d, -1.0f);
    auto where = hn::Zero(di);
    for (std::size_t i = 0; i < count; i += lanes) {
        const auto dx = hn::Sub(hn::LoadU(d, axes[0] + i), x);
        const auto dy = hn::Sub(hn::LoadU(d, axes[1] + i), y);
        const auto dz = hn::Sub(hn::LoadU(d, axes[2] + i), z);
        auto square = hn::Add(hn::Mul(dx, dx), hn::Add(hn::Mul(dy, dy), hn::Mul(dz, dz)));
        if (axes[3]) {
            const auto far = hn::Add(hn::Sqrt(square), hn::LoadU(d, axes[3] + i));
            square = hn::Mul(far, far);
        }
        const auto farther = hn::Gt(square, most);
        most = hn::IfThenElse(farther, square, most);
        where = hn::IfThenElse(hn::RebindMask(di, farther), hn::Set(di, int32_t(i)), where);
    }
    HWY_ALIGN float squares[16];
    HWY_ALIGN int32_t blocks[16];
    hn::Store(most, d, squares);
    hn::Store(where, di, blocks);
    PointCloud::Farthest best{0, -1};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::size_t point = std::size_t(blocks[lane]) + lane;
        const bool first = squares[lane] == best.distanceSq && point < best.point;
        if (squares[lane] > best.distanceSq || first) best = {point, squares[lane]};
    }
    return best;
}

} // namespace HWY_NAMESPACE
} // namespace tight
} // namespace openvdb_spheretree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace openvdb_spheretree {
namespace tight {

HWY_EXPORT(farthestOf);

namespace {
constexpr std::size_t kPadding = 16;
}

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
    const float* const axes[4] = {
        mAxis[0].data(), mAxis[1].data(), mAxis[2].data(), mHasRadii ? mAxis[3].data() : nullptr};
    const float at[3] = {x, y, z};
    return HWY_DYNAMIC_DISPATCH(farthestOf)(axes, mAxis[0].size(), at);
}

} // namespace tight
} // namespace openvdb_spheretree

#endif // HWY_ONCE
