// SPDX-License-Identifier: Apache-2.0
/// @file TreeExport.cc
/// @brief Sphere-trees to the files of other tools: the same bytes as the command writes.

#include "Call.h"
#include "Errors.h"
#include "Tree.h"
#include "Volume.h"

#include "files/AtomicFile.h"
#include "line/Length.h"
#include "line/Plan.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/export/ExportTree.h>
#include <openvdb_spheretree/measure/MassProperties.h>

#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace py = pybind11;

namespace binding {

namespace spheretree = openvdb_spheretree;
using spheretree::ExportFormat;
using spheretree::ExportSettings;

namespace {

/// @return which function of trees writes it, in brackets; empty if none does.
std::string whoWrites(const std::string& path)
{
    using command::FileKind;
    const FileKind kind = command::fileKind(path);
    if (kind == FileKind::Html) return " (Tree.write_html() writes pages)";
    const bool isSaved = kind == FileKind::Vdb || kind == FileKind::Csv || kind == FileKind::Json;
    const std::string extension = spheretree::detail::lowerExtension(path);
    return isSaved ? " (Tree.save() writes " + extension + " of trees)" : "";
}

const ExportFormat& formatOf(const std::string& path, const std::string& name)
{
    const std::string extension = spheretree::detail::lowerExtension(path);
    if (const ExportFormat* format = spheretree::findExportFormat(extension, name)) return *format;
    std::string known;
    for (const ExportFormat& format : spheretree::exportFormats()) {
        for (const std::string& its : format.extensions) {
            known += (known.empty() ? "" : ", ") + its
                + (format.byExtension ? "" : " (format=\"" + format.name + "\")");
        }
    }
    throw InputError(path + ": no file of another tool "
        + (name.empty() ? "ends so" : "of format=\"" + name + "\" ends so") + whoWrites(path)
        + "; those are " + known);
}

template <typename Value>
Value oneOf(const char* keyword, const std::string& word,
    std::initializer_list<std::pair<const char*, Value>> choices)
{
    std::string known;
    for (const auto& [name, value] : choices) {
        if (word == name) return value;
        known += (known.empty() ? "\"" : ", \"") + std::string(name) + "\"";
    }
    throw InputError(std::string(keyword) + "=\"" + word + "\" is none of " + known);
}

ExportSettings settingsOf(const py::dict& words, std::size_t trees)
{
    using Frame = spheretree::ExportFrame;
    using Up = spheretree::UpAxis;
    ExportSettings settings;
    settings.level = words["level"].cast<std::optional<int>>();
    settings.spheres = words["spheres"].cast<std::optional<int64_t>>();
    settings.frame = oneOf<Frame>("frame", words["frame"].cast<std::string>(),
        {{"world", Frame::World}, {"centroid", Frame::Centroid}, {"principal", Frame::Principal}});
    settings.up = oneOf<Up>("up", words["up"].cast<std::string>(), {{"y", Up::Y}, {"z", Up::Z}});
    const auto units = words["units"].cast<std::string>();
    const auto metres = command::metresOfUnit(units);
    if (!metres) throw InputError("units=\"" + units + "\" is no unit of length");
    settings.metersPerUnit = *metres;
    settings.scale = words["scale"].cast<double>() / *metres;
    settings.density = words["density"].cast<double>();
    settings.framesPerSecond = words["fps"].cast<double>();
    settings.links = words["links"].cast<std::vector<std::string>>();
    settings.name = words["name"].cast<std::string>();
    const auto start = words["start"].cast<double>();
    for (std::size_t i = 0; i < trees; ++i) settings.sampleTimes.push_back(start + double(i));
    return settings;
}

/// @throw InputError if it is not the object of that tree
spheretree::MassProperties massOfObject(const Volume& volume, const spheretree::SphereTree& tree,
    const std::string& path, Interrupter* interrupter)
{
    requireObjectOf(tree, volume, path + ": mass=\"object\"");
    return spheretree::massProperties(*volume.object, interrupter).value();
}

/// @return which options mean nothing to the format, a sentence each.
std::vector<std::string> idleOptions(
    const std::vector<std::string>& given, const ExportFormat& format, const std::string& path)
{
    std::vector<std::string> notes;
    for (const spheretree::ExportOption& option : spheretree::exportOptionsOfSome()) {
        const bool isGiven = std::count(given.begin(), given.end(), option.name) > 0;
        if (isGiven && !(format.*option.takes)) {
            notes.push_back(spheretree::idleOptionNote(option, format, path));
        }
    }
    return notes;
}

} // namespace

void bindTreeExport(py::module_& module)
{
    module.def("export",
        [](const std::vector<TreePtr>& trees, const std::string& path,
            const std::string& formatName, const py::dict& words,
            const std::vector<std::string>& given, const Volume* object,
            const py::object& progress) {
            const ExportFormat& format = formatOf(path, formatName);
            ExportSettings settings = settingsOf(words, trees.size());
            const auto said = resultOfCall(CallSettings{progress}, [&](Interrupter* interrupter) {
                std::vector<const spheretree::SphereTree*> all;
                for (const TreePtr& tree : trees) all.push_back(&tree->get());
                if (settings.name.empty() && !all.empty()) {
                    settings.name = spheretree::exportNameFor(all, format, path);
                }
                if (object && format.mass && !all.empty()) {
                    settings.mass = massOfObject(*object, *all.front(), path, interrupter);
                }
                std::vector<std::string> notes = idleOptions(given, format, path);
                command::AtomicFile::checkTarget(path);
                command::AtomicFile file(path);
                file.write([&](std::iostream& out) {
                    const auto more =
                        spheretree::exportTrees(all, format, settings, out, interrupter);
                    notes.insert(notes.end(), more.begin(), more.end());
                });
                if (!interrupter->wasInterrupted()) file.commit();
                return notes;
            });
            py::list notes;
            for (const std::string& note : said) notes.append(textOf(note)); // a name may be cut
            return notes;
        });
    module.def("export_formats", [] {
        py::list rows;
        for (const ExportFormat& format : spheretree::exportFormats()) {
            rows.append(py::make_tuple(
                format.name, format.extensions, format.byExtension, format.readers, format.keeps));
        }
        return rows;
    });
}

} // namespace binding
