// SPDX-License-Identifier: Apache-2.0
#include "LargeArray.h"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace openvdb_spheretree {
namespace detail {

void* allocateLarge(std::size_t bytes)
{
    constexpr std::size_t kCacheLine = 64, kHugePage = std::size_t(1) << 21;
    const std::size_t alignment = bytes >= 2 * kHugePage ? kHugePage : kCacheLine;
    const std::size_t size = (bytes / alignment + 1) * alignment;
    void* data = std::aligned_alloc(alignment, size);
    if (!data) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
    if (alignment == kHugePage) madvise(data, size, MADV_HUGEPAGE); // a wish: failure is fine
#endif
    return data;
}

} // namespace detail
} // namespace openvdb_spheretree
