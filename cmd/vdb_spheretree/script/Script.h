// SPDX-License-Identifier: Apache-2.0
/// @file Script.h
/// @brief A command line with its loops unrolled: what is done, action by action, and what is known of it
/// before.
///
/// A value that asks for what is on the stack (`{0:voxelCount}`) is *open* until its action is reached.
/// So are the test of an -if that does, and files with such names: they are checked then.

#pragma once

#include "expression/Variables.h"
#include "line/Action.h"
#include "line/Plan.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace command {

struct Frame;

struct Step {
    enum class Kind { Action, Loop, If };

    Kind kind = Kind::Action;
    ActionCall call;                     ///< the action; of loops, what begins them
    bool isChecked = true;               ///< with all else before any work
    bool isLost = false;                 ///< no later action gives out what it makes
    size_t place = 0;                    ///< on the line
    std::optional<int64_t> number = {};  ///< of its frame; nothing outside of loops
    std::vector<Assignment> stored = {}; ///< variables that its values have stored
    std::vector<Frame> frames = {};      ///< of a loop; of an -if what is done if its test holds
    std::string variable = {};           ///< of a loop
    bool isSequence = false;             ///< a loop without an -end, each frame for itself
    std::string note = {};               ///< to be said before
};

/// One turn of a loop.
struct Frame {
    std::string name; ///< such as `i=3`
    std::vector<Assignment> variables;
    std::vector<Step> steps;
};

struct Script {
    Plan plan;
    std::vector<Step> steps;
};

/// @brief Unroll the loops of a line, and check everything that can be checked before any work.
/// @throw CommandError
Script scriptOf(const std::vector<ActionCall>& line);

} // namespace command
