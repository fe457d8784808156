// SPDX-License-Identifier: Apache-2.0
/// @file WritePicture.h
/// @brief The pictures of -write: their options, and what is drawn.

#pragma once

#include "session/Session.h"

#include <openvdb_spheretree/picture/Picture.h>

#include <string>
#include <vector>

namespace command {

std::vector<OptionSpec> pictureOptions();

/// @brief Check these options as far as possible before any work.
/// @throw CommandError (usage)
void checkPictureOptions(const ActionCall& call);

/// @brief Draw the only sphere-tree of @a items or, if there is none, the object of the only grid.
/// @param path  for messages
/// @throw CommandError (input, or usage if the camera is not valid)
openvdb_spheretree::Picture pictureOf(const ActionCall& call, const std::string& path,
    const std::vector<StackItem*>& items, Session& session);

} // namespace command
