// SPDX-License-Identifier: Apache-2.0
/// @file StatsReport.h
/// @brief What -stats says about a sphere-tree: as a table for people, and as JSON for programs.

#pragma once

#include "session/Session.h"
#include "StatsMass.h"

#include <string>
#include <utility>
#include <vector>

namespace command {

/// Radii and distances are in voxels of level 0, without padding.
struct LevelRadii {
    double smallest = 0, largest = 0;
};
LevelRadii radiiOf(
    const openvdb_spheretree::SphereTree& tree, const openvdb_spheretree::SphereTreeLevel& level);

/// @return how much of the object a level covers. Its error must have been counted.
double coveredPercent(
    const openvdb_spheretree::SphereTree& tree, const openvdb_spheretree::SphereTreeLevel& level);

/// @return the Dice coefficient of a level and the object: twice the voxels that both have, by those of the
///         one and of the other, 0 to 1. Its error must have been counted.
double diceOf(
    const openvdb_spheretree::SphereTree& tree, const openvdb_spheretree::SphereTreeLevel& level);

/// @return the seconds of every stage of the command line, by its name.
std::vector<std::pair<const char*, double>> stageSeconds(const Session& session);

/// @return the most memory that the process has held so far, in bytes.
int64_t peakBytes();

/// @return the table, several lines; where it goes to a terminal, in several parts if it is wider
///         than that.
std::string statsTable(
    const openvdb_spheretree::SphereTree& tree, const StatsMass& mass, const Session& session);

/// @return the levels as a CSV, a line each, in columns of the names that the JSON has for them. A cell
/// is empty where the JSON has null.
std::string statsCsv(const openvdb_spheretree::SphereTree& tree, const StatsMass& mass);

/// @return a JSON object of format `vdb_spheretree.stats.1`.
std::string statsJson(
    const openvdb_spheretree::SphereTree& tree, const StatsMass& mass, const Session& session);

} // namespace command
