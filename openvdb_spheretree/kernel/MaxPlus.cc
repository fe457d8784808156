// SPDX-License-Identifier: Apache-2.0
#include "MaxPlus.h"

#include "LargestValue.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/kernel/MaxPlus.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "EnvelopeSearch-inl.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

/// Keys with room for the offset, for radii up to 60 voxels: from the top the sign, 12 bits of
/// value, 12 of radiusSq, 7 of offset. They fit because 60^2 < 2^12, and a value is at most its site's
/// radiusSq, so keys are not negative. A better row is at most floor(sqrt(60^2 - 1)) = 59 rows away. Rows that are searched four together
/// look 3 rows further: offsets are -62 to 62, and with the bias 2 to 126. A penalty is at most
/// 62^2 2^19 + 62 < 2^31: a candidate may be negative, but does not fall below -2^31.
struct SmallKeys {
    using Key = int32_t;
    using Offset = int8_t;
    static constexpr bool kOffsetInKey = true;
    static constexpr int kSiteShift = 7, kShift = 19;
    static constexpr Key kOffsetMask = 127, kOffsetBias = 64;
    static constexpr uint32_t kMaxRadiusSq = 60 * 60;
};

/// Keys as they come. Narrow ones have 14 bits of value above 16 of radiusSq: 127^2 < 2^14, so they
/// are below 2^30. Rows up to floor(sqrt(127^2 - 1)) + 3 = 129 away are looked at: 129^2 2^16 <
/// 2^31, so candidates stay above -2^31. Wide ones have 30 bits of value above 32, and look 32769
/// rows away: 32769^2 2^32 < 2^63.
template <typename Power>
struct PlainKeys : Power {
    static constexpr bool kOffsetInKey = false;
};

template <typename Keys>
struct MaxPlusOp {
    using Value = typename Keys::Key;
    using Offset = typename Keys::Offset;
    using D = hn::CappedTag<Value, kLanes>;
    using V = hn::Vec<D>;
    static constexpr bool kOffsetInKey = Keys::kOffsetInKey;
    static constexpr bool kTracksOffset = !kOffsetInKey;

    const Value* in;
    Value* out;
    Offset* offsets;

    /// What the key of a site loses on the way to a row `distance` rows behind it. Of equals the first
    /// row wins: with offsets in the keys that is the one of larger `distance`, without by better().
    static Value penalty(int distance)
    {
        const Value square = Value(Value(distance) * distance) << Keys::kShift;
        return kOffsetInKey ? square - distance : square;
    }
    HWY_INLINE V load(int row, int lane) const { return hn::Load(D(), in + at(row, lane)); }
    static HWY_INLINE V candidate(V key, V penalty) { return hn::Sub(key, penalty); }
    static HWY_INLINE auto better(V a, V b) { return hn::Gt(a, b); }
    static HWY_INLINE V best(V a, V b) { return hn::Max(a, b); }
    static HWY_INLINE V bestOfThree(V own, V before, V penaltyBefore, V behind, V penaltyBehind)
    {
        return best(own, best(candidate(before, penaltyBefore), candidate(behind, penaltyBehind)));
    }
    static HWY_INLINE V offsetOf(V key)
    {
        if constexpr (kOffsetInKey) {
            const D d;
            const V bits = hn::And(key, hn::Set(d, Keys::kOffsetMask));
            return hn::Sub(hn::Set(d, Keys::kOffsetBias), bits);
        } else {
            return key; // not used
        }
    }

    HWY_INLINE void store(int row, int lane, V key, V offset) const
    {
        const D d;
        const auto background = hn::Eq(load(row, lane), hn::Zero(d));
        const std::ptrdiff_t place = at(row, lane);
        if (out) hn::Store(hn::IfThenZeroElse(background, plain(key)), d, out + place);
        storeOffsets(hn::IfThenZeroElse(background, offset), offsets + place);
    }

