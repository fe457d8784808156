// SPDX-License-Identifier: Apache-2.0
#include "LargeArray.h"

#include <cstdint>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace openvdb_spheretree::detail {

namespace {

constexpr std::size_t kHugePage = std::size_t(1) << 21;

} // namespace

void wishHugePages(void* data, std::size_t bytes)
{
#ifdef MADV_HUGEPAGE
    const auto address = reinterpret_cast<std::uintptr_t>(data);
    const std::uintptr_t begin = (address + kHugePage - 1) / kHugePage * kHugePage;
    const std::uintptr_t end = (address + bytes) / kHugePage * kHugePage;
    // Only a wish: failure is fine.
    if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#else
    (void)data, (void)bytes;
#endif
}

void* allocateLarge(std::size_t bytes)
{
    constexpr std::size_t kCacheLine = 64;
    const std::size_t alignment = bytes >= 2 * kHugePage ? kHugePage : kCacheLine;
    const std::size_t size = (bytes / alignment + 1) * alignment;
    void* data = std::aligned_alloc(alignment, size);
    if (!data) throw std::bad_alloc();
    if (alignment == kHugePage) wishHugePages(data, size);
    return data;
}

} // namespace openvdb_spheretree::detail
