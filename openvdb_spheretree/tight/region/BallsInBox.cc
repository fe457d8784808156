// SPDX-License-Identifier: Apache-2.0
#include "BallsInBox.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/tight/region/BallsInBox.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::tight {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kMostLanes = 8;

constexpr double kRounding = 1e-12; // more than that of the sums here, relative

/// @return the squared distance of each ball's center to the box.
/// @param x, y, z  centers, from the middle of the box
template <class D, class V = hn::VFromD<D>>
HWY_INLINE V nearestSqOf(D d, const BoxMiddle& box, V x, V y, V z)
{
    const V gapX = hn::Max(hn::Sub(hn::Abs(x), hn::Set(d, box.half[0])), hn::Zero(d));
    const V gapY = hn::Max(hn::Sub(hn::Abs(y), hn::Set(d, box.half[1])), hn::Zero(d));
    const V gapZ = hn::Max(hn::Sub(hn::Abs(z), hn::Set(d, box.half[2])), hn::Zero(d));
    return hn::Add(hn::Mul(gapX, gapX), hn::Add(hn::Mul(gapY, gapY), hn::Mul(gapZ, gapZ)));
}

/// @return how much more power the strongest ball has than each of some others, where that is least
/// in the box.
template <class D, class V = hn::VFromD<D>>
HWY_INLINE V leastAhead(D d, const BallArrays& balls, const BoxMiddle& box,
    const StrongestBall& strongest, V x, V y, V z, V power)
{
    const auto along = [&](V v, const double* axis, int a) {
        const double center = axis[strongest.ball] - box.middle[a];
        return hn::Mul(hn::Abs(hn::Sub(v, hn::Set(d, center))), hn::Set(d, box.half[a]));
    };
    const V across =
        hn::Add(along(x, balls.x, 0), hn::Add(along(y, balls.y, 1), along(z, balls.z, 2)));
    const V inMiddle = hn::Sub(hn::Set(d, strongest.power), power);
    return hn::Sub(inMiddle, hn::Add(across, across));
}

/// @return whether a ball surely holds all of the box.
bool holdsAll(const BallArrays& balls, int32_t ball, const BoxMiddle& box)
{
    const double center[3] = {balls.x[ball], balls.y[ball], balls.z[ball]};
    double farthestSq = 0;
    for (int a = 0; a < 3; ++a) {
        const double far = std::abs(center[a] - box.middle[a]) + box.half[a];
        farthestSq += far * far;
    }
    return farthestSq * (1 + kRounding) <= balls.radiusSq[ball];
}

/// Lists the balls of @a from that matter, in order.
/// @param strongest  as of BallsInBox::list()
/// @param listed     receives them; has room for all
/// @return how many they are.
std::size_t listBalls(const BallArrays& balls, const BoxMiddle& box,
    const std::vector<int32_t>& from, bool untilHeld, StrongestBall& strongest, int32_t* listed)
{
    const hn::CappedTag<double, kMostLanes> d;
    const hn::RebindToSigned<decltype(d)> d64;
    const hn::Rebind<int32_t, decltype(d)> d32;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t count = 0;
    for (std::size_t i = 0; i < from.size(); i += lanes) {
        const int32_t* ids = from.data() + i;
        int32_t last[kMostLanes];
        const std::size_t left = std::min(lanes, from.size() - i);
        if (left < lanes) { // the last one several times
            std::fill_n(std::copy_n(ids, left, last), lanes - left, ids[left - 1]);
            ids = last;
        }
        const auto index = hn::PromoteTo(d64, hn::LoadU(d32, ids));
        const auto x = hn::Sub(hn::GatherIndex(d, balls.x, index), hn::Set(d, box.middle[0]));
        const auto y = hn::Sub(hn::GatherIndex(d, balls.y, index), hn::Set(d, box.middle[1]));
        const auto z = hn::Sub(hn::GatherIndex(d, balls.z, index), hn::Set(d, box.middle[2]));
        const auto radiusSq = hn::GatherIndex(d, balls.radiusSq, index);
        const auto apartSq = hn::Add(hn::Mul(x, x), hn::Add(hn::Mul(y, y), hn::Mul(z, z)));
        const auto power = hn::Sub(radiusSq, apartSq);

        const auto reachSq = hn::Mul(radiusSq, hn::Set(d, 1 + kRounding));
        auto matters = hn::Le(nearestSqOf(d, box, x, y, z), reachSq);
        if (strongest.ball >= 0) {
            const auto ahead = leastAhead(d, balls, box, strongest, x, y, z, power);
            const auto terms = hn::Add(hn::Set(d, strongest.size), hn::Add(radiusSq, apartSq));
            const auto isWeaker = hn::Gt(ahead, hn::Mul(terms, hn::Set(d, kRounding)));
            matters = hn::AndNot(isWeaker, matters);
        }
        uint8_t bits[8] = {}; // as many as StoreMaskBits may write
        hn::StoreMaskBits(d, matters, bits);
        for (std::size_t k = 0; k < left; ++k) {
            listed[count] = ids[k];
            count += bits[0] >> k & 1;
        }
        if (hn::AllFalse(d, hn::Gt(power, hn::Set(d, strongest.power)))) continue;
        HWY_ALIGN double powers[kMostLanes];
        hn::Store(power, d, powers);
        const std::size_t k = std::size_t(std::max_element(powers, powers + lanes) - powers);
        strongest = {ids[k], powers[k], std::abs(2 * balls.radiusSq[ids[k]] - powers[k])};
        if (untilHeld && holdsAll(balls, ids[k], box)) break;
    }
    return count;
}

} // namespace HWY_NAMESPACE
} // namespace openvdb_spheretree::tight
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace openvdb_spheretree::tight {

HWY_EXPORT(listBalls);

BallsInBox::BallsInBox(const std::vector<ExactSphere>& balls)
{
    for (auto& column : mColumns) column.reserve(balls.size());
    for (const ExactSphere& ball : balls) {
        for (int a = 0; a < 3; ++a) mColumns[a].push_back(double(ball.center[a]));
        mColumns[3].push_back(double(ball.radiusSq));
    }
}

void BallsInBox::list(const openvdb::CoordBBox& box, const std::vector<int32_t>& from,
    bool untilHeld, StrongestBall& strongest, std::vector<int32_t>& to) const
{
    const std::size_t before = to.size();
    to.resize(before + from.size());
    const std::size_t listed = HWY_DYNAMIC_DISPATCH(listBalls)(
        arrays(), BoxMiddle(box), from, untilHeld, strongest, to.data() + before);
    to.resize(before + listed);
}

} // namespace openvdb_spheretree::tight

#endif // HWY_ONCE
