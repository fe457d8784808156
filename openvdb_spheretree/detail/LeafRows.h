// SPDX-License-Identifier: Apache-2.0
/// @file detail/LeafRows.h
/// @brief The 512 values of a leaf as rows across an axis, and back.
///
/// The kernels of both transforms sweep along one axis and treat the 64 lines of a run side by side,
/// one lane a line. A *row* is the 64 values at one position along the axis; a leaf has eight:
///
///     axis X: row x, lane 8 y + z (the leaf's own order)
///     axis Y: row y, lane 8 x + z
///     axis Z: row z, lane 8 x + y

#pragma once

#include "../LeafLayout.h"

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>

namespace openvdb_spheretree {
namespace detail {

constexpr int kLanes = 64; ///< values in a row

/// Rows of a run, with `margin` zero rows before the first and after the last. Grows, never shrinks;
/// aligned for any vector width.
template <typename T>
class RowBuffer {
public:
    /// @return the first row; @a count rows are usable, of undefined content.
    T* rows(std::size_t count, std::size_t margin = 0)
    {
        const std::size_t needed = (count + 2 * margin) * kLanes;
        if (needed > mCapacity) {
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

/// Copies the 512 values of a leaf into its eight rows.
template <typename From, typename To>
void leafToRows(Axis axis, const From* leaf, To* rows)
{
    if (axis == Axis::X) {
        for (int i = 0; i < kLeafVoxels; ++i) rows[i] = To(leaf[i]);
    } else if (axis == Axis::Y) {
        for (int x = 0; x < 8; ++x) {
            for (int y = 0; y < 8; ++y) {
                for (int z = 0; z < 8; ++z) rows[64 * y + 8 * x + z] = To(leaf[64 * x + 8 * y + z]);
            }
        }
    } else {
        for (int xy = 0; xy < 64; ++xy) {
            for (int z = 0; z < 8; ++z) rows[64 * z + xy] = To(leaf[8 * xy + z]);
        }
    }
}

/// Copies eight rows back into their leaf.
template <typename T>
void rowsToLeaf(Axis axis, const T* rows, T* leaf)
{
    if (axis == Axis::X) {
        std::memcpy(leaf, rows, kLeafVoxels * sizeof(T));
    } else if (axis == Axis::Y) {
        leafToRows(Axis::Y, rows, leaf); // swaps two coordinates: its own inverse
    } else {
        for (int xy = 0; xy < 64; ++xy) {
            for (int z = 0; z < 8; ++z) leaf[8 * xy + z] = rows[64 * z + xy];
        }
    }
}

} // namespace detail
} // namespace openvdb_spheretree
