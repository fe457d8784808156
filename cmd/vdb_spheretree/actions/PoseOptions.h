// SPDX-License-Identifier: Apache-2.0
/// @file PoseOptions.h
/// @brief Where the second body of a question is: moved and turned by what is typed, or pose by pose by a file.

#pragma once

#include "line/Action.h"
#include "line/Plan.h"
#include "session/Session.h"

#include <openvdb_spheretree/query/RigidTransform.h>

#include <string>
#include <utility>
#include <vector>

namespace command {

std::vector<OptionSpec> poseOptions();
/// @return for -help: the columns of a table of poses.
std::vector<std::pair<std::string, std::string>> poseColumnDocs();

/// @throw CommandError (usage or input)
void checkPoses(const ActionCall& call, Plan& plan);

/// @return one pose or those of the file, in the unit of the trees.
/// @throw CommandError (input)
std::vector<openvdb_spheretree::RigidTransform> posesOf(const ActionCall& call, Session& session);

} // namespace command
