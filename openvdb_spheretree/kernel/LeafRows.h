// SPDX-License-Identifier: Apache-2.0
/// @file LeafRows.h
/// @brief The 512 values of a leaf as rows across an axis.
///
/// The kernels of both transforms sweep along one axis and treat the 64 lines of a run side by
/// side, one lane a line. A *row* is the 64 values at one position along the axis; a leaf has
/// eight:
///
///     axis X: row x, lane 8 y + z (the leaf's own order)
///     axis Y: row y, lane 8 x + z
///     axis Z: row z, lane 8 x + y

#pragma once

#include <openvdb_spheretree/voxel/LeafLayout.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

namespace openvdb_spheretree::detail {

constexpr int kLanes = 64; ///< values in a row

/// @return where a lane of a row is. Row -1 is valid, and an int may be too small for the result.
inline std::ptrdiff_t at(int row, int lane) { return std::ptrdiff_t(row) * kLanes + lane; }

/// Rows of a run, with `margin` zero rows before the first and after the last. Grows, never
/// shrinks; aligned for any vector width.
template <typename T>
class RowBuffer {
public:
    /// @return the first row; @a count rows are usable, of undefined content.
    T* rows(std::size_t count, std::size_t margin = 0)
    {
        const std::size_t needed = (count + 2 * margin) * kLanes;
        if (needed > mCapacity) {
            mData.reset(); // before there is more
            mData.reset(static_cast<T*>(::operator new[](needed * sizeof(T), kAlignment)));
            mCapacity = needed;
        }
        T* first = mData.get() + margin * kLanes;
        std::memset(mData.get(), 0, margin * kLanes * sizeof(T));
        std::memset(first + count * kLanes, 0, margin * kLanes * sizeof(T));
        return first;
    }

private:
    static constexpr std::align_val_t kAlignment{128};
    struct Delete {
        void operator()(T* data) const { ::operator delete[](data, kAlignment); }
    };
    std::unique_ptr<T[], Delete> mData;
    std::size_t mCapacity = 0;
};

/// Transposes 8 x 8 values. Interleaving the two halves of 64 values rotates the six bits of their
/// index by one; three times swaps row and column. Compilers turn each loop into vector unpacks.
template <typename T>
void transpose8x8(const T* in, std::size_t inStride, T* out, std::size_t outStride)
{
    alignas(64) T a[64], b[64];
    for (int row = 0; row < 8; ++row) std::memcpy(a + 8 * row, in + row * inStride, 8 * sizeof(T));
    const auto interleave = [](const T* from, T* to) {
        for (int i = 0; i < 32; ++i) {
            to[2 * i] = from[i];
            to[2 * i + 1] = from[i + 32];
        }
    };
    interleave(a, b);
    interleave(b, a);
    interleave(a, b);
    for (int row = 0; row < 8; ++row)
        std::memcpy(out + row * outStride, b + 8 * row, 8 * sizeof(T));
}

/// Copies the eight rows of a leaf into its own order.
template <typename T>
void rowsToLeaf(Axis axis, const T* rows, T* leaf)
{
    switch (axis) {
    case Axis::X: std::memcpy(leaf, rows, kLeafVoxels * sizeof(T)); break;
    case Axis::Y:
        for (int y = 0; y < 8; ++y) {
            for (int x = 0; x < 8; ++x) {
                std::memcpy(leaf + 64 * x + 8 * y, rows + 64 * y + 8 * x, 8 * sizeof(T));
            }
        }
        break;
    case Axis::Z:
        for (int x = 0; x < 8; ++x) transpose8x8(rows + 8 * x, 64, leaf + 64 * x, 8);
    }
}

/// The rows [first, last) of `count`; all three are multiples of kLeafDim.
struct RowRange {
    int first, last, count;
};

/// Memory that the kernels of EnvelopeSearch-inl.h use again from run to run, one a thread.
struct EnvelopeScratch {
    std::vector<int> reach;                 ///< by leaf: how many rows away a better row can be
    std::vector<int64_t> largest, smallest; ///< by leaf: its values; smallest of object voxels
    RowBuffer<int32_t> keys;                ///< rows that a kernel made of its input
    RowBuffer<int64_t> wideKeys;            ///< the same

    void resize(std::size_t leaves)
    {
        reach.resize(leaves);
        largest.resize(leaves);
        smallest.resize(leaves);
    }
};

} // namespace openvdb_spheretree::detail
