// SPDX-License-Identifier: Apache-2.0
#include "ExportTree.h"

#include "ExportBuffer.h"
#include "ExportNames.h"
#include "ExportScene.h"
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace openvdb_spheretree {

namespace {

void requireSettings(const ExportFormat& format, const ExportSettings& settings, std::size_t trees)
{
    if (trees == 0) OPENVDB_THROW(openvdb::ValueError, "there is no sphere-tree to write");
    if (trees > 1 && !format.samples && !format.links) {
        OPENVDB_THROW(
            openvdb::ValueError, format.name << " holds one sphere-tree, and there are " << trees);
    }
    if (settings.level && settings.spheres) {
        OPENVDB_THROW(openvdb::ValueError, "level and spheres exclude each other");
    }
    for (const auto& [name, value] : {std::pair("scale", settings.scale),
             std::pair("density", settings.density), std::pair("units", settings.metersPerUnit),
             std::pair("fps", settings.framesPerSecond)}) {
        if (std::isfinite(value) && value > 0) continue;
        OPENVDB_THROW(
            openvdb::ValueError, name << "=" << value << " is out of range: it is positive");
    }
}

/// Readers would take the spheres of one of two links of a name for all of it.
void requireLinks(const ExportFormat& format, const ExportSettings& settings, std::size_t trees)
{
    if (!format.link) return;
    if (settings.links.size() != trees) {
        OPENVDB_THROW(openvdb::ValueError,
            "there are " << settings.links.size() << " names of links for " << trees
                         << (trees == 1 ? " sphere-tree" : " sphere-trees"));
    }
    std::set<std::string> names;
    for (const std::string& link : settings.links) {
        if (link.empty()) OPENVDB_THROW(openvdb::ValueError, "link= names no link");
        if (names.insert(link).second) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "two sphere-trees are of the link " << detail::inQuotes(link) << ": give each its own");
    }
}

void requireTimes(const ExportSettings& settings, std::size_t trees)
{
    const auto& times = settings.sampleTimes;
    if (times.empty()) return;
    if (times.size() != trees) {
        OPENVDB_THROW(openvdb::ValueError,
            "there are " << times.size() << " times for " << trees << " sphere-trees");
    }
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (std::isfinite(times[i]) && (i == 0 || times[i] > times[i - 1])) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "time " << times[i] << " of sphere-tree " << i << " is not after the one before");
    }
}

} // namespace

std::string exportNameFor(const std::vector<const SphereTree*>& trees, const ExportFormat& format,
    const std::string& path)
{
    const std::string stem = std::filesystem::path(path).stem().string();
    const std::string& name = trees.front()->settings.name;
    const bool hasOwn = trees.size() == 1 && name != SphereTreeSettings().name;
    return format.link && !hasOwn && detail::holdsName(format, stem) ? stem : name;
}

std::vector<std::string> exportTree(const SphereTree& tree, const ExportFormat& format,
    const ExportSettings& settings, std::ostream& out, openvdb::util::NullInterrupter* interrupter)
{
    return exportTrees({&tree}, format, settings, out, interrupter);
}

std::vector<std::string> exportTrees(const std::vector<const SphereTree*>& trees,
    const ExportFormat& format, const ExportSettings& settings, std::ostream& out,
    openvdb::util::NullInterrupter* interrupter)
{
    requireSettings(format, settings, trees.size());
    requireLinks(format, settings, trees.size());
    requireTimes(settings, trees.size());
    std::vector<std::string> notes;
    std::vector<detail::ExportScene> scenes;
    for (std::size_t i = 0; i < trees.size(); ++i) {
        std::vector<std::string> more;
        scenes.push_back(detail::makeScene(*trees[i], format, settings, i, more, interrupter));
        for (const std::string& note : more) {
            const bool isOfALink = trees.size() > 1 && format.links;
            const std::string whose =
                isOfALink ? "link " + detail::inQuotes(settings.links[i]) + ": " : "";
            if (!std::count(notes.begin(), notes.end(), whose + note)) {
                notes.push_back(whose + note);
            }
        }
    }
    format.write(scenes, {out, interrupter});
    return notes;
}

} // namespace openvdb_spheretree
