// SPDX-License-Identifier: Apache-2.0
/// @file RememberedFiles.h
/// @brief Temporary files that have a name, for an end of the program that does not unwind.

#pragma once

namespace command {

/// @param path  must stay where it is in memory until it is forgotten. There is room for 64; of more,
///              the last are not remembered.
void rememberFile(const char* path) noexcept;
void forgetFile(const char* path) noexcept;

/// @brief Remove them; may be called by the handler of a signal.
void removeRememberedFiles() noexcept;

} // namespace command