    /// A row of value m beats an own value of at least n only within sqrt(m - n): for every leaf,
    /// its own smallest n and the largest m of each leaf near enough count.
    template <int kVectors>
    void leafReach(int lane, EnvelopeScratch& scratch) const
    {
        const int leaves = int(scratch.reach.size());
        int64_t largestOfAll = 0;
        for (int leaf = 0; leaf < leaves; ++leaf) {
            leafExtremes<kVectors>(leaf, lane, scratch);
            largestOfAll = std::max(largestOfAll, scratch.largest[leaf]);
        }
        for (int leaf = 0; leaf < leaves; ++leaf) {
            const int64_t own = scratch.smallest[leaf];
            const int farthest = rootOrZero(largestOfAll - own);
            int reach = own > scratch.largest[leaf] ? 0 : rootOrZero(scratch.largest[leaf] - own);
            for (int k = 1, gap = 1; gap <= farthest; ++k, gap += kLeafDim) {
                const int64_t before = leaf >= k ? scratch.largest[leaf - k] : 0;
                const int64_t behind = leaf + k < leaves ? scratch.largest[leaf + k] : 0;
                const int root = rootOrZero(std::max(before, behind) - own);
                if (root >= gap) reach = std::max(reach, root);
            }
            scratch.reach[leaf] = reach;
        }
    }

private:
    /// The key without an offset.
    static HWY_INLINE V plain(V key)
    {
        if constexpr (kOffsetInKey) {
            const D d;
            const V site = hn::And(hn::ShiftRight<Keys::kSiteShift>(key),
                hn::Set(d, (1 << (Keys::kShift - Keys::kSiteShift)) - 1));
            const V value = hn::ShiftRight<Keys::kShift>(key);
            return hn::Or(hn::ShiftLeft<NarrowPower::kShift>(value), site);
        } else {
            return key;
        }
    }

    static HWY_INLINE void storeOffsets(V offset, Offset* offsets)
    {
        if constexpr (sizeof(Offset) == 1) {
            const hn::Rebind<Offset, D> narrow;
            hn::StoreU(hn::DemoteTo(narrow, offset), narrow, offsets);
        } else {
            HWY_ALIGN Value wide[kLanes];
            hn::Store(offset, D(), wide);
            for (std::size_t i = 0; i < hn::Lanes(D()); ++i) offsets[i] = Offset(wide[i]);
        }
    }

    /// @param square  below 2^33
    static int rootOrZero(int64_t square) { return square <= 0 ? 0 : int(floorSqrtSmall(square)); }

    /// The largest value, and the smallest of an object voxel.
    template <int kVectors>
    void leafExtremes(int leaf, int lane, EnvelopeScratch& scratch) const
    {
        const D d;
        const V none = hn::Set(d, std::numeric_limits<Value>::max());
        V largest = hn::Zero(d), smallest = none;
        for (int row = kLeafDim * leaf; row < kLeafDim * (leaf + 1); ++row) {
            for (int v = 0; v < kVectors; ++v) {
                const V key = load(row, lane + v * int(hn::Lanes(d)));
                largest = hn::Max(largest, key);
                const auto background = hn::Eq(key, hn::Zero(d));
                smallest = hn::Min(smallest, hn::IfThenElse(background, none, key));
            }
        }
        scratch.largest[leaf] = int64_t(hn::GetLane(hn::MaxOfLanes(d, largest))) >> Keys::kShift;
        scratch.smallest[leaf] = int64_t(hn::GetLane(hn::MinOfLanes(d, smallest))) >> Keys::kShift;
    }
};

/// Keys with room for the offset, which is 0 so far, from values and sites.
template <class D>
HWY_INLINE hn::Vec<D> SmallKey(D d, hn::Vec<D> value, hn::Vec<D> site)
{
    const auto key =
        hn::Or(hn::ShiftLeft<SmallKeys::kShift>(value), hn::ShiftLeft<SmallKeys::kSiteShift>(site));
    const auto background = hn::Eq(value, hn::Zero(d));
    return hn::IfThenZeroElse(background, hn::Or(key, hn::Set(d, SmallKeys::kOffsetBias)));
}

/// @return the largest site's radiusSq; the keys are right if it is not above kMaxRadiusSq.
uint32_t ToSmall(const int32_t* keys, int rows, int32_t* small)
{
    const hn::CappedTag<int32_t, kLanes> d;
    const auto mask = hn::Set(d, (1 << NarrowPower::kShift) - 1);
    auto largest = hn::Zero(d);
    for (std::ptrdiff_t i = 0; i < at(rows, 0); i += int(hn::Lanes(d))) {
        const auto key = hn::Load(d, keys + i);
        const auto site = hn::And(key, mask);
        largest = hn::Max(largest, site);
        hn::Store(SmallKey(d, hn::ShiftRight<NarrowPower::kShift>(key), site), d, small + i);
    }
    return uint32_t(hn::GetLane(hn::MaxOfLanes(d, largest)));
}

