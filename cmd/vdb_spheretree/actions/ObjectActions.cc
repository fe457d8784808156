// SPDX-License-Identifier: Apache-2.0
/// @file ObjectActions.cc
/// @brief -mesh2ls and -mask: from geometry and grids to the object that a tree is built over.

#include "base/NotNumbers.h"
#include "base/Terminal.h"
#include "line/Actions.h"
#include "ObjectChoice.h"

#include <openvdb/points/PointDataGrid.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/input/mesh/MeshFile.h>
#include <openvdb_spheretree/input/mesh/MeshLevelSet.h>
#include <openvdb_spheretree/solid/MeshSolid.h>
#include <openvdb_spheretree/topology/ObjectParts.h>

#include <algorithm>

namespace command {

namespace spheretree = openvdb_spheretree;
using spheretree::detail::parseNumber;

namespace {

constexpr double kTiny = 1e-30; // voxel sizes are positive
constexpr double kHuge = 1e30;

void checkMesh2ls(const ActionCall& call, Plan&)
{
    if (call.given("voxel") && call.given("dim")) throwUsage("voxel and dim exclude each other");
    const bool outside = call.text("fill") == "outside";
    if (call.given("gap") && !outside) {
        throwUsage(
            "gap=" + call.text("gap") + " is the width of holes that fill=outside closes: add it");
    }
    if (call.given("cover") && call.text("cover") == "0" && outside) {
        throwUsage(
            "fill=outside makes an object of all voxels that the solid meets: leave cover=0 out");
    }
    if (call.given("width") && (call.text("cover") != "0" || outside)) {
        throwUsage("width is of a level set's narrow band, and cover=1 makes no level set");
    }
}

void warnIfOpen(const spheretree::TriangleMesh& mesh, Session& session)
{
    const int64_t open = spheretree::openEdges(mesh, &session.progress);
    if (open == 0) return;
    session.warn("mesh '" + mesh.name + "' is not closed: " + counted(open, "edge")
        + (open == 1 ? " belongs" : " belong")
        + " to an odd number of triangles; where it is open by more than a voxel it has no inside, "
          "and "
          "the result may be a thin shell or nearly empty: -mesh2ls fill=outside closes holes");
}

/// The object of a level set may lack what is thinner than a voxel.
void warnOfMissed(const spheretree::TriangleMesh& mesh, const openvdb::FloatGrid& levelSet,
    double voxel, Session& session)
{
    const std::string remedy = "cover=1 makes an object of every voxel that the mesh meets";
    openvdb::BoolGrid::Ptr object;
    try {
        object = spheretree::objectOf(levelSet, {}, &session.progress);
    } catch (const openvdb::ValueError&) { // it is empty
        session.warn("mesh '" + mesh.name
            + "' is so thin, or so open, that it holds no center of a voxel of "
            + spheretree::detail::shortNumber(voxel) + ": " + remedy);
        return;
    }
    const auto missed = spheretree::missedSurface(mesh, *object, &session.progress);
    if (missed.voxels == 0) return;
    session.warn("the object of mesh '" + mesh.name + "' lacks thin parts: the mesh meets "
        + counted(missed.voxels, "voxel") + " more than one voxel away from it, by up to "
        + spheretree::detail::shortNumber(missed.distance) + " (world units): " + remedy);
}

openvdb::GridBase::Ptr gridOf(
    const spheretree::TriangleMesh& mesh, double voxel, const ActionCall& call, Session& session)
{
    const bool outside = call.text("fill") == "outside";
    spheretree::MeshSolidSettings settings;
    if (call.text("cover") == "whole") settings.coverage = spheretree::Coverage::Whole;
    if (outside) settings.gap = call.given("gap") ? call.length("gap") : 2 * voxel;
    if (!outside) warnIfOpen(mesh, session);
    if (outside || call.text("cover") != "0") {
        const auto object = spheretree::meshToObject(mesh, voxel, settings, &session.progress);
        if (outside) {
            const std::string hollow =
                spheretree::hollowWarning(mesh, *object, settings.gap, &session.progress);
            if (!hollow.empty()) session.warn(hollow);
        }
        return object;
    }
    const auto levelSet =
        spheretree::meshToLevelSet(mesh, voxel, call.real("width"), &session.progress);
    warnOfMissed(mesh, *levelSet, voxel, session);
    return levelSet;
}

void runMesh2ls(const ActionCall& call, Session& session)
{
    StackItem& item = session.stack.selectMesh(call.text("geo"));
    const auto mesh = item.mesh;
    const double voxel = call.given("voxel")
        ? call.length("voxel")
        : spheretree::voxelSizeForDim(*mesh, int(call.integer("dim")));
    StackItem result;
    result.grid = gridOf(*mesh, voxel, call, session);
    result.ofMesh = true;
    result.grid->setName(call.given("name") ? call.text("name") : mesh->name);
    if (!call.flag("keep")) session.stack.drop(&item);
    session.stack.beginBatch(call.label());
    session.stack.push(result);
}

/// The number as it was typed: 64-bit integers keep all of their digits.
spheretree::ValueBound boundOf(const ActionCall& call, const std::string& option)
{
    const auto integer = parseNumber<int64_t>(call.text(option));
    return integer ? spheretree::ValueBound::of(*integer) : call.real(option);
}

const char* const kRangeOptions[] = {"above", "below", "label"};

/// Ranges and labels are in place of a threshold, and values between labels are none.
void checkMask(const ActionCall& call, Plan&)
{
    for (const char* option : kRangeOptions) {
        const std::string name = option;
        if (!call.given(name)) continue;
        if (call.given("threshold")) throwUsage(name + " and threshold exclude each other");
        if (call.given("iso")) throwUsage(name + " and iso exclude each other");
    }
    const bool isCovered = call.text("cover") != "0";
    if (call.given("label")) {
        if (call.given("above") || call.given("below")) {
            throwUsage("label excludes above and below");
        }
        if (isCovered) throwUsage("label excludes cover: nothing lies between labels");
        for (const std::string& label : call.list("label")) {
            if (parseNumber<int64_t>(label)) continue;
            throwUsage("label=" + label + " is not understood: it takes whole numbers");
        }
    }
    if (!call.given("above") || !call.given("below")) return;
    if (!(boundOf(call, "above") < boundOf(call, "below"))) {
        throwUsage("no value is above " + call.text("above") + " and below " + call.text("below"));
    }
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
    for (const char* option : kRangeOptions) {
        if (!call.given(option) || scalar) continue;
        throwInput(std::string(option) + " is for fog volumes and other scalar grids, and " + which
            + (levelSet ? ": use iso=" : ""));
    }
    if (call.text("cover") != "0" && !levelSet && !scalar) {
        throwInput("cover is for level sets and other scalar grids, and " + which);
    }
    if (call.given("values") && !grid.isType<openvdb::BoolGrid>()) {
        throwInput("values is for bool grids, and " + which);
    }
}

spheretree::ObjectSettings objectSettingsOf(const ActionCall& call)
{
    spheretree::ObjectSettings settings;
    settings.iso = call.real("iso");
    settings.threshold = call.real("threshold");
    settings.values = call.flag("values");
    const std::string cover = call.text("cover");
    if (cover == "1") settings.coverage = spheretree::Coverage::Cubes;
    if (cover == "whole") settings.coverage = spheretree::Coverage::Whole;
    if (call.given("above")) settings.above = boundOf(call, "above");
    if (call.given("below")) settings.below = boundOf(call, "below");
    for (const std::string& label : call.list("label")) {
        settings.labels.push_back(*parseNumber<int64_t>(label));
    }
    return settings;
}

void runMask(const ActionCall& call, Session& session)
{
    const Stopwatch watch;
    StackItem& item = selectObjectGrid(session, call.text("vdb"));
    requireRelevant(call, *item.grid);
    if (call.given("label") && item.interpolated) {
        throwInput("label: " + item.description()
            + " is interpolated, and a mean of labels 1 and 3 is 2: add nearest=1 to -resample");
    }
    const spheretree::ObjectSettings settings = objectSettingsOf(call);
    StackItem result;
    auto object = objectOf(item, settings, session);
    if (call.flag("largest")) object = spheretree::largestPart(*object, &session.progress);
    if (call.flag("fill")) object = spheretree::filledCavities(*object, &session.progress);
    result.grid = object;
    result.ofMesh = item.ofMesh;
    if (call.given("name")) result.grid->setName(call.text("name"));
    if (!call.flag("keep")) session.stack.drop(&item);
    session.stack.beginBatch(call.label());
    session.stack.push(result);
    session.seconds.mask += watch.seconds();
}

} // namespace

bool isObjectGrid(const StackItem& item)
{
    return item.grid && !item.emptyTree && spheretree::isObjectGrid(*item.grid);
}

StackItem& selectObjectGrid(Session& session, const std::string& ageOrName)
{
    const auto& items = session.stack.items();
    const bool anyGrid = std::any_of(
        items.begin(), items.end(), [](const auto& item) { return isObjectGrid(*item); });
    if (!anyGrid && session.stack.holdsMesh()) {
        throwInput("a mesh has no inside yet: put -mesh2ls before this action");
    }
    return session.stack.select("a grid that bounds an object (a level set or any other grid of "
                                "single numbers, a bool or mask grid, or points)",
        isObjectGrid, ageOrName);
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

namespace {

/// @param notNumbers  receives how many values are NaN
openvdb::BoolGrid::Ptr objectCounting(int64_t& notNumbers, const StackItem& item,
    const spheretree::ObjectSettings& settings, Session& session)
{
    try {
        return spheretree::objectOf(*item.grid, settings, &session.progress, &notNumbers);
    } catch (const openvdb::ValueError&) { // these name the grid
        rethrowNamed("", kInput);
    } catch (const openvdb::TypeError&) {
        rethrowNamed("", kInput);
    } catch (...) {
        rethrowNamed(item.description(), kInput);
    }
}

void warnOfNotNumbers(int64_t notNumbers, const StackItem& item, Session& session)
{
    if (notNumbers) session.warn(item.description() + ": " + notNumbersText(notNumbers));
}

} // namespace

openvdb::BoolGrid::Ptr objectOf(
    const StackItem& item, const spheretree::ObjectSettings& settings, Session& session)
{
    int64_t notNumbers = 0;
    auto object = objectCounting(notNumbers, item, settings, session);
    warnOfNotNumbers(notNumbers, item, session);
    return object;
}

openvdb::BoolGrid::ConstPtr knownObject(const StackItem& item, Session& session)
{
    if (item.object) return item.object;
    const StackItem* const grid = onlyObjectGrid(session);
    return grid ? objectOfTree(*grid, *item.tree, session) : nullptr;
}

openvdb::BoolGrid::Ptr objectOfTree(
    const StackItem& item, const spheretree::SphereTree& tree, Session& session)
{
    using spheretree::Coverage;
    for (const Coverage coverage : {Coverage::Centers, Coverage::Cubes, Coverage::Whole}) {
        spheretree::ObjectSettings settings;
        settings.coverage = coverage;
        try {
            int64_t notNumbers = 0;
            const auto object = objectCounting(notNumbers, item, settings, session);
            if (spheretree::isObjectOf(*object, tree)) {
                warnOfNotNumbers(notNumbers, item, session);
                return object;
            }
            if (spheretree::coverageOf(*object) != coverage) return nullptr; // the same for each
        } catch (const CommandError&) { // no voxel is of that kind
        }
    }
    return nullptr;
}

ActionSpec mesh2lsAction()
{
    ActionSpec action{"mesh2ls", "", "",
        "turn a closed mesh into a level set, or into the voxels that its solid meets"};
    action.options = {
        integer("dim", "256", 1, 1 << 20, "voxels along the longest side of the mesh"),
        length("voxel", "", kTiny, kHuge, "size of a voxel in world units, in place of dim"),
        real("width", "3", 1, 1000, "half the width of the narrow band, in voxels"),
        choice("cover", {"0", "1", "whole"},
            "0: a level set, of which voxels with their center inside count; 1: the object of "
            "every voxel whose "
            "cube meets the solid: thin parts stay, and spheres cover the solid itself; whole: of "
            "those that are "
            "all inside. A hollow within the mesh is filled by 0 and 1, and left out by whole"),
        choice("fill", {"closed", "outside"},
            "what is inside: what a closed mesh bounds, or all that cannot be reached from outside "
            "through "
            "holes narrower than gap (with cover=1)"),
        length("gap", "", 0, kHuge,
            "with fill=outside: the width of holes to close, in world units; by default 2 voxels"),
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
        real("above", "", -kHuge, kHuge,
            "other scalar grids, in place of threshold: inside is where the value is above this"),
        real("below", "", -kHuge, kHuge,
            "and below this; both, or one of them (then what lies around must not be inside)"),
        list("label", "",
            "other scalar grids: inside is where the value is this whole number, or one of several "
            "(3,5)"),
        choice("cover", {"0", "1", "whole"},
            "which voxels of a level set or other scalar grid: 0: those whose centre is inside; 1: "
            "all whose cube the inside meets, so that thin parts stay; whole: those whose cube is "
            "all inside. Between centres values are interpolated"),
        flag("values", false, "bool grids: count values that are true, not active voxels"),
        flag("largest", false,
            "keep the largest part alone (voxels that share a corner belong together)"),
        flag("fill", false, "fill cavities: background that is closed in on all sides"),
        vdbOption("the grid"), keepOption(),
        nameOption("", "name of the result (by default that of the grid)")};
    action.check = checkMask;
    action.run = runMask;
    return action;
}

} // namespace command
