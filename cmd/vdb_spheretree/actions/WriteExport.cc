// SPDX-License-Identifier: Apache-2.0
#include "WriteExport.h"

#include "line/Length.h"
#include "line/Plan.h"
#include "GivenSpheres.h"
#include "ObjectChoice.h"
#include "WriteChart.h"

#include <openvdb/Exceptions.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/Trimmed.h>
#include <openvdb_spheretree/export/ExportTree.h>
#include <openvdb_spheretree/export/NanoVdbWriter.h>
#include <openvdb_spheretree/tree/SphereBudget.h>

#include <algorithm>
#include <numeric>

namespace command {

namespace {

namespace spheretree = openvdb_spheretree;
using spheretree::ExportFormat;
using spheretree::ExportFrame;
using spheretree::ExportSettings;

std::string joined(const std::vector<std::string>& words, const char* separator)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
    return text;
}

/// @return the names of all formats, each once.
std::vector<std::string> formatNames()
{
    std::vector<std::string> names;
    for (const ExportFormat& format : spheretree::exportFormats()) {
        if (std::find(names.begin(), names.end(), format.name) == names.end()) {
            names.push_back(format.name);
        }
    }
    return names;
}

/// @return the extensions of the format of that name.
std::string extensionsOf(const std::string& name)
{
    if (name == kChartFormat) return ".svg, .png, .csv";
    std::vector<std::string> all;
    for (const ExportFormat& format : spheretree::exportFormats()) {
        if (format.name == name) {
            all.insert(all.end(), format.extensions.begin(), format.extensions.end());
        }
    }
    return joined(all, ", ");
}

ExportFrame frameOf(const std::string& frame)
{
    if (frame == "centroid") return ExportFrame::Centroid;
    return frame == "principal" ? ExportFrame::Principal : ExportFrame::World;
}

/// Stages know two axes that may be up; pictures any direction.
spheretree::UpAxis upOf(const ActionCall& call)
{
    const std::array<double, 3> up = call.vector("up");
    if (up == std::array<double, 3>{0, 0, 1}) return spheretree::UpAxis::Z;
    if (up == std::array<double, 3>{0, 1, 0}) return spheretree::UpAxis::Y;
    throwUsage("up=" + call.text("up") + ": in files of other tools y or z is up (0,1,0 or 0,0,1)");
}

ExportSettings settingsOf(const ActionCall& call)
{
    ExportSettings settings;
    if (call.given("level")) settings.level = int(call.integer("level"));
    if (call.given("spheres")) settings.spheres = call.integer("spheres");
    settings.frame = frameOf(call.text("frame"));
    settings.metersPerUnit = metresOfUnit(call.text("units")).value();
    settings.scale = call.real("scale") / settings.metersPerUnit;
    settings.up = upOf(call);
    settings.density = call.real("density");
    settings.framesPerSecond = call.real("fps");
    if (call.given("name")) settings.name = call.text("name");
    return settings;
}

/// @throw CommandError (input) if nothing on the stack is the tree's object
spheretree::MassProperties massOfObject(StackItem& item, const std::string& path, Session& session)
{
    placeInObject(item, session);
    const auto object = knownObject(item, session);
    const auto mass =
        object ? spheretree::massProperties(*object, &session.progress) : std::nullopt;
    if (mass) return *mass;
    throwInput(path
        + ": mass=object: no grid on the stack has the voxels that the tree was built of: "
          "read it as well, or write the file where the tree is built");
}

std::vector<StackItem*> treesOf(
    const std::vector<StackItem*>& items, const ExportFormat& format, const std::string& path)
{
    std::vector<StackItem*> trees;
    for (StackItem* item : items) {
        if (item->anyTree()) trees.push_back(item);
    }
    const bool anyEmpty = std::any_of(
        trees.begin(), trees.end(), [](const StackItem* item) { return bool(item->emptyTree); });
    if (anyEmpty && !format.empty) {
        throwInput(path + ": " + format.name
            + " has no room for a frame without spheres: leave it out, by empty=skip where the "
              "tree is built or by frames= where it is read");
    }
    if (trees.empty()) {
        throwInput(path + " holds spheres of a tree, and there is none: put -spheretree before");
    }
    if (trees.size() > 1 && !format.samples && !format.links) {
        throwInput(path + " holds one sphere-tree, and there are " + std::to_string(trees.size())
            + ": choose with vdb="
            + (format.link ? "; .yml, .xrdf and .srdf hold several links" : ""));
    }
    return trees;
}

bool areFramesRising(const std::vector<StackItem*>& trees)
{
    const auto isNotLater = [](const StackItem* before, const StackItem* item) {
        return !before->frame || !item->frame || *item->frame <= *before->frame;
    };
    return std::adjacent_find(trees.begin(), trees.end(), isNotLater) == trees.end();
}

/// @return what is typed, without blanks around.
std::vector<std::string> typedLinks(const ActionCall& call)
{
    std::vector<std::string> links = call.list("link");
    for (std::string& link : links) link = spheretree::detail::trimmed(link, " \t\r\n");
    return links;
}

/// @return the link of each tree: as it is typed, or of several what they are called; empty: what the library calls it.
std::vector<std::string> linksOf(
    const ActionCall& call, const std::string& path, const std::vector<StackItem*>& trees)
{
    if (call.given("link")) return typedLinks(call);
    if (trees.size() == 1) return {};
    std::vector<std::string> links = distinctNames({trees.begin(), trees.end()});
    for (std::size_t i = 0; i < links.size(); ++i) {
        const std::string file = trees[i]->fileStem();
        const bool hasOwn = spheretree::hasOwnName(*trees[i]->anyTree());
        const bool isFree = std::count(links.begin(), links.end(), file) == 0;
        if (!hasOwn && !file.empty() && isFree) links[i] = file;
        if (links[i].empty()) {
            throwInput(path + ": several sphere-trees are called '" + oneLine(trees[i]->name(), 60)
                + "', and each is a link of its own: name the links with link=A,B, or the trees "
                  "with -spheretree name=");
        }
    }
    return links;
}

/// Shows where the order of trees is another than was meant.
void noteLinks(const std::vector<std::string>& links, const std::string& path,
    const std::vector<StackItem*>& trees, Session& session)
{
    constexpr std::size_t kNamed = 20;
    std::string all;
    for (std::size_t i = 0; i < std::min(kNamed, links.size()); ++i) {
        const std::string tree = trees[i]->name();
        all += (all.empty() ? "'" : ", '") + oneLine(links[i], 60) + "'"
            + (tree == links[i] ? "" : " (sphere-tree '" + oneLine(tree, 60) + "')");
    }
    session.note(path + ": its links are " + all + (links.size() > kNamed ? ", ..." : ""));
}

/// Trees of several names are samples of one thing only if each is of a later frame, or if the line says so.
void requireOneThing(
    const ActionCall& call, const std::string& path, const std::vector<StackItem*>& trees)
{
    if (call.given("start") || areFramesRising(trees)) return;
    for (const StackItem* item : trees) {
        if (item->name() == trees.front()->name()) continue;
        throwInput(path + " holds one sphere-tree over time, and there are '"
            + oneLine(trees.front()->name(), 60) + "' and '" + oneLine(item->name(), 60)
            + "': choose by name with vdb=, or say with start= that they are samples of one");
    }
}

/// @return the times of several trees: one after the other from start= on; else the numbers of their frames, if these
///         rise; else from 1 on.
std::vector<double> sampleTimesOf(const ActionCall& call, const std::vector<StackItem*>& trees)
{
    std::vector<double> times;
    for (const StackItem* item : trees) {
        const bool isLater = item->frame && (times.empty() || double(*item->frame) > times.back());
        if (call.given("start") || !isLater) break;
        times.push_back(double(*item->frame));
    }
    if (times.size() == trees.size()) return times;
    const double start = call.given("start") ? call.real("start") : 1;
    times.resize(trees.size());
    std::iota(times.begin(), times.end(), start);
    return times;
}

/// Options of trees say nothing of grids.
void requireNoOptions(const ActionCall& call, const std::string& path)
{
    std::vector<std::string> names = {"level", "up"};
    for (const OptionSpec& option : exportOptions()) names.push_back(option.name);
    for (const std::string& name : names) {
        if (name == "format" || !call.given(name)) continue;
        throwInput(path + ": " + name + " is for sphere-trees, and there is none to write");
    }
}

/// The camera of a picture has a direction that is up.
bool isTakenByPicture(const ActionCall& call, const std::string& option, const std::string& path)
{
    return option == "up" && isPicture(fileKind(path)) && !isChart(call, path);
}

/// Says which options mean nothing to a file, unless another file of the line takes them.
void noteIdleOptions(
    const ActionCall& call, const std::string& path, const ExportFormat& format, Session& session)
{
    const auto files = call.list("files");
    for (const spheretree::ExportOption& option : spheretree::exportOptionsOfSome()) {
        if (!call.given(option.name) || format.*option.takes) continue;
        const bool isTaken = std::any_of(files.begin(), files.end(), [&](const std::string& file) {
            const ExportFormat* const other = exportFormatOf(call, file);
            return other ? other->*option.takes : isTakenByPicture(call, option.name, file);
        });
        if (isTaken) continue;
        session.note(path + ": " + spheretree::idleOptionNote(option, format, path));
    }
}

/// NanoVDB holds grids, too: they are written where there is no tree.
/// @return whether they were
bool wroteGrids(const ActionCall& call, const std::string& path,
    const std::vector<StackItem*>& items, Session& session, std::ostream& out)
{
    std::vector<openvdb::SharedPtr<openvdb::GridBase>> grids;
    for (const StackItem* item : items) {
        if (item->anyTree()) return false;
        if (item->grid) grids.push_back(item->grid);
    }
    if (grids.empty()) return false;
    requireNoOptions(call, path);
    spheretree::writeNanoVdb(grids, out, &session.progress);
    return true;
}

/// Readers show the sample before where there is none.
void noteSkipped(const std::string& path, Session& session)
{
    constexpr std::size_t kNamed = 6;
    const std::vector<std::string>& frames = session.skippedFrames;
    if (frames.empty()) return;
    const std::vector<std::string> named(
        frames.begin(), frames.begin() + std::ptrdiff_t(std::min(kNamed, frames.size())));
    session.note(path + ": no sample of " + joined(named, ", ")
        + (frames.size() > kNamed ? ", ..." : "")
        + ", skipped as there is no object: what is shown before stays; with empty=write it goes");
}

} // namespace

