// SPDX-License-Identifier: Apache-2.0
/// @file SceneAnswers.h
/// @brief -collide scene=1: which trees of the stack touch each other, where they are or frame by frame.

#pragma once

#include "line/Action.h"
#include "line/Plan.h"
#include "QueryOptions.h"
#include "session/Session.h"

#include <openvdb_spheretree/query/Collide.h>

#include <string>
#include <utility>
#include <vector>

namespace command {

std::vector<OptionSpec> sceneOptions();
/// @return for -help: the columns of a table of poses of bodies.
std::vector<std::pair<std::string, std::string>> sceneColumnDocs();

/// @throw CommandError (usage, input or output)
void checkScene(const ActionCall& call, Plan& plan);

/// @brief Ask, and give the answers: a line for each pair that touches in a frame, and one for a frame in which none does.
/// @param bodies   of the scene
/// @param request  of each pair
/// @throw CommandError (input, output or check failed)
void giveSceneAnswers(const ActionCall& call, Session& session,
    const std::vector<QueryBody>& bodies, const openvdb_spheretree::CollisionRequest& request);

} // namespace command
