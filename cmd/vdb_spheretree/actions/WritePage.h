// SPDX-License-Identifier: Apache-2.0
/// @file WritePage.h
/// @brief The pages of -write: their options, and the object that is shown with a tree.

#pragma once

#include "session/Session.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace command {

std::vector<OptionSpec> pageOptions();

/// @throw CommandError (usage) if they are given and no page is written
void checkPageOptions(const ActionCall& call);

/// @brief Write the only sphere-tree of @a items as a page, with its object if that is at hand.
/// @param path  for messages
/// @throw CommandError (input) if there is no tree, or more than one, or it is too large
void writePage(const ActionCall& call, const std::string& path,
    const std::vector<StackItem*>& items, Session& session, std::ostream& out);

} // namespace command
