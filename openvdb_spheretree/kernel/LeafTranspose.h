// SPDX-License-Identifier: Apache-2.0
/// @file LeafTranspose.h
/// @brief The transpositions of LeafRows.h that every voxel goes through, as vector kernels.

#pragma once

#include "LeafRows.h"

#include <algorithm>
#include <cstdint>

namespace openvdb_spheretree::detail {

// The overloads for one type are vector kernels; the templates serve all other types.

/// @brief Rows across one of the axes y and z to rows across the other: [u][8 x + v] to
/// [v][8 x + u], for the 512 values of a leaf.
template <typename T>
void swapRows(const T* rows, T* swapped)
{
    for (int x = 0; x < 8; ++x) transpose8x8(rows + 8 * x, kLanes, swapped + 8 * x, kLanes);
}
void swapRows(const uint16_t* rows, uint16_t* swapped);
void swapRows(const int32_t* rows, int32_t* swapped);

/// @brief Rows across z to the leaf's own order: rowsToLeaf(Axis::Z).
template <typename T>
void rowsZToLeaf(const T* rows, T* leaf)
{
    rowsToLeaf(Axis::Z, rows, leaf);
}
void rowsZToLeaf(const int8_t* rows, int8_t* leaf);

/// @brief rowsToLeaf() to values of another type.
template <typename T, typename Value>
void rowsToLeafAs(Axis axis, const T* rows, Value* leaf)
{
    T values[kLeafVoxels];
    rowsToLeaf(axis, rows, values);
    std::copy(values, values + kLeafVoxels, leaf);
}

/// @brief rowsToLeafAs(Axis::Z), past the cache: for results that are read much later. @a leaf is
/// aligned to 16 bytes.
template <typename T, typename Value>
void streamRowsZToLeaf(const T* rows, Value* leaf)
{
    rowsToLeafAs(Axis::Z, rows, leaf);
}
void streamRowsZToLeaf(const uint16_t* rows, uint16_t* leaf);
void streamRowsZToLeaf(const uint16_t* rows, int32_t* leaf);

/// @brief rowsToLeaf(Axis::Y), past the cache as well.
template <typename T>
void streamRowsYToLeaf(const T* rows, T* leaf)
{
    rowsToLeaf(Axis::Y, rows, leaf);
}
void streamRowsYToLeaf(const int32_t* rows, int32_t* leaf);

} // namespace openvdb_spheretree::detail
