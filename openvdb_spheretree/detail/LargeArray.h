// SPDX-License-Identifier: Apache-2.0
/// @file detail/LargeArray.h
/// @brief Arrays of numbers that start uninitialised, on huge pages where the system has them.
///
/// The transforms write each of their values once and leave. For arrays of tens of megabytes,
/// getting 4 KiB pages one by one from the kernel took a quarter of their time.

#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace openvdb_spheretree {
namespace detail {

struct FreeLargeArray {
    void operator()(void* data) const { std::free(data); }
};

template <typename T>
using LargeArray = std::unique_ptr<T[], FreeLargeArray>;

/// @throw std::bad_alloc
template <typename T>
LargeArray<T> makeLargeArray(std::size_t size)
{
    constexpr std::size_t kHugePage = std::size_t(1) << 21;
    std::size_t alignment = 64;
    if (size * sizeof(T) >= 2 * kHugePage) alignment = kHugePage;
    const std::size_t bytes = (size * sizeof(T) / alignment + 1) * alignment;
    void* data = std::aligned_alloc(alignment, bytes);
    if (!data) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    if (alignment == kHugePage) madvise(data, bytes, MADV_HUGEPAGE); // a wish: failure is fine
#endif
    return LargeArray<T>(static_cast<T*>(data));
}

} // namespace detail
} // namespace openvdb_spheretree
