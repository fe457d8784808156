// SPDX-License-Identifier: Apache-2.0
/// @file SceneFrames.h
/// @brief The trees of the stack as bodies of a scene: where they are, frame by frame, and what they are called.

#pragma once

#include "line/Action.h"
#include "line/Plan.h"
#include "QueryOptions.h"
#include "session/Session.h"

#include <openvdb_spheretree/query/QueryScene.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace command {

using SceneBodies = std::vector<QueryBody>;

/// All bodies at one time.
struct SceneFrame {
    int64_t number = 0;
    std::vector<openvdb_spheretree::RigidTransform> poses; ///< by body
};

std::vector<OptionSpec> sceneOptions();
/// @return for -help: the columns of a table of poses of bodies.
std::vector<std::pair<std::string, std::string>> sceneColumnDocs();

/// @throw CommandError (usage, input or output)
void checkScene(const ActionCall& call, Plan& plan);

/// @return the bodies, without the pairs of ignore=.
/// @throw CommandError (input)
openvdb_spheretree::QueryScene sceneOf(
    const ActionCall& call, Session& session, const SceneBodies& bodies);

/// @return those of poses=, or the one in which the trees are where they are stored. A body stays where it was until a line
///         places it anew.
/// @throw CommandError (input)
std::vector<SceneFrame> framesOf(
    const ActionCall& call, Session& session, const SceneBodies& bodies);

/// @return what bodies are called: as of distinctNames(), or else by their ages.
std::vector<std::string> labelsOf(const Session& session, const SceneBodies& bodies);

} // namespace command