std::vector<OptionSpec> exportOptions()
{
    std::vector<std::string> units;
    for (const auto& unit : unitsOfLength()) units.push_back(unit.first);
    // The first choice is the default: none.
    std::vector<std::string> formats = formatNames();
    formats.emplace_back(kChartFormat);
    OptionSpec format =
        choice("format", formats, "which kind of file, where the extension means several; below");
    format.fallback.clear();
    OptionSpec unit = choice(
        "units", units, "files of other tools: the unit of their numbers, of metres in the tree");
    unit.fallback = "m";
    return {format,
        integer("spheres", "", 1, spheretree::SphereBudget::kMaxSpheres,
            "files of other tools: write the finest level with at most so many spheres, or the cut "
            "of a tree with cuts=1"),
        unit, real("scale", "1", 1e-30, 1e30, "files of other tools: make everything larger"),
        choice("frame", {"world", "centroid", "principal"},
            "files of other tools: where their origin is: that of the tree, the center of mass of "
            "the spheres, or that with the principal axes for axes"),
        list("link", "object",
            "files of robots: the link that the spheres belong to; of several trees that of each "
            "(by default what they are called)"),
        text("name", "",
            "files of other tools: the name of the robot, model or prim (by default "
            "that of the tree; where it has none of its own, a robot has that of the file)"),
        choice("mass", {"spheres", "object"},
            "files with a mass: of the union of the spheres, or of the object's voxels"),
        real("density", "1000", 1e-30, 1e30,
            "files with a mass: that of a cubed unit of the file; water has 1000 in metres"),
        real("start", "", -1e9, 1e9,
            ".usda of several trees, which are samples over time: the time of the first, and 1 "
            "more for each that follows (by default the numbers of their frames, or from 1 on)"),
        real("fps", "24", 1e-3, 1e6,
            ".usda of several trees: how many of their frames a second has")};
}

