// SPDX-License-Identifier: Apache-2.0
/// @file AtomicExtremes.h
/// @brief The largest or smallest of what many threads see.

#pragma once

#include <atomic>

namespace openvdb_spheretree::detail {

/// Makes @a largest at least @a value.
template <typename T>
void raiseTo(std::atomic<T>& largest, T value)
{
    T seen = largest.load(std::memory_order_relaxed);
    while (value > seen && !largest.compare_exchange_weak(seen, value)) {}
}

/// Makes @a smallest at most @a value.
template <typename T>
void lowerTo(std::atomic<T>& smallest, T value)
{
    T seen = smallest.load(std::memory_order_relaxed);
    while (value < seen && !smallest.compare_exchange_weak(seen, value)) {}
}

} // namespace openvdb_spheretree::detail
