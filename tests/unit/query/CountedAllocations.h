// SPDX-License-Identifier: Apache-2.0
/// @file CountedAllocations.h
/// @brief How often a thread asks for memory: operator new is replaced for the program of these tests.

#pragma once

namespace spheretree_test {

/// Counts what this thread allocates while it is there, but nothing below a sanitizer. One at a time.
class CountedAllocations {
public:
    CountedAllocations();
    ~CountedAllocations();
    CountedAllocations(const CountedAllocations&) = delete;
    CountedAllocations& operator=(const CountedAllocations&) = delete;

    int count() const;
};

/// @return how often ask() allocates.
template <typename Ask>
int allocationsOf(const Ask& ask)
{
    const CountedAllocations allocations;
    ask();
    return allocations.count();
}

} // namespace spheretree_test
