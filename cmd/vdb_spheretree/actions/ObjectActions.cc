// SPDX-License-Identifier: Apache-2.0
/// @file ObjectActions.cc
/// @brief -mesh2ls and -mask: from geometry and grids to the object that a tree is built over.

#include "line/Actions.h"
#include "ObjectChoice.h"

#include <openvdb/points/PointDataGrid.h>
#include <openvdb_spheretree/input/mesh/MeshFile.h>

#include <algorithm>

namespace command {

namespace spheretree = openvdb_spheretree;

namespace {

constexpr double kTiny = 1e-30; // voxel sizes are positive
constexpr double kHuge = 1e30;

void checkMesh2ls(const ActionCall& call, Plan&)
{
    if (call.given("voxel") && call.given("dim")) throwUsage("voxel and dim exclude each other");
}

void runMesh2ls(const ActionCall& call, Session& session)
{
    StackItem& item = session.stack.selectMesh(call.text("geo"));
    const auto mesh = item.mesh;
    if (const int64_t open = spheretree::openEdges(*mesh)) {
        session.warn("mesh '" + mesh->name + "' is not closed: " + std::to_string(open)
            + " edges belong to an odd number of triangles; where it is open it has no inside, and "
              "the result may be a thin shell or nearly empty");
    }
    const double voxel = call.given("voxel")
        ? call.real("voxel")
        : spheretree::voxelSizeForDim(*mesh, int(call.integer("dim")));
    StackItem result;
    result.grid = spheretree::meshToLevelSet(*mesh, voxel, call.real("width"), &session.progress);
    result.grid->setName(call.given("name") ? call.text("name") : mesh->name);
    if (!call.flag("keep")) session.stack.drop(&item);
    session.stack.beginBatch(call.label());
    session.stack.push(result);
}

/// An option that says nothing about this kind of grid would be passed over in silence.
void requireRelevant(const ActionCall& call, const openvdb::GridBase& grid)
{
    const bool levelSet = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
    const bool scalar = !levelSet && !grid.isType<openvdb::BoolGrid>()
        && !grid.isType<openvdb::MaskGrid>() && !grid.isType<openvdb::points::PointDataGrid>();
    const std::string which = "'" + oneLine(grid.getName(), 60) + "' is none";
    if (call.given("iso") && !levelSet) {
        throwInput("iso is for level sets, and " + which + (scalar ? ": use threshold=" : ""));
    }
    if (call.given("threshold") && !scalar) {
        throwInput("threshold is for fog volumes and other scalar grids, and " + which
            + (levelSet ? ": use iso=" : ""));
    }
    if (call.given("values") && !grid.isType<openvdb::BoolGrid>()) {
        throwInput("values is for bool grids, and " + which);
    }
}

void runMask(const ActionCall& call, Session& session)
{
    const Stopwatch watch;
    StackItem& item = selectObjectGrid(session, call.text("vdb"));
    requireRelevant(call, *item.grid);
    spheretree::ObjectSettings settings;
    settings.iso = call.real("iso");
    settings.threshold = call.real("threshold");
    settings.values = call.flag("values");
    StackItem result;
    result.grid = objectOf(item, settings, session);
    if (call.given("name")) result.grid->setName(call.text("name"));
    if (!call.flag("keep")) session.stack.drop(&item);
    session.stack.beginBatch(call.label());
    session.stack.push(result);
    session.seconds.mask += watch.seconds();
}

bool isObjectGrid(const StackItem& item)
{
    return item.grid && spheretree::isObjectGrid(*item.grid);
}

} // namespace

StackItem& selectObjectGrid(Session& session, const std::string& ageOrName)
{
    const auto& items = session.stack.items();
    const bool anyGrid = std::any_of(
        items.begin(), items.end(), [](const auto& item) { return isObjectGrid(*item); });
    if (!anyGrid && session.stack.holdsMesh()) {
        throwInput("a mesh has no inside yet: put -mesh2ls before this action");
    }
    return session.stack.select("a grid that an object can be made of", isObjectGrid, ageOrName);
}

StackItem* onlyObjectGrid(Session& session)
{
    StackItem* found = nullptr;
    const auto& items = session.stack.items();
    for (auto item = items.rbegin(); item != items.rend(); ++item) {
        if (!isObjectGrid(**item)) continue;
        if (found && (*item)->batch != found->batch) break;
        if (found) return nullptr;
        found = item->get();
    }
    return found;
}

openvdb::BoolGrid::Ptr objectOf(
    const StackItem& item, const spheretree::ObjectSettings& settings, Session& session)
{
    try {
        return spheretree::objectOf(*item.grid, settings, &session.progress);
    } catch (const openvdb::ValueError&) { // these name the grid
        rethrowNamed("", kInput);
    } catch (const openvdb::TypeError&) {
        rethrowNamed("", kInput);
    } catch (...) {
        rethrowNamed(item.description(), kInput);
    }
}

ActionSpec mesh2lsAction()
{
    ActionSpec action{"mesh2ls", "", "", "turn a closed mesh into a level set"};
    action.options = {
        integer("dim", "256", 1, 1 << 20, "voxels along the longest side of the mesh"),
        real("voxel", "", kTiny, kHuge, "size of a voxel in world units, in place of dim"),
        real("width", "3", 1, 1000, "half the width of the narrow band, in voxels"),
        text("geo", "", "the mesh, by its age among the meshes (0 is the newest) or its name"),
        keepOption(), nameOption("", "name of the result (by default that of the mesh)")};
    action.check = checkMesh2ls;
    action.run = runMesh2ls;
    return action;
}

ActionSpec maskAction()
{
    ActionSpec action{"mask", "", "iso",
        "turn any grid into the set of its object's voxels; -spheretree does so by itself with the "
        "defaults"};
    action.options = {
        real("iso", "0", -kHuge, kHuge, "level sets: inside is where the value is below this"),
        real("threshold", "0", -kHuge, kHuge,
            "other scalar grids: inside is where the value is above this"),
        flag("values", false, "bool grids: count values that are true, not active voxels"),
        vdbOption("the grid"), keepOption(),
        nameOption("", "name of the result (by default that of the grid)")};
    action.run = runMask;
    return action;
}

} // namespace command
