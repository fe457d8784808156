// SPDX-License-Identifier: Apache-2.0
/// @file StatsAction.cc
/// @brief -stats and -print: what is on the stack, in words and numbers.

#include "base/LastWords.h"
#include "base/Terminal.h"
#include "files/AtomicFile.h"
#include "GivenSpheres.h"
#include "line/Actions.h"
#include "ObjectChoice.h"
#include "report/StatsReport.h"

#include <algorithm>
#include <iostream>
#include <sstream>

namespace command {

namespace {

void runStats(const ActionCall& call, Session& session)
{
    StackItem& item = session.stack.selectTree(call.text("vdb"));
    session.noteIfUnverified(item);
    placeInObject(item, session);
    const auto& levels = item.tree->levels;
    const bool lacksErrors = std::any_of(levels.begin(), levels.end(),
        [](const auto& level) { return !level.error && level.errorUnknown.empty(); });
    if (item.object && lacksErrors) computeErrors(item, session);
    if (!call.given("json")) return session.print(statsTable(*item.tree, session));
    const std::string json = statsJson(*item.tree, session), path = call.text("json");
    if (path == "-") return session.print(json, standardOutput());
    AtomicFile file(path);
    file.write([&](std::ostream& out) { out << json; });
    const Uninterrupted untilItIsThere;
    throwIfStopped();
    file.commit();
}

void printGrid(std::ostream& out, const openvdb::GridBase& grid)
{
    const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
    const openvdb::Coord size = grid.empty() ? openvdb::Coord(0) : box.dim();
    out << ", " << withCommas(int64_t(grid.activeVoxelCount())) << " active voxels of "
        << grid.voxelSize()[0] << ", box " << size[0] << " x " << size[1] << " x " << size[2]
        << ", " << withCommas(int64_t(grid.memUsage() >> 10)) << " KiB";
}

void printItem(std::ostream& out, const StackItem& item)
{
    out << item.description();
    if (item.grid) {
        printGrid(out, *item.grid);
    } else if (item.tree) {
        out << ", " << withCommas(item.tree->size()) << " spheres on " << item.tree->levels.size()
            << " levels";
    } else {
        out << ", " << withCommas(int64_t(item.mesh->points.size())) << " points, "
            << withCommas(int64_t(item.mesh->triangles.size())) << " triangles";
    }
    out << (item.written ? ", written" : "") << "\n";
}

void runPrint(const ActionCall&, Session& session)
{
    std::ostringstream out;
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
    ActionSpec action{"stats", "", "json",
        "print a table of a sphere-tree's levels, their exact errors, and timings"};
    action.options = {
        text("json", "", "write the same as JSON to this file, or to stdout (-), and no table"),
        vdbOption("the tree")};
    action.check = [](const ActionCall& call, Plan& plan) {
        if (!call.given("json")) return;
        const std::string path = call.text("json");
        const FileKind kind = fileKind(path);
        if (kind != FileKind::Json && kind != FileKind::Unknown) {
            throwUsage(path
                + ": -stats writes JSON, and files of this name are something else; "
                  "name a .json file, or - for stdout");
        }
        plan.addOutput(path);
    };
    action.run = runStats;
    return action;
}

ActionSpec printAction()
{
    ActionSpec action = smallAction("print", "list what is on the stack, newest first");
    action.alias = "p";
    action.run = runPrint;
    return action;
}

} // namespace command