std::vector<std::pair<std::string, std::string>> exportFormatDocs()
{
    std::vector<std::pair<std::string, std::string>> docs;
    for (const ExportFormat& format : spheretree::exportFormats()) {
        docs.emplace_back(joined(format.extensions, " "),
            (format.byExtension ? "" : "format=" + format.name + ": ") + format.readers + ": "
                + format.keeps);
    }
    return docs;
}

const ExportFormat* exportFormatOf(const ActionCall& call, const std::string& path)
{
    const std::string extension = spheretree::detail::lowerExtension(path);
    if (call.given("format")) {
        if (const auto* named = spheretree::findExportFormat(extension, call.text("format"))) {
            return named;
        }
    }
    return spheretree::findExportFormat(extension);
}

void checkExportOptions(const ActionCall& call)
{
    bool any = false, isNamed = false;
    for (const std::string& path : call.list("files")) {
        const ExportFormat* const format = exportFormatOf(call, path);
        any |= format != nullptr;
        if (format && !format->missing.empty()) throwUsage(path + ": " + format->missing);
        isNamed |= format ? format->name == call.text("format")
                          : isChart(call, path) && call.text("format") == kChartFormat;
    }
    for (const OptionSpec& option : exportOptions()) {
        if (any || !call.given(option.name) || option.name == "format") continue;
        throwUsage("option " + option.name
            + " is for files of other tools, and none is written (-help write lists them)");
    }
    if (call.given("format") && !isNamed) {
        throwUsage("format=" + call.text("format") + " is for files that end in "
            + extensionsOf(call.text("format")) + ", and none is written");
    }
    if (call.given("level") && call.given("spheres"))
        throwUsage("level and spheres exclude each other");
    if (any) settingsOf(call);
}

