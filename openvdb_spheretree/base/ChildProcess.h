// SPDX-License-Identifier: Apache-2.0
/// @file ChildProcess.h
/// @brief Work of a library that may crash, or never end, in a process of its own.

#pragma once

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <functional>
#include <string>

namespace openvdb_spheretree::detail {

/// What a child may take; where 0 stands, only what limits this process limits it.
struct ChildLimits {
    uint64_t bytes = 0;   ///< of address space, beyond what this process has
    uint64_t seconds = 0; ///< of processor time, counted from its start
};

/// @brief Run @a work in a child process, and wait for it.
///
/// The child is a copy of this process with the calling thread alone. It writes nothing on its standard streams,
/// leaves no core, and ends with this process, or with this call. It ignores signals that ask for an end, as Ctrl-C sends
/// them to both: this process decides. All others are those of a new process.
/// @param work    what it returns comes back. It must not use threads, nor wait for a lock that another thread
///                may hold
/// @param limits  beyond the memory: std::bad_alloc, which comes back; beyond the time: the child is ended
/// @param interrupter  is asked some times a second, and before a death is an error; may be null
/// @throw openvdb::IoError if it died, or did not end, with how; or if no process could be made
/// @throw openvdb::IoError, std::bad_alloc  that @a work threw
/// @throw Interrupted if the interrupter said so; the child is gone then
/// @note Thread-safe. Costs about a millisecond, and more where this process is large.
std::string resultOfChild(const std::function<std::string()>& work, const ChildLimits& limits,
    openvdb::util::NullInterrupter* interrupter = nullptr);

/// In a child: raises its limits by these.
void allowMore(const ChildLimits& limits);

} // namespace openvdb_spheretree::detail
