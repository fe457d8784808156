// SPDX-License-Identifier: Apache-2.0
#include "LeafTranspose.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "openvdb_spheretree/kernel/LeafTranspose.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace openvdb_spheretree::detail::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

void SwapRows16(const uint16_t* rows, uint16_t* swapped) { swapRows<>(rows, swapped); }
void SwapRows32(const int32_t* rows, int32_t* swapped) { swapRows<>(rows, swapped); }
void RowsZToLeaf8(const int8_t* rows, int8_t* leaf) { rowsToLeaf(Axis::Z, rows, leaf); }
void StreamRowsZToLeaf16(const uint16_t* rows, uint16_t* leaf) { rowsToLeaf(Axis::Z, rows, leaf); }
void StreamRowsZToLeaf32(const uint16_t* rows, int32_t* leaf) { rowsToLeafAs(Axis::Z, rows, leaf); }
void StreamRowsYToLeaf(const int32_t* rows, int32_t* leaf) { rowsToLeaf(Axis::Y, rows, leaf); }

#else

namespace hn = hwy::HWY_NAMESPACE;

/// A vector of 16 bytes.
template <typename T>
using Block = hn::FixedTag<T, 16 / sizeof(T)>;

/// Interleaves 16 bytes of each of eight rows, value by value: store(i, vector) gets the 128 bytes
/// in eight pieces.
template <typename T, typename Store>
HWY_INLINE void Interleave8(const T* in, std::size_t stride, const Store& store)
{
    const Block<T> d;
    hn::Vec<Block<T>> a[8], b[8];
    for (int i = 0; i < 8; ++i) a[i] = hn::LoadU(d, in + i * stride);
    const auto interleave = [&](const hn::Vec<Block<T>>* from, hn::Vec<Block<T>>* to) {
        for (int i = 0; i < 4; ++i) {
            to[2 * i] = hn::InterleaveLower(d, from[i], from[i + 4]);
            to[2 * i + 1] = hn::InterleaveUpper(d, from[i], from[i + 4]);
        }
    };
    interleave(a, b);
    interleave(b, a);
    interleave(a, b);
    for (int i = 0; i < 8; ++i) store(i, b[i]);
}

/// Transposes 4 x 4 values of 32 bits.
HWY_INLINE void Transpose4(const int32_t* in, int32_t* out)
{
    const Block<int32_t> d;
    const auto a = hn::LoadU(d, in), b = hn::LoadU(d, in + 64);
    const auto e = hn::LoadU(d, in + 128), f = hn::LoadU(d, in + 192);
    const auto ae = hn::InterleaveLower(d, a, e), bf = hn::InterleaveLower(d, b, f);
    const auto ae2 = hn::InterleaveUpper(d, a, e), bf2 = hn::InterleaveUpper(d, b, f);
    hn::StoreU(hn::InterleaveLower(d, ae, bf), d, out);
    hn::StoreU(hn::InterleaveUpper(d, ae, bf), d, out + 64);
    hn::StoreU(hn::InterleaveLower(d, ae2, bf2), d, out + 128);
    hn::StoreU(hn::InterleaveUpper(d, ae2, bf2), d, out + 192);
}

void SwapRows16(const uint16_t* rows, uint16_t* swapped)
{
    const Block<uint16_t> d;
    for (int x = 0; x < 8; ++x) {
        Interleave8(rows + 8 * x, 64, [&](int v, hn::Vec<Block<uint16_t>> values) {
            hn::StoreU(values, d, swapped + 64 * v + 8 * x);
        });
    }
}

void SwapRows32(const int32_t* rows, int32_t* swapped)
{
    for (int x = 0; x < 8; ++x) {
        for (int u = 0; u < 8; u += 4) {
            for (int v = 0; v < 8; v += 4) {
                Transpose4(rows + 64 * u + 8 * x + v, swapped + 64 * v + 8 * x + u);
            }
        }
    }
}

void RowsZToLeaf8(const int8_t* rows, int8_t* leaf)
{
    const Block<int8_t> d;
    for (int lane = 0; lane < 64; lane += 16) {
        Interleave8(rows + lane, 64, [&](int i, hn::Vec<Block<int8_t>> values) {
            hn::StoreU(values, d, leaf + 8 * lane + 16 * i);
        });
    }
}

void StreamRowsZToLeaf16(const uint16_t* rows, uint16_t* leaf)
{
    const Block<uint16_t> d;
    for (int lane = 0; lane < 64; lane += 8) {
        Interleave8(rows + lane, 64, [&](int i, hn::Vec<Block<uint16_t>> values) {
            hn::Stream(values, d, leaf + 8 * lane + 8 * i);
        });
    }
}

void StreamRowsZToLeaf32(const uint16_t* rows, int32_t* leaf)
{
    const hn::Half<Block<uint16_t>> half;
    const Block<int32_t> wide;
    for (int lane = 0; lane < 64; lane += 8) {
        Interleave8(rows + lane, 64, [&](int i, hn::Vec<Block<uint16_t>> values) {
            int32_t* to = leaf + 8 * lane + 8 * i;
            hn::Stream(hn::PromoteTo(wide, hn::LowerHalf(half, values)), wide, to);
            hn::Stream(hn::PromoteTo(wide, hn::UpperHalf(half, values)), wide, to + 4);
        });
    }
}

void StreamRowsYToLeaf(const int32_t* rows, int32_t* leaf)
{
    const Block<int32_t> d;
    for (int x = 0; x < 8; ++x) {
        for (int y = 0; y < 8; ++y, leaf += 8) {
            const int32_t* from = rows + 64 * y + 8 * x;
            hn::Stream(hn::Load(d, from), d, leaf);
            hn::Stream(hn::Load(d, from + 4), d, leaf + 4);
        }
    }
}

#endif // of targets with vectors

} // namespace openvdb_spheretree::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace openvdb_spheretree::detail {

HWY_EXPORT(SwapRows16);
HWY_EXPORT(SwapRows32);
HWY_EXPORT(RowsZToLeaf8);
HWY_EXPORT(StreamRowsZToLeaf16);
HWY_EXPORT(StreamRowsZToLeaf32);
HWY_EXPORT(StreamRowsYToLeaf);

void swapRows(const uint16_t* rows, uint16_t* swapped)
{
    HWY_DYNAMIC_DISPATCH(SwapRows16)(rows, swapped);
}
void swapRows(const int32_t* rows, int32_t* swapped)
{
    HWY_DYNAMIC_DISPATCH(SwapRows32)(rows, swapped);
}
void rowsZToLeaf(const int8_t* rows, int8_t* leaf)
{
    HWY_DYNAMIC_DISPATCH(RowsZToLeaf8)(rows, leaf);
}
void streamRowsZToLeaf(const uint16_t* rows, uint16_t* leaf)
{
    HWY_DYNAMIC_DISPATCH(StreamRowsZToLeaf16)(rows, leaf);
}
void streamRowsZToLeaf(const uint16_t* rows, int32_t* leaf)
{
    HWY_DYNAMIC_DISPATCH(StreamRowsZToLeaf32)(rows, leaf);
}
void streamRowsYToLeaf(const int32_t* rows, int32_t* leaf)
{
    HWY_DYNAMIC_DISPATCH(StreamRowsYToLeaf)(rows, leaf);
}

} // namespace openvdb_spheretree::detail
#endif
