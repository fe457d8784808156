// SPDX-License-Identifier: Apache-2.0
#include "ExportTree.h"

#include "ExportBuffer.h"
#include "ExportNames.h"
#include "ExportScene.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace openvdb_spheretree {

namespace {

void requireSettings(const ExportFormat& format, const ExportSettings& settings, std::size_t trees)
{
    if (trees == 0) OPENVDB_THROW(openvdb::ValueError, "there is no sphere-tree to write");
    if (trees > 1 && !format.samples) {
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
    if (settings.link.empty()) OPENVDB_THROW(openvdb::ValueError, "link= names no link");
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

std::string exportNameFor(
    const SphereTree& tree, const ExportFormat& format, const std::string& path)
{
    const std::string stem = std::filesystem::path(path).stem().string();
    const bool hasOwn = tree.settings.name != SphereTreeSettings().name;
    return format.link && !hasOwn && detail::holdsName(format, stem) ? stem : tree.settings.name;
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
    std::vector<std::string> notes;
    std::vector<detail::ExportScene> samples;
    for (const SphereTree* tree : trees) {
        std::vector<std::string> more;
        samples.push_back(detail::makeScene(*tree, format, settings, more, interrupter));
        const std::size_t count = samples.size();
        const auto& times = settings.sampleTimes;
        samples.back().sample = times.empty() ? double(count) : times[count - 1];
        for (const std::string& note : more) {
            if (!std::count(notes.begin(), notes.end(), note)) notes.push_back(note);
        }
    }
    format.write(samples, {out, interrupter});
    return notes;
}

} // namespace openvdb_spheretree
