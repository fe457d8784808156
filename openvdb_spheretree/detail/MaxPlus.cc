// SPDX-License-Identifier: Apache-2.0
#include "MaxPlus.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/detail/MaxPlus.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

#include "EnvelopeSearch-inl.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree {
namespace detail {
namespace HWY_NAMESPACE {

template <typename Power>
struct MaxPlusOp {
    using Value = typename Power::Key;
    using Offset = typename Power::Offset;
    using D = hn::CappedTag<Value, kLanes>;
    using V = hn::Vec<D>;
    static constexpr bool kStepInKey = Power::kSiteShift > 0;
    static constexpr bool kTracksStep = !kStepInKey;

    const Value* in;
    Value* out;
    Offset* offset;

    /// What the key of a site loses on the way to a row `distance` rows behind it.
    static Value penalty(int distance)
    {
        const Value square = Value(Value(distance) * distance) << Power::kShift;
        return kStepInKey ? square - distance : square;
    }
    HWY_INLINE V load(int row, int lane) const { return hn::Load(D(), in + at(row, lane)); }
    static HWY_INLINE V candidate(V key, V penalty) { return hn::Sub(key, penalty); }
    static HWY_INLINE auto better(V a, V b) { return hn::Gt(a, b); }
    static HWY_INLINE V best(V a, V b) { return hn::Max(a, b); }
    static HWY_INLINE V stepBits(V key) { return hn::And(key, hn::Set(D(), kStepMask)); }
    static HWY_INLINE V step(V key)
    {
        return hn::Sub(hn::Set(D(), Power::kStepBias), stepBits(key));
    }

    HWY_INLINE void store(int row, int lane, V key, V step) const
    {
        const D d;
        const auto background = hn::Eq(load(row, lane), hn::Zero(d));
        const std::ptrdiff_t place = at(row, lane);
        if (out) {
            if (kStepInKey) { // the next pass counts its own steps
                key = hn::Add(hn::Sub(key, stepBits(key)), hn::Set(d, Power::kStepBias));
            }
            hn::Store(hn::IfThenZeroElse(background, key), d, out + place);
        }
        storeSteps(hn::IfThenZeroElse(background, step), offset + place);
    }

    /// A row of value m beats an own value of at least n only within sqrt(m - n): for every block,
    /// its own smallest n and the largest m of each block near enough count.
    void blockReach(int lane, EnvelopeScratch& scratch) const
    {
        const int blocks = int(scratch.reach.size());
        int64_t largestOfAll = 0;
        for (int block = 0; block < blocks; ++block) {
            blockExtremes(block, lane, scratch);
            largestOfAll = std::max(largestOfAll, scratch.largest[block]);
        }
        for (int block = 0; block < blocks; ++block) {
            const int64_t own = scratch.smallest[block];
            const int farthest = rootOrZero(largestOfAll - own);
            int reach = own > scratch.largest[block] ? 0 : rootOrZero(scratch.largest[block] - own);
            for (int k = 1, gap = 1; gap <= farthest; ++k, gap += kBlockRows) {
                const int64_t before = block >= k ? scratch.largest[block - k] : 0;
                const int64_t behind = block + k < blocks ? scratch.largest[block + k] : 0;
                const int root = rootOrZero(std::max(before, behind) - own);
                if (root >= gap) reach = std::max(reach, root);
            }
            scratch.reach[block] = reach;
        }
    }

private:
    static constexpr Value kStepMask = (Value(1) << Power::kSiteShift) - 1;

    static HWY_INLINE void storeSteps(V step, int8_t* offsets)
    {
        const hn::Rebind<int8_t, D> narrow;
        hn::StoreU(hn::DemoteTo(narrow, step), narrow, offsets);
    }
    static HWY_INLINE void storeSteps(V step, int16_t* offsets)
    {
        HWY_ALIGN Value steps[kLanes];
        hn::Store(step, D(), steps);
        for (std::size_t i = 0; i < hn::Lanes(D()); ++i) offsets[i] = Offset(steps[i]);
    }

    static int rootOrZero(int64_t square) { return square <= 0 ? 0 : floorRoot(square); }

    /// The largest value, and the smallest of an object voxel.
    void blockExtremes(int block, int lane, EnvelopeScratch& scratch) const
    {
        const D d;
        const V none = hn::Set(d, std::numeric_limits<Value>::max());
        V largest = hn::Zero(d), smallest = none;
        for (int row = kBlockRows * block; row < kBlockRows * (block + 1); ++row) {
            const V key = load(row, lane);
            largest = hn::Max(largest, key);
            const auto background = hn::Eq(key, hn::Zero(d));
            smallest = hn::Min(smallest, hn::IfThenElse(background, none, key));
        }
        scratch.largest[block] = int64_t(hn::GetLane(hn::MaxOfLanes(d, largest))) >> Power::kShift;
        scratch.smallest[block] =
            int64_t(hn::GetLane(hn::MinOfLanes(d, smallest))) >> Power::kShift;
    }
};

void MaxPlusSmall(
    const int32_t* inKey, int32_t* outKey, int8_t* offset, int rows, EnvelopeScratch& scratch)
{
    EnvelopeSearch<MaxPlusOp<SmallPower>>({inKey, outKey, offset}, rows, scratch).run();
}

void MaxPlusNarrow(
    const int32_t* inKey, int32_t* outKey, int8_t* offset, int rows, EnvelopeScratch& scratch)
{
    EnvelopeSearch<MaxPlusOp<NarrowPower>>({inKey, outKey, offset}, rows, scratch).run();
}

void MaxPlusWide(
    const int64_t* inKey, int64_t* outKey, int16_t* offset, int rows, EnvelopeScratch& scratch)
{
    EnvelopeSearch<MaxPlusOp<WidePower>>({inKey, outKey, offset}, rows, scratch).run();
}

} // namespace HWY_NAMESPACE
} // namespace detail
} // namespace openvdb_spheretree
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree {
namespace detail {

HWY_EXPORT(MaxPlusSmall);
HWY_EXPORT(MaxPlusNarrow);
HWY_EXPORT(MaxPlusWide);

template <>
void maxPlus<SmallPower>(
    const int32_t* inKey, int32_t* outKey, int8_t* offset, int rows, EnvelopeScratch& scratch)
{
    HWY_DYNAMIC_DISPATCH(MaxPlusSmall)(inKey, outKey, offset, rows, scratch);
}

template <>
void maxPlus<NarrowPower>(
    const int32_t* inKey, int32_t* outKey, int8_t* offset, int rows, EnvelopeScratch& scratch)
{
    HWY_DYNAMIC_DISPATCH(MaxPlusNarrow)(inKey, outKey, offset, rows, scratch);
}

template <>
void maxPlus<WidePower>(
    const int64_t* inKey, int64_t* outKey, int16_t* offset, int rows, EnvelopeScratch& scratch)
{
    HWY_DYNAMIC_DISPATCH(MaxPlusWide)(inKey, outKey, offset, rows, scratch);
}

} // namespace detail
} // namespace openvdb_spheretree
#endif
