// SPDX-License-Identifier: Apache-2.0
/// @file LoopValues.h
/// @brief The values that the variable of a loop goes through.

#pragma once

#include "line/Action.h"

#include <string>
#include <vector>

namespace command {

/// The most turns of all loops of a line together, and actions in them.
constexpr size_t kMostSteps = 100000;

struct LoopValues {
    std::string variable;
    std::vector<std::string> values;
};

/// @param call  -for, -each or -files, without open values
/// @throw CommandError (usage; input of a folder that cannot be read)
LoopValues loopValues(const ActionCall& call);

} // namespace command
