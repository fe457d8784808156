// SPDX-License-Identifier: Apache-2.0
/// @file ExportNames.h
/// @brief Whether a format can hold the names of a scene. Tests: TestExportNames.cc.

#pragma once

#include "ExportScene.h"

namespace openvdb_spheretree::detail {

/// @return whether a name can stand in the text of a format of robots.
bool holdsName(const ExportFormat& format, const std::string& name);

/// @param notes  receives what becomes of a name that is for people only
/// @throw openvdb::ValueError if readers would look for a name that the file cannot hold
void requireNames(
    const ExportScene& scene, const ExportFormat& format, std::vector<std::string>& notes);

} // namespace openvdb_spheretree::detail
