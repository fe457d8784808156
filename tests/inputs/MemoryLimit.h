// SPDX-License-Identifier: Apache-2.0
/// @file MemoryLimit.h
/// @brief A limit on the addresses of this process while a part of it runs. Nothing under sanitizers, whose process
/// has terabytes of them.

#pragma once

#include <cstdint>

#include <sys/resource.h>

namespace spheretree_test {

/// @return how many bytes of addresses this process has; 0 where that cannot be told.
uint64_t bytesOfAddresses();

/// Holds until it is destroyed; then there is the limit from before again.
class MemoryLimit {
public:
    /// @param bytes  of addresses in all; 0, or more than the process may have at most: no limit
    explicit MemoryLimit(uint64_t bytes);
    ~MemoryLimit();
    MemoryLimit(const MemoryLimit&) = delete;
    MemoryLimit& operator=(const MemoryLimit&) = delete;

private:
    rlimit mBefore{};
    bool mIsSet = false;
};

} // namespace spheretree_test
