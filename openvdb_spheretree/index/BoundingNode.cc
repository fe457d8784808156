// SPDX-License-Identifier: Apache-2.0
/// @file BoundingNode.cc
/// @brief As many children at a time as the machine has lanes of doubles: in doubles, the bounds of
/// BoundingTree suffice for rounding. Machines may differ in the last bit of an entry, and so in
/// what is looked at first, but not in what is hit.

#include "BoundingNode.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/index/BoundingNode.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, BoundingNode::kWidth>;
using Vector = hn::Vec<Doubles>;

HWY_INLINE Vector loadFloats(const BoundingNode::Each<float>& floats, std::size_t i)
{
    const Doubles d;
    return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, Doubles>(), floats.data() + i));
}

/// The last factor is for the rounding of the box test (Ize, Robust BVH Ray Traversal, 2013).
uint32_t entries(
    const BoundingNode& node, const Ray& ray, double far, BoundingNode::Each<double>& entry)
{
    const Doubles d;
    uint32_t entered = 0;
    for (std::size_t i = 0; i < entry.size(); i += hn::Lanes(d)) {
        auto in = hn::Zero(d), out = hn::Set(d, 1e299);
        auto nearest = hn::Zero(d), apartSq = hn::Zero(d);
        Vector toCenter[3];
        for (int axis = 0; axis < 3; ++axis) {
            const auto origin = hn::Set(d, ray.origin[axis]);
            const auto inverse = hn::Set(d, ray.inverse[axis]);
            const auto a = hn::Mul(hn::Sub(loadFloats(node.lo[axis], i), origin), inverse);
            const auto b = hn::Mul(hn::Sub(loadFloats(node.hi[axis], i), origin), inverse);
            in = hn::Max(in, hn::Min(a, b));
            out = hn::Min(out, hn::Max(a, b));
            toCenter[axis] = hn::Sub(loadFloats(node.center[axis], i), origin);
            nearest = hn::MulAdd(toCenter[axis], hn::Set(d, ray.direction[axis]), nearest);
        }
        for (int axis = 0; axis < 3; ++axis) {
            const auto aside =
                hn::NegMulAdd(nearest, hn::Set(d, ray.direction[axis]), toCenter[axis]);
            apartSq = hn::MulAdd(aside, aside, apartSq);
        }
        const auto radius = loadFloats(node.radius, i);
        const auto halfSq = hn::Sub(hn::Mul(radius, radius), apartSq);
        const auto half = hn::Sqrt(hn::Max(halfSq, hn::Zero(d)));
        const auto begin = hn::Max(in, hn::Sub(nearest, half));
        const auto isBox = hn::Le(in, hn::Mul(out, hn::Set(d, 1 + 1e-15)));
        const auto isBall = hn::And(hn::Ge(halfSq, hn::Zero(d)),
            hn::Ge(hn::Add(nearest, loadFloats(node.behind, i)), hn::Zero(d)));
        const auto isNear = hn::Le(begin, hn::Set(d, far));
        hn::StoreU(begin, d, entry.data() + i);
        uint8_t bits[8] = {};
        hn::StoreMaskBits(d, hn::And(hn::And(isBox, isBall), isNear), bits);
        entered |= uint32_t(bits[0]) << i;
    }
    return entered;
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace openvdb_spheretree::detail {

HWY_EXPORT(entries);

uint32_t entriesOf(
    const BoundingNode& node, const Ray& ray, double far, BoundingNode::Each<double>& entry)
{
    return HWY_DYNAMIC_DISPATCH(entries)(node, ray, far, entry);
}

} // namespace openvdb_spheretree::detail

#endif // HWY_ONCE
