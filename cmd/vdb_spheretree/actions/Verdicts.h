// SPDX-License-Identifier: Apache-2.0
/// @file Verdicts.h
/// @brief Verdicts of -collide in words: of one question, of many, and against what was expected.

#pragma once

#include "line/Action.h"

#include <openvdb_spheretree/query/Collide.h>

#include <cstdint>
#include <string>
#include <vector>

namespace command {

using Verdicts = std::vector<openvdb_spheretree::Verdict>;

const char* nameOf(openvdb_spheretree::Verdict verdict);

/// @param noun  of one question: pose, motion
/// @return how many there are of each, such as `3 poses: 1 apart, 2 touching`.
std::string summaryOf(const Verdicts& verdicts, const char* noun);

/// @param numbers  what questions are called; empty: 0, 1, 2 ...
/// @throw CommandError (check failed) that names the first question whose verdict is not that of expect=, if it is given
void requireExpected(const ActionCall& call, const Verdicts& verdicts, const char* noun,
    const std::vector<int64_t>& numbers = {});

} // namespace command