void MaxPlusNarrow(const int32_t* inKey, int32_t* outKey, int8_t* offset, const RowRange& rows,
    EnvelopeScratch& scratch)
{
    int32_t* small = scratch.keys.rows(std::size_t(rows.count), 1);
    if (ToSmall(inKey, rows.count, small) <= SmallKeys::kMaxRadiusSq) {
        EnvelopeSearch<MaxPlusOp<SmallKeys>>({small, outKey, offset}, rows, scratch).run();
        return;
    }
    EnvelopeSearch<MaxPlusOp<PlainKeys<NarrowPower>>>({inKey, outKey, offset}, rows, scratch).run();
}

uint32_t FirstNarrow(
    const uint16_t* distances, int32_t* outKey, int8_t* offset, int rows, EnvelopeScratch& scratch)
{
    const hn::CappedTag<int32_t, kLanes> d;
    const hn::Rebind<uint16_t, decltype(d)> narrow;
    const uint32_t largest = largestValue(distances, std::size_t(at(rows, 0)));
    const bool small = largest <= SmallKeys::kMaxRadiusSq;
    int32_t* keys = scratch.keys.rows(std::size_t(rows), 1);
    for (std::ptrdiff_t i = 0; i < at(rows, 0); i += int(hn::Lanes(d))) {
        const auto value = hn::PromoteTo(d, hn::Load(narrow, distances + i));
        hn::Store(small ? SmallKey(d, value, value)
                        : hn::Or(hn::ShiftLeft<NarrowPower::kShift>(value), value),
            d, keys + i);
    }
    const RowRange all{0, rows, rows};
    if (small) {
        EnvelopeSearch<MaxPlusOp<SmallKeys>>({keys, outKey, offset}, all, scratch).run();
    } else {
        EnvelopeSearch<MaxPlusOp<PlainKeys<NarrowPower>>>({keys, outKey, offset}, all, scratch)
            .run();
    }
    return largest;
}

void MaxPlusWide(const int64_t* inKey, int64_t* outKey, int16_t* offset, const RowRange& rows,
    EnvelopeScratch& scratch)
{
    EnvelopeSearch<MaxPlusOp<PlainKeys<WidePower>>>({inKey, outKey, offset}, rows, scratch).run();
}

uint32_t FirstWide(
    const uint32_t* distances, int64_t* outKey, int16_t* offset, int rows, EnvelopeScratch& scratch)
{
    int64_t* keys = scratch.wideKeys.rows(std::size_t(rows), 1);
    for (std::ptrdiff_t i = 0; i < at(rows, 0); ++i) {
        keys[i] = powerKey<WidePower>(distances[i], distances[i]);
    }
    MaxPlusWide(keys, outKey, offset, {0, rows, rows}, scratch);
    return largestValue(distances, std::size_t(at(rows, 0)));
}

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::detail {

HWY_EXPORT(MaxPlusNarrow);
HWY_EXPORT(MaxPlusWide);
HWY_EXPORT(FirstNarrow);
HWY_EXPORT(FirstWide);

template <>
void maxPlus<NarrowPower>(const int32_t* inKey, int32_t* outKey, int8_t* offset,
    const RowRange& rows, EnvelopeScratch& scratch)
{
    HWY_DYNAMIC_DISPATCH(MaxPlusNarrow)(inKey, outKey, offset, rows, scratch);
}

template <>
void maxPlus<WidePower>(const int64_t* inKey, int64_t* outKey, int16_t* offset,
    const RowRange& rows, EnvelopeScratch& scratch)
{
    HWY_DYNAMIC_DISPATCH(MaxPlusWide)(inKey, outKey, offset, rows, scratch);
}

template <>
uint32_t firstMaxPlus<NarrowPower>(
    const uint16_t* distances, int32_t* outKey, int8_t* offset, int rows, EnvelopeScratch& scratch)
{
    return HWY_DYNAMIC_DISPATCH(FirstNarrow)(distances, outKey, offset, rows, scratch);
}

template <>
uint32_t firstMaxPlus<WidePower>(
    const uint32_t* distances, int64_t* outKey, int16_t* offset, int rows, EnvelopeScratch& scratch)
{
    return HWY_DYNAMIC_DISPATCH(FirstWide)(distances, outKey, offset, rows, scratch);
}

} // namespace openvdb_spheretree::detail
#endif
