// SPDX-License-Identifier: Apache-2.0
/// @file OpenCall.h
/// @brief The values of a call once all is known that they ask for, and the check of the call.

#pragma once

#include "expression/Expression.h"
#include "line/Action.h"
#include "line/Plan.h"

#include <cstdint>
#include <optional>

namespace command {

/// @param number  of the frame, for `####` in names; nothing outside of loops
/// @param stack   null before any work
/// @throw CommandError (usage; input of what is not on the stack), NeedsStack
ActionCall closedCall(const ActionCall& call, Variables& variables, std::optional<int64_t> number,
    const StackFacts* stack);

/// @brief Check what can be checked before the action runs: its options together, and its files.
/// @throw CommandError that names the action
void checkCall(const ActionCall& call, Plan& plan);

/// @return the test of an -if.
/// @throw CommandError (usage) that names it
bool testOf(const ActionCall& call);

} // namespace command
