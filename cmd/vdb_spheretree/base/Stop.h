// SPDX-License-Identifier: Apache-2.0
/// @file Stop.h
/// @brief Whether whoever runs this process wants it to stop. Reading and writing ask.

#pragma once

namespace command {

/// @brief Ask for a stop; may be called by the handler of a signal.
/// @return whether nobody has before.
bool requestStop() noexcept;

/// @brief A second way to ask for a stop, for a process whose signals are not handled here: the
/// Python module, where each call has its own.
/// @param isStopped  called by the threads that read and write, often; null for none
void setStopQuestion(bool (*isStopped)()) noexcept;

/// @return whether a stop has been requested.
bool stopRequested();

/// @throw openvdb_spheretree::Interrupted if a stop has been requested
void throwIfStopped();

} // namespace command
