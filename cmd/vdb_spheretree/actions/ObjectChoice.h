// SPDX-License-Identifier: Apache-2.0
/// @file ObjectChoice.h
/// @brief Which grid of the stack is the object that an action needs, and a tree's errors against
/// it.

#pragma once

#include "session/Session.h"

#include <openvdb_spheretree/input/Object.h>

namespace command {

/// @throw CommandError (input) if there is none, or more than one; for a mesh, it tells the remedy
StackItem& selectObjectGrid(Session& session, const std::string& ageOrName);

/// @brief The object of a grid of the stack, whose values may still be in its file.
/// @throw CommandError (input) as objectOf() throws; what is wrong with the file names it
openvdb::BoolGrid::Ptr objectOf(
    const StackItem& item, const openvdb_spheretree::ObjectSettings& settings, Session& session);

/// @brief Fill in the errors of a tree whose object is known, and count the time.
void computeErrors(StackItem& item, Session& session);

} // namespace command
