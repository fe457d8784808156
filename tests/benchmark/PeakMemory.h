// SPDX-License-Identifier: Apache-2.0
/// @file PeakMemory.h
/// @brief How much memory becomes resident while something runs, beyond what was before.
///
/// The peak that Linux keeps of a process only grows. Writing 5 to /proc/self/clear_refs sets it back
/// to what is resident now (proc(5)), so stages of one process can be told apart. Memory that was
/// freed but is still resident would hide what a stage takes anew: it is given back first, as glibc
/// can (malloc_trim). Elsewhere nothing is known, and nothing is said.

#pragma once

#include <cstdint>
#include <optional>

namespace spheretree_benchmark {

class PeakMemory {
public:
    /// Starts at what is resident now.
    PeakMemory();
    /// @return bytes that were resident at most since then, beyond those at the start; empty if that
    ///         cannot be told. The system counts to some hundred kilobytes only.
    std::optional<int64_t> bytes() const;

private:
    std::optional<int64_t> mStart;
};

} // namespace spheretree_benchmark
