// SPDX-License-Identifier: Apache-2.0
#include "MinPlus.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/kernel/MinPlus.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "EnvelopeSearch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

template <typename T>
struct MinPlusOp {
    using Value = T;
    using D = hn::CappedTag<T, kLanes>;
    using V = hn::Vec<D>;
    static constexpr bool kOffsetInKey = false, kTracksOffset = false;

    const T* in;
    T* out;

    static T penalty(int distance)
    {
        const uint32_t square = uint32_t(distance) * uint32_t(distance);
        return T(std::min(square, sizeof(T) == 2 ? 65535u : kWideMax));
    }
    HWY_INLINE V load(int row, int lane) const { return hn::Load(D(), in + at(row, lane)); }
    static HWY_INLINE V candidate(V value, V penalty)
    {
        if constexpr (sizeof(T) == 2) return hn::SaturatedAdd(value, penalty);
        else return hn::Add(value, penalty);
    }
    static HWY_INLINE auto better(V a, V b) { return hn::Lt(a, b); }
    static HWY_INLINE V best(V a, V b) { return hn::Min(a, b); }
    /// Two rows as far away on either side have the same penalty.
    static HWY_INLINE V bestOfThree(V own, V before, V penalty, V behind, V)
    {
        return hn::Min(own, candidate(hn::Min(before, behind), penalty));
    }
    static HWY_INLINE V offsetOf(V value) { return value; } // values hold none
    HWY_INLINE void store(int row, int lane, V value, V) const
    {
        hn::Store(value, D(), out + at(row, lane));
    }

    /// A row is better than the own value m only nearer than sqrt(m): the largest m of a leaf
    /// counts.
    template <int kVectors>
    void leafReach(int lane, EnvelopeScratch& scratch) const
    {
        const D d;
        for (int leaf = 0; leaf < int(scratch.reach.size()); ++leaf) {
            V largest = hn::Zero(d);
            for (int row = kLeafDim * leaf; row < kLeafDim * (leaf + 1); ++row) {
                for (int v = 0; v < kVectors; ++v) {
                    largest = hn::Max(largest, load(row, lane + v * int(hn::Lanes(d))));
                }
            }
            const int64_t m = hn::GetLane(hn::MaxOfLanes(d, largest));
            scratch.reach[leaf] = m <= 1 ? 0 : int(floorSqrtSmall(m - 1));
        }
    }
};

void MinPlus16(const uint16_t* in, uint16_t* out, int rows, EnvelopeScratch& scratch)
{
    EnvelopeSearch<MinPlusOp<uint16_t>>({in, out}, {0, rows, rows}, scratch).run();
}

void MinPlus32(const uint32_t* in, uint32_t* out, int rows, EnvelopeScratch& scratch)
{
    EnvelopeSearch<MinPlusOp<uint32_t>>({in, out}, {0, rows, rows}, scratch).run();
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::detail {

HWY_EXPORT(MinPlus16);
HWY_EXPORT(MinPlus32);

void minPlus(const uint16_t* in, uint16_t* out, int rows, EnvelopeScratch& scratch)
{
    HWY_DYNAMIC_DISPATCH(MinPlus16)(in, out, rows, scratch);
}

void minPlus(const uint32_t* in, uint32_t* out, int rows, EnvelopeScratch& scratch)
{
    HWY_DYNAMIC_DISPATCH(MinPlus32)(in, out, rows, scratch);
}

} // namespace openvdb_spheretree::detail
#endif
