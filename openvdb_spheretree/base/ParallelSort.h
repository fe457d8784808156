// SPDX-License-Identifier: Apache-2.0
/// @file ParallelSort.h
/// @brief oneTBB's sort, made to stop when it is asked to.

#pragma once

#include "Parallel.h"

#include <tbb/parallel_sort.h>

#include <cstdint>
#include <functional>
#include <iterator>
#include <type_traits>
#include <utility>

namespace openvdb_spheretree::detail {

/// @brief Sort [begin, end) by @a less, by all threads. Each of them asks the interrupter once in
/// 2^18 comparisons: some milliseconds.
/// @throw Interrupted; the values are then of no use: some may be lost, and others there twice
template <typename Iterator, typename Less = std::less<>>
void parallelSort(
    Iterator begin, Iterator end, openvdb::util::NullInterrupter* interrupter, Less less = Less())
{
    using Value = typename std::iterator_traits<Iterator>::value_type;
    static_assert(std::is_trivially_copyable_v<Value>, "a sort may stop in the middle of a move");
    if (!interrupter) {
        tbb::parallel_sort(begin, end, std::move(less));
        return;
    }
    tbb::parallel_sort(begin, end, [interrupter, less](const auto& a, const auto& b) {
        // Of the thread, as a sort hands on copies of what it compares by.
        static thread_local uint32_t comparisons = 0;
        if (++comparisons % (1u << 18) == 0) checkInterrupt(interrupter);
        return less(a, b);
    });
}

} // namespace openvdb_spheretree::detail
