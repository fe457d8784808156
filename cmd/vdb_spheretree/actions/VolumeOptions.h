// SPDX-License-Identifier: Apache-2.0
/// @file VolumeOptions.h
/// @brief Options of -read for volumes and pictures: what these files do not say.

#pragma once

#include "line/Action.h"

#include <openvdb_spheretree/input/volume/VolumeFile.h>

namespace command {

/// Adds the options to those of -read.
void addVolumeOptions(ActionSpec& action);

/// @throw CommandError (usage) for values that are none, or that no file of the call is for; and for
///        a .raw without what it needs
void checkVolumeOptions(const ActionCall& call);

/// @return the options as settings; they have been checked.
openvdb_spheretree::VolumeSettings volumeSettings(const ActionCall& call);

} // namespace command
