// SPDX-License-Identifier: Apache-2.0
/// @file Actions.h
/// @brief The specifications of all actions, which ActionTable.cc lists. They are documented in the
/// specifications themselves, and -help prints that.

#pragma once

#include "Action.h"

namespace command {

ActionSpec readAction();
ActionSpec generateAction();
ActionSpec mesh2lsAction();
ActionSpec resampleAction();
ActionSpec maskAction();
ActionSpec spheretreeAction();
ActionSpec statsAction();
ActionSpec checkAction();
ActionSpec collideAction();
ActionSpec distanceAction();
ActionSpec raycastAction();
ActionSpec containsAction();
ActionSpec levelAction();
ActionSpec spheres2maskAction();
ActionSpec spheres2lsAction();
ActionSpec writeAction();
ActionSpec printAction();
ActionSpec forAction();
ActionSpec eachAction();
ActionSpec filesAction();
ActionSpec ifAction();
ActionSpec endAction();
ActionSpec onerrorAction();
ActionSpec evalAction();
ActionSpec defaultAction();
ActionSpec configAction();
ActionSpec clearAction();
ActionSpec threadsAction();
ActionSpec quietAction();
ActionSpec verboseAction();
ActionSpec debugAction();
ActionSpec helpAction();
ActionSpec versionAction();
ActionSpec examplesAction();

} // namespace command
