// SPDX-License-Identifier: Apache-2.0
/// @file StatsAction.cc
/// @brief -stats and -print: what is on the stack, in words and numbers.

#include "base/Errors.h"
#include "base/LastWords.h"
#include "base/Terminal.h"
#include "CountErrors.h"
#include "files/AtomicFile.h"
#include "line/Actions.h"
#include "report/StatsReport.h"

#include <openvdb/Grid.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/voxel/BoxSides.h>

#include <iostream>
#include <memory>
#include <utility>
#include <vector>

namespace command {

namespace {

constexpr const char* kTakes = "-stats writes .json or .csv, or to stdout with json=- or csv=-";

/// @return "json" or "csv", for a file that is named without saying which.
std::string formOf(const std::string& path)
{
    const std::string extension = openvdb_spheretree::detail::lowerExtension(path);
    if (extension == ".csv") return "csv";
    if (extension == ".json" || extension.empty()) return "json";
    throwUsage(path + ": " + kTakes);
}

/// @return the files of a call, each with its form.
std::vector<std::pair<std::string, std::string>> filesOf(const ActionCall& call)
{
    std::vector<std::pair<std::string, std::string>> files;
    for (const std::string& path : call.list("files")) files.emplace_back(path, formOf(path));
    for (const char* form : {"json", "csv"}) {
        if (call.given(form)) files.emplace_back(call.text(form), form);
    }
    return files;
}

void checkStats(const ActionCall& call, Plan& plan)
{
    for (const auto& [path, form] : filesOf(call)) {
        const FileKind kind = fileKind(path);
        const FileKind own = form == "csv" ? FileKind::Csv : FileKind::Json;
        if (kind != own && kind != FileKind::Unknown) {
            throwUsage(form + "=" + path + ": files of this name are something else; " + kTakes);
        }
        plan.addOutput(path);
    }
}

void runStats(const ActionCall& call, Session& session)
{
    StackItem& item = session.stack.selectTree(call.text("vdb"));
    session.noteIfUnverified(item);
    countErrors(item, session);
    if (call.flag("mass")) findObject(item, session);
    const StatsMass mass = massOf(item, call.flag("mass"), session);
    const auto outputs = filesOf(call);
    if (outputs.empty()) return session.print(statsTable(*item.tree, mass, session));
    std::vector<std::unique_ptr<AtomicFile>> files;
    for (const auto& [path, form] : outputs) {
        const std::string text =
            form == "csv" ? statsCsv(*item.tree, mass) : statsJson(*item.tree, mass, session);
        if (isStdout(path)) {
            session.print(text, standardOutput());
            continue;
        }
        files.push_back(std::make_unique<AtomicFile>(path));
        files.back()->write([&](std::ostream& out) { out << text; });
    }
    const Uninterrupted untilAllAreThere;
    throwIfStopped();
    for (const auto& file : files) file->commit();
}

/// One number of cubes, else three.
std::string voxelText(const openvdb::Vec3d& size)
{
    openvdb_spheretree::detail::TextStream out;
    out << size[0];
    if (size.eq(openvdb::Vec3d(size[0]), 1e-6 * size[0])) return out.str();
    out << " x " << size[1] << " x " << size[2] << " (-resample makes cubes)";
    return out.str();
}

void printGrid(std::ostream& out, const openvdb::GridBase& grid)
{
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    auto size = openvdb_spheretree::detail::sidesOf(box);
    if (grid.empty()) size = {0, 0, 0};
    out << ", " << counted(int64_t(grid.activeVoxelCount()), "active voxel") << " of "
        << voxelText(grid.voxelSize()) << ", box " << size[0] << " x " << size[1] << " x "
        << size[2] << ", " << withCommas(int64_t(grid.memUsage() >> 10)) << " KiB";
}

void printItem(std::ostream& out, const StackItem& item)
{
    out << item.description();
    if (item.grid) {
        printGrid(out, *item.grid);
    } else if (item.tree) {
        out << ", " << counted(item.tree->size(), "sphere") << " on "
            << counted(int64_t(item.tree->levels.size()), "level");
    } else {
        out << ", " << counted(int64_t(item.mesh->points.size()), "point") << ", "
            << counted(int64_t(item.mesh->triangles.size()), "triangle");
    }
    out << (item.written ? ", written" : "") << "\n";
}

void runPrint(const ActionCall&, Session& session)
{
    openvdb_spheretree::detail::TextStream out;
    const auto& items = session.stack.items();
    if (items.empty()) out << "the stack is empty\n";
    int age = 0, meshAge = 0;
    for (auto item = items.rbegin(); item != items.rend(); ++item) {
        const bool isMesh = bool((*item)->mesh);
        out << (isMesh ? "geo " : "vdb ") << (isMesh ? meshAge++ : age++) << ": ";
        printItem(out, **item);
        session.noteIfUnverified(**item);
    }
    session.print(out.str());
}

} // namespace

ActionSpec statsAction()
{
    ActionSpec action{"stats", "", "files",
        "print a table of a sphere-tree's levels, their exact errors, and timings"};
    action.options = {
        list("files", "",
            "in place of a table, .json files of the same, or .csv files with a line a level"),
        text("json", "", "the same as JSON to this file, or to stdout (-)"),
        text("csv", "", "the levels as a CSV to this file, or to stdout (-)"),
        flag("mass", false,
            "volume, center of mass and inertia of each level's spheres as well, of density 1; "
            "those "
            "of the object are always there"),
        vdbOption("the tree")};
    action.givesOut = true;
    action.check = checkStats;
    action.run = runStats;
    return action;
}

ActionSpec printAction()
{
    ActionSpec action = smallAction("print", "list what is on the stack, newest first");
    action.alias = "p";
    action.givesOut = true;
    action.run = runPrint;
    return action;
}

} // namespace command
