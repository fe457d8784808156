// SPDX-License-Identifier: Apache-2.0
/// @file Defaults.h
/// @brief -default: values of options for all actions after it.

#pragma once

#include "Action.h"

#include <vector>

namespace command {

/// @return the line, where each -default has given its values to the actions after it that have such an
///         option, and neither that nor one that excludes it.
std::vector<ActionCall> withDefaults(const std::vector<ActionCall>& line);

} // namespace command
