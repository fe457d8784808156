// SPDX-License-Identifier: Apache-2.0
/// @file ObjectChoice.h
/// @brief The object that an action needs, from the stack; and the errors of a tree.

#pragma once

#include "session/Session.h"

#include <openvdb_spheretree/input/Object.h>

namespace command {

/// @return whether an item is a grid that bounds an object.
bool isObjectGrid(const StackItem& item);

/// @return the grid of the stack that an action makes its object of.
/// @param ageOrName  as for Stack::select()
/// @throw CommandError (input) if there is none, or more than one. If there is only a mesh, the
///        message says what to do.
StackItem& selectObjectGrid(Session& session, const std::string& ageOrName);

/// @return the same where nobody chose: null if there is none, or more than one of the newest action
///         that made any.
StackItem* onlyObjectGrid(Session& session);

/// @return the object of a grid of the stack. The grid's values may still be in its file.
/// @throw CommandError (input) if the library's objectOf() fails; the message names the grid
openvdb::BoolGrid::Ptr objectOf(
    const StackItem& item, const openvdb_spheretree::ObjectSettings& settings, Session& session);

/// @brief The object of a grid of the stack that @a tree was built of, where nobody says how: voxels by their
/// centers, or all that the solid meets, or that lie wholly in it.
/// @return the one that has the tree's voxels in its place of the world, or null
/// @throw as above, but for a grid that holds no object
openvdb::BoolGrid::Ptr objectOfTree(
    const StackItem& item, const openvdb_spheretree::SphereTree& tree, Session& session);

/// @return the object that the tree of an item was built of: known since then, or the grid of the stack that has its
///         voxels; null if there is none.
openvdb::BoolGrid::ConstPtr knownObject(const StackItem& item, Session& session);

/// @brief Compute the errors of a tree whose object is known, and add up the time.
void computeErrors(StackItem& item, Session& session);

} // namespace command
