// SPDX-License-Identifier: Apache-2.0
/// @file CountErrors.h
/// @brief The errors of a tree of the stack, counted where its object is at hand.

#pragma once

#include "session/Session.h"

namespace command {

/// @return whether errors of a level have not been counted, nor found to be out of reach.
bool lacksErrors(const openvdb_spheretree::SphereTree& tree);

/// @brief Find the object of a tree that was read from a file: the only grid on the stack that an object can be
/// made of, if it is that. What shows errors does without one, so nothing here is an error.
void findObject(StackItem& item, Session& session);

/// @brief Count what errors of a tree are lacking, if its object is known or found. Spheres that were read
/// are put into its frame.
void countErrors(StackItem& item, Session& session);

} // namespace command
