// SPDX-License-Identifier: Apache-2.0
/// @file StatsAction.cc
/// @brief -stats and -print: what is on the stack, in words and numbers.

#include "base/Terminal.h"
#include "CountErrors.h"
#include "line/Actions.h"
#include "report/StatsReport.h"
#include "ReportFiles.h"

#include <openvdb/Grid.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/mesh/TriangleMesh.h>
#include <openvdb_spheretree/voxel/BoxSides.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <iostream>
#include <string>

namespace command {

namespace {

void runStats(const ActionCall& call, Session& session)
{
    StackItem& item = session.stack.selectTree(call.text("vdb"));
    session.noteIfUnverified(item);
    countErrors(item, session);
    if (call.flag("mass")) findObject(item, session);
    const StatsMass mass = massOf(item, call.flag("mass"), session);
    if (!hasReportFiles(call)) return session.print(statsTable(*item.tree, mass, session));
    writeReportFiles(call, session, [&](std::ostream& out, const std::string& form) {
        out << (form == "csv" ? statsCsv(*item.tree, mass) : statsJson(*item.tree, mass, session));
    });
}

/// One number of cubes, else three.
std::string voxelText(const openvdb::GridBase& grid)
{
    openvdb_spheretree::detail::TextStream out;
    const openvdb::math::Transform& transform = grid.transform();
    if (openvdb_spheretree::hasCubicVoxels(transform)) {
        out << openvdb_spheretree::voxelSizeOf(transform);
        return out.str();
    }
    const openvdb::Vec3d size = grid.voxelSize();
    out << size[0] << " x " << size[1] << " x " << size[2]
        << (transform.isLinear() ? " (-resample makes cubes)" : " in the middle of a frustum");
    return out.str();
}

void printGrid(std::ostream& out, const openvdb::GridBase& grid)
{
    const auto size = openvdb_spheretree::detail::sidesOf(grid.evalActiveVoxelBoundingBox());
    out << ", " << counted(int64_t(grid.activeVoxelCount()), "active voxel") << " of "
        << voxelText(grid) << ", box " << size[0] << " x " << size[1] << " x " << size[2] << ", "
        << withCommas(int64_t(grid.memUsage() >> 10)) << " KiB";
}

/// Its sides tell in which unit it is.
void printMesh(std::ostream& out, const openvdb_spheretree::TriangleMesh& mesh)
{
    using openvdb_spheretree::detail::shortNumber;
    out << ", " << counted(int64_t(mesh.points.size()), "point") << ", "
        << counted(int64_t(mesh.triangles.size()), "triangle");
    if (mesh.points.empty()) return;
    const openvdb::Vec3d sides = boxOf(mesh).extents();
    out << ", " << shortNumber(sides[0]) << " x " << shortNumber(sides[1]) << " x "
        << shortNumber(sides[2]) << " world units";
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
        printMesh(out, *item.mesh);
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
    action.options = reportOptions(
        "in place of a table, .json files of the same, or .csv files with a line a level",
        "the same as JSON to this file, or to stdout (-)",
        "the levels as a CSV to this file, or to stdout (-)");
    action.options.push_back(flag("mass", false,
        "volume, center of mass and inertia of each level's spheres as well, of density 1; those "
        "of the object are always there"));
    action.options.push_back(vdbOption("the tree"));
    action.givesOut = true;
    action.check = checkReportFiles;
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
