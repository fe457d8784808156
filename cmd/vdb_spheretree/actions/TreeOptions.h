// SPDX-License-Identifier: Apache-2.0
/// @file TreeOptions.h
/// @brief The options of -spheretree, and the library's settings that follow from them.

#pragma once

#include "line/Action.h"

#include <openvdb_spheretree/tree/SphereTreeSettings.h>

namespace command {

std::vector<OptionSpec> spheretreeOptions();

/// A `distance` with a unit of length is taken in metres: checkTreeOptions() has seen that the world is.
/// @throw openvdb::ValueError naming a value that is out of range, or that contradicts another
openvdb_spheretree::SphereTreeSettings settingsOf(const ActionCall& call);

/// @brief Check all options before any work.
/// @throw CommandError (usage), openvdb::ValueError
void checkTreeOptions(const ActionCall& call, Plan& plan);

/// @return which stage takes longest, and what would take less time.
LongWork longWorkOf(const ActionCall& call);

} // namespace command
