// SPDX-License-Identifier: Apache-2.0
/// @file Blocks.h
/// @brief Which -end belongs to which -for, -each, -files or -if.

#pragma once

#include "line/Action.h"

#include <cstddef>
#include <vector>

namespace command {

/// @return for each action that begins a block the place of its -end; for others nothing of use.
/// @throw CommandError (usage) if one is missing, or more than 16 are within each other
std::vector<size_t> endsOfBlocks(const std::vector<ActionCall>& line);

} // namespace command
