// SPDX-License-Identifier: Apache-2.0
/// @file MotionAnswers.h
/// @brief -collide motion=1: when the second tree first touches the first one on its way from pose to pose.

#pragma once

#include "PairQuestion.h"

namespace command {

/// @throw CommandError (usage)
void checkMotion(const ActionCall& call);

/// @brief Ask, and give the answers: one for each way from a pose of the file to the next, or for that from where the tree
/// is to the pose that is typed.
/// @throw CommandError (input, output or check failed)
void giveMotionAnswers(const ActionCall& call, Session& session, const PairQuestion& question);

} // namespace command
