// SPDX-License-Identifier: Apache-2.0
/// @file ChildProcess.h
/// @brief Work of a library that may crash, in a process of its own.

#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace openvdb_spheretree::detail {

/// @brief Run @a work in a child process, and wait for it.
///
/// The child is a copy of this process with the calling thread alone. It writes nothing on its standard streams,
/// leaves no core, and ends with this process. Its signals are those of a new process.
/// @param work        what it returns comes back. It must not use threads, nor wait for a lock that another thread
///                    may hold
/// @param extraBytes  of address space, beyond what this process has: then std::bad_alloc, which comes back
/// @throw openvdb::IoError if it died, with how; or if no process could be made
/// @throw openvdb::IoError, std::bad_alloc  that @a work threw
/// @note Thread-safe. Costs about a millisecond, and more where this process is large.
std::string resultOfChild(const std::function<std::string()>& work, uint64_t extraBytes);

/// In a child: raises its limit of memory.
void allowMoreMemory(uint64_t bytes);

} // namespace openvdb_spheretree::detail
