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

/// Lists the balls of @a from that matter, in order.
/// @param strongest  as of BallsInBox::list()
/// @param listed     receives them; has room for all
/// @return how many they are.
std::size_t listBalls(const BallArrays& balls, const BoxMiddle& box,
    const std::vector<int32_t>& from, bool untilHeld, StrongestBall& strongest, int32_t* listed)
{
    constexpr double kRounding = 1e-12; // more than that of the sums here, relative
    const hn::CappedTag<double, kMostLanes> d;
    const hn::RebindToSigned<decltype(d)> d64;
    const hn::Rebind<int32_t, decltype(d)> d32;
    const std::size_t lanes = hn::Lanes(d);
    const auto halfX = hn::Set(d, box.half[0]), halfY = hn::Set(d, box.half[1]),
               halfZ = hn::Set(d, box.half[2]);
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
        const auto squareOf = [](auto v) { return hn::Mul(v, v); };
        const auto apartSq = hn::Add(squareOf(x), hn::Add(squareOf(y), squareOf(z)));
        const auto power = hn::Sub(radiusSq, apartSq);

        const auto beyond = [&](auto v, auto half) {
            return squareOf(hn::Max(hn::Sub(hn::Abs(v), half), hn::Zero(d)));
        };
        const auto nearestSq =
            hn::Add(beyond(x, halfX), hn::Add(beyond(y, halfY), beyond(z, halfZ)));
        auto matters = hn::Le(nearestSq, hn::Mul(radiusSq, hn::Set(d, 1 + kRounding)));
        if (strongest.ball >= 0) {
            const int32_t best = strongest.ball;
            const auto along = [&](auto v, const double* axis, double middle, auto half) {
                return hn::Mul(hn::Abs(hn::Sub(v, hn::Set(d, axis[best] - middle))), half);
            };
            const auto across = hn::Add(along(x, balls.x, box.middle[0], halfX),
                hn::Add(along(y, balls.y, box.middle[1], halfY),
                    along(z, balls.z, box.middle[2], halfZ)));
            const auto most = hn::Set(d, strongest.power);
            const auto least = hn::Sub(hn::Sub(most, power), hn::Add(across, across));
            const auto terms = hn::Add(hn::Set(d, strongest.size), hn::Add(radiusSq, apartSq));
            const auto isWeaker = hn::Gt(least, hn::Mul(terms, hn::Set(d, kRounding)));
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
        if (!untilHeld) continue;
        double farthestSq = 0;
        const double* const axes[3] = {balls.x, balls.y, balls.z};
        for (int a = 0; a < 3; ++a) {
            const double far = std::abs(axes[a][ids[k]] - box.middle[a]) + box.half[a];
            farthestSq += far * far;
        }
        if (farthestSq * (1 + kRounding) <= balls.radiusSq[ids[k]]) break;
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
