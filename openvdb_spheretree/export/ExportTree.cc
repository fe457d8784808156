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
        const std::size_t names = settings.links.size();
        OPENVDB_THROW(openvdb::ValueError,
            "link= has " << names << (names == 1 ? " name for " : " names for ") << trees
                         << (trees == 1 ? " sphere-tree" : " sphere-trees")
                         << ": give one for each");
    }
    std::set<std::string> names;
    for (const std::string& link : settings.links) {
        if (link.empty()) OPENVDB_THROW(openvdb::ValueError, "link= names no link");
        if (names.insert(link).second) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "two sphere-trees are of the link " << detail::inQuotes(link)
                                                << ": give each its own by link=, or its own name");
    }
}

void requireTimes(const ExportFormat& format, const ExportSettings& settings, std::size_t trees)
{
    const auto& times = settings.sampleTimes;
    if (!format.samples || times.empty()) return;
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

std::vector<std::string> eachOnce(const std::vector<std::vector<std::string>>& notes)
{
    std::vector<std::string> all;
    for (const auto& some : notes) {
        for (const std::string& note : some) {
            if (!std::count(all.begin(), all.end(), note)) all.push_back(note);
        }
    }
    return all;
}

std::string ofLink(const std::string& link) { return "link " + detail::inQuotes(link) + ": "; }

/// @return what holds of all links once, the rest with the link that it is of.
std::vector<std::string> notesOfLinks(
    std::vector<std::vector<std::string>> notes, const std::vector<std::string>& links)
{
    const std::vector<std::vector<std::string>> own = notes;
    for (std::size_t i = 0; i < notes.size(); ++i) {
        for (std::string& note : notes[i]) {
            const bool isOfAll = std::all_of(own.begin(), own.end(),
                [&](const auto& some) { return std::count(some.begin(), some.end(), note) > 0; });
            if (!isOfAll) note.insert(0, ofLink(links[i]));
        }
    }
    return eachOnce(notes);
}

} // namespace

bool hasOwnName(const SphereTree& tree) { return tree.settings.name != SphereTreeSettings().name; }

std::string exportNameFor(const std::vector<const SphereTree*>& trees, const ExportFormat& format,
    const std::string& path)
{
    const bool areSeveral = trees.size() > 1;
    const std::string& name = trees.front()->settings.name;
    if (path.empty()) return format.links && areSeveral ? "robot" : name;
    const std::string stem = std::filesystem::path(path).stem().string();
    const bool hasOwn = !areSeveral && hasOwnName(*trees.front());
    return format.link && !hasOwn && detail::holdsName(format, stem) ? stem : name;
}

std::vector<std::string> linksOf(
    const std::vector<const SphereTree*>& trees, const ExportFormat& format)
{
    const bool isCalledAfterTree = format.links && hasOwnName(*trees.front());
    if (trees.size() == 1 && !isCalledAfterTree) return {"object"};
    std::vector<std::string> links;
    for (const SphereTree* tree : trees) links.push_back(tree->settings.name);
    return links;
}

std::vector<std::string> exportTree(const SphereTree& tree, const ExportFormat& format,
    const ExportSettings& settings, std::ostream& out, openvdb::util::NullInterrupter* interrupter)
{
    return exportTrees({&tree}, format, settings, out, interrupter);
}

std::vector<std::string> exportTrees(const std::vector<const SphereTree*>& trees,
    const ExportFormat& format, const ExportSettings& wanted, std::ostream& out,
    openvdb::util::NullInterrupter* interrupter)
{
    requireSettings(format, wanted, trees.size());
    ExportSettings settings = wanted;
    if (settings.links.empty()) settings.links = linksOf(trees, format);
    requireLinks(format, settings, trees.size());
    requireTimes(format, settings, trees.size());
    const bool areLinks = trees.size() > 1 && format.links;
    std::vector<std::vector<std::string>> notes(trees.size());
    std::vector<detail::ExportScene> scenes;
    std::optional<detail::FileFrame> frameOfSamples;
    for (std::size_t i = 0; i < trees.size(); ++i) {
        try {
            scenes.push_back(detail::makeScene(
                *trees[i], format, settings, i, frameOfSamples, notes[i], interrupter));
        } catch (const openvdb::ValueError& error) {
            if (!areLinks) throw;
            OPENVDB_THROW(
                openvdb::ValueError, ofLink(settings.links[i]) << detail::messageOf(error));
        }
    }
    format.write(scenes, {out, interrupter});
    return areLinks ? notesOfLinks(notes, settings.links) : eachOnce(notes);
}

} // namespace openvdb_spheretree
