// SPDX-License-Identifier: Apache-2.0
/// @file SceneAnswers.h
/// @brief -collide scene=1: which trees of the stack touch each other, where they are or frame by frame; and with motion=1,
/// on their ways from frame to frame.

#pragma once

#include "SceneFrames.h"

#include <openvdb_spheretree/query/Collide.h>

namespace command {

/// @brief Ask, and give the answers: a line for each pair that touches in a frame, and one for a frame in which none does.
/// @param bodies   of the scene
/// @param request  of each pair
/// @throw CommandError (input, output or check failed)
void giveSceneAnswers(const ActionCall& call, Session& session, const SceneBodies& bodies,
    const openvdb_spheretree::CollisionRequest& request);

/// @brief The same of the ways from each frame to the next: a line for each pair that touches on one, and when first.
/// @throw CommandError (input, output or check failed)
void giveSceneMotionAnswers(const ActionCall& call, Session& session, const SceneBodies& bodies);

} // namespace command
