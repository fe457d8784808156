// SPDX-License-Identifier: Apache-2.0
/// @file Sequence.h
/// @brief A sequence of files, `-read smoke_####.vdb`: what makes an action its begin, and its frames.

#pragma once

#include "expression/Variables.h"
#include "line/Action.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace command {

/// @return whether pictures of such names are the slices of one volume: frames of a sequence they are only where
///         frames= says so.
bool isStack(const ActionCall& call, const std::string& name);

/// @return the first name with a place for a number among the files that an action reads; nothing if there is
///         none.
/// @throw CommandError (usage)
std::optional<std::string> sequenceName(const ActionCall& call, const Variables& variables);

struct SequenceFrames {
    std::vector<int64_t> frames;
    std::string gaps; ///< a sentence, if some between are not there
};

/// @return the frames that the user has named, or else those for which there is a file.
/// @throw CommandError (usage; input if there is none), NeedsStack
SequenceFrames framesOfSequence(
    const ActionCall& call, const std::string& name, const Variables& variables);

} // namespace command