void writeExport(const ActionCall& call, const std::string& path,
    const std::vector<StackItem*>& items, Session& session, std::ostream& out)
{
    const ExportFormat& format = *exportFormatOf(call, path);
    try {
        if (format.name == "nanovdb" && wroteGrids(call, path, items, session, out)) return;
    } catch (const openvdb::ValueError&) {
        rethrowNamed(path, kInput);
    }
    const auto chosen = treesOf(items, format, path);
    noteIdleOptions(call, path, format, session);
    if (format.samples) requireOneThing(call, path, chosen);
    ExportSettings settings = settingsOf(call);
    if (format.link) settings.links = linksOf(call, path, chosen);
    if (format.mass && call.text("mass") == "object") {
        settings.mass = massOfObject(*chosen.front(), path, session);
    }
    std::vector<const spheretree::SphereTree*> trees;
    for (const StackItem* item : chosen) trees.push_back(item->anyTree());
    if (settings.name.empty()) {
        settings.name = spheretree::exportNameFor(trees, format, isStdout(path) ? "" : path);
    }
    if (format.samples) settings.sampleTimes = sampleTimesOf(call, chosen);
    if (format.samples && trees.size() > 1) {
        using spheretree::detail::shortNumber;
        session.note(path + ": " + std::to_string(trees.size())
            + " sphere-trees are samples over time, from "
            + shortNumber(settings.sampleTimes.front()) + " to "
            + shortNumber(settings.sampleTimes.back()));
        noteSkipped(path, session);
    }
    try {
        const auto notes = exportTrees(trees, format, settings, out, &session.progress);
        for (const std::string& note : notes) session.note(path + ": " + note);
        if (format.links && trees.size() > 1) {
            noteLinks(settings.links, path, chosen, session);
        }
    } catch (const openvdb::ValueError&) { // of what the format cannot hold
        rethrowNamed(path, kInput);
    }
}

} // namespace command
