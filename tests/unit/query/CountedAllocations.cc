// SPDX-License-Identifier: Apache-2.0
#include "CountedAllocations.h"

#include "support/Sanitizers.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace spheretree_test {
namespace {

thread_local bool tIsCounting = false;
thread_local int tCount = 0;

} // namespace

CountedAllocations::CountedAllocations()
{
    tCount = 0;
    tIsCounting = true;
}

CountedAllocations::~CountedAllocations() { tIsCounting = false; }

int CountedAllocations::count() const { return tCount; }

#if !SPHERETREE_TEST_SANITIZED // which has operators of its own

namespace {

void* memoryOrNull(std::size_t size)
{
    tCount += tIsCounting;
    return std::malloc(std::max<std::size_t>(size, 1));
}

void* memoryOrNull(std::size_t size, std::align_val_t alignment)
{
    tCount += tIsCounting;
    const std::size_t unit = std::size_t(alignment);
    return std::aligned_alloc(unit, std::max<std::size_t>((size + unit - 1) / unit, 1) * unit);
}

void* orThrow(void* memory)
{
    if (!memory) throw std::bad_alloc();
    return memory;
}

/// Not inlined: gcc warns of free() where it sees that new stands above it.
[[gnu::noinline]] void giveBack(void* memory) { std::free(memory); }

} // namespace
#endif

} // namespace spheretree_test

#if !SPHERETREE_TEST_SANITIZED
// The standard library's own operators of arrays call these.
using namespace spheretree_test;

void* operator new(std::size_t size) { return orThrow(memoryOrNull(size)); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return memoryOrNull(size); }
void* operator new(std::size_t size, std::align_val_t alignment)
{
    return orThrow(memoryOrNull(size, alignment));
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept
{
    return memoryOrNull(size, alignment);
}
void operator delete(void* memory) noexcept { giveBack(memory); }
void operator delete(void* memory, std::size_t) noexcept { giveBack(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { giveBack(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { giveBack(memory); }
#endif
