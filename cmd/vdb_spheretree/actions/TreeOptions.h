// SPDX-License-Identifier: Apache-2.0
/// @file TreeOptions.h
/// @brief The options of -spheretree, and the settings of the library that they stand for.

#pragma once

#include "line/Action.h"

#include <openvdb_spheretree/tree/SphereTreeSettings.h>

namespace command {

std::vector<OptionSpec> spheretreeOptions();

/// @throw openvdb::ValueError naming a value that is out of range, or contradicts another one
openvdb_spheretree::SphereTreeSettings settingsOf(const ActionCall& call);

/// @brief Everything that can be wrong with the options, before any work.
/// @throw CommandError (usage), openvdb::ValueError
void checkTreeOptions(const ActionCall& call);

} // namespace command
