// SPDX-License-Identifier: Apache-2.0
/// @file WriteExport.h
/// @brief The files of other tools that -write makes: their options, and what goes into them.

#pragma once

#include "line/Action.h"
#include "session/Session.h"

#include <openvdb_spheretree/export/ExportFormat.h>

#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace command {

std::vector<OptionSpec> exportOptions();

/// @return for -help: the extensions of each format, its name where that has to be said, who reads it and what
/// it keeps.
std::vector<std::pair<std::string, std::string>> exportFormatDocs();

/// @return the format of a file of another tool, by its extension and format=; null for other files.
const openvdb_spheretree::ExportFormat* exportFormatOf(
    const ActionCall& call, const std::string& path);

/// @brief Check these options as far as possible before any work.
/// @throw CommandError (usage)
void checkExportOptions(const ActionCall& call);

/// @brief Write the only sphere-tree of @a items, or all of them in a format that holds samples over time.
/// @param path  for messages
/// @throw CommandError (input)
void writeExport(const ActionCall& call, const std::string& path,
    const std::vector<StackItem*>& items, Session& session, std::ostream& out);

} // namespace command
