// SPDX-License-Identifier: Apache-2.0
/// @file ReadAction.cc
/// @brief -read: files to the stack. The point grids of a sphere-tree become that tree again, and spheres
/// of other tools a tree of one level.

#include "base/NotNumbers.h"
#include "files/Companions.h"
#include "files/ScaleMesh.h"
#include "files/SpooledInput.h"
#include "files/VdbStream.h"
#include "line/Actions.h"
#include "line/Length.h"
#include "session/Session.h"
#include "VolumeOptions.h"

#include <openvdb_spheretree/input/Resample.h>
#include <openvdb_spheretree/input/array/ArrayFile.h>
#include <openvdb_spheretree/input/array/ArrayGrid.h>
#include <openvdb_spheretree/input/spheres/SphereFile.h>
#include <openvdb_spheretree/input/vol/VolFile.h>
#include <openvdb_spheretree/input/volume/VolumeFile.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/tree/GivenTree.h>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <set>
#include <utility>

namespace command {

using openvdb::GridBase;
using openvdb::points::PointDataGrid;

namespace {

/// The names asked for by grids=, and which of them have turned up.
class NameFilter {
public:
    explicit NameFilter(const std::vector<std::string>& names)
        : mAll(std::count(names.begin(), names.end(), "*") > 0), mNames(names)
    {}

    bool accepts(const std::string& name)
    {
        mSeen.insert(name);
        return mAll || std::count(mNames.begin(), mNames.end(), name) > 0;
    }

    /// @throw CommandError (input), listing what there is
    void requireAllFound() const
    {
        if (mAll) return;
        std::string seen;
        for (const std::string& name : mSeen) seen += (seen.empty() ? "'" : ", '") + name + "'";
        for (const std::string& name : mNames) {
            if (mSeen.count(name)) continue;
            throwInput("no grid is named '" + name + "'; there "
                + (mSeen.size() == 1 ? "is " : "are ") + (seen.empty() ? "none" : oneLine(seen)));
        }
    }

private:
    bool mAll;
    std::vector<std::string> mNames;
    std::set<std::string> mSeen;
};

StackItem treeItem(const PointDataGrid& points, const Companions& companions,
    const std::string& path, Progress& progress)
{
    StackItem item;
    const auto isUnverified = [](const PointDataGrid* grid) {
        return grid && !openvdb_spheretree::hasChecksum(*grid);
    };
    item.unverified = isUnverified(&points) || isUnverified(companions.dag.get())
        || isUnverified(companions.cuts.get());
    try {
        item.tree = std::make_shared<openvdb_spheretree::SphereTree>(openvdb_spheretree::fromPoints(
            points, companions.dag.get(), companions.cuts.get(), &progress));
    } catch (...) {
        rethrowNamed(path + ": sphere-tree '" + oneLine(points.getName(), 60) + "'", kInput);
    }
    if (item.tree->settings.isGiven()) {
        item.given = std::make_shared<openvdb_spheretree::WorldSpheres>(
            openvdb_spheretree::worldSpheres(*item.tree));
    }
    return item;
}

/// The tree of a frame that had no object.
StackItem emptyTreeItem(const GridBase::Ptr& points)
{
    StackItem item;
    item.grid = points;
    item.emptyTree = std::make_shared<openvdb_spheretree::SphereTree>();
    item.emptyTree->settings.name = points->getName();
    item.emptyTree->transform = points->transform().copy();
    return item;
}

/// @return the factor for what is read; nothing if none is asked for.
std::optional<double> scaleOf(const ActionCall& call)
{
    if (call.given("scale")) return call.real("scale");
    return call.given("units") ? metresOfUnit(call.text("units")) : std::nullopt;
}

void scaleSpheres(openvdb_spheretree::WorldSpheres& spheres, double scale)
{
    for (auto& center : spheres.center) center *= scale;
    for (double& radius : spheres.radius) radius *= scale;
}

/// Grids, volumes and meshes have one size; a tree holds radii in several ways.
void scaleItem(const StackItem& item, std::optional<double> scale)
{
    if (!scale) return;
    if (item.anyTree()) {
        throwInput("sphere-tree '" + oneLine(item.name(), 60)
            + "' is not scaled: scale= and units= are for meshes, grids and volumes; read the "
              "tree by a -read of its own without them, or build it anew of what it was made of");
    }
    if (item.mesh) scaleMesh(*item.mesh, *scale);
    if (item.grid) openvdb_spheretree::scaleGrid(*item.grid, *scale);
}

StackItem sphereItem(
    openvdb_spheretree::WorldSpheres spheres, std::optional<double> scale, Session& session)
{
    if (scale) scaleSpheres(spheres, *scale);
    if (!spheres.assumption.empty()) session.note(spheres.assumption);
    StackItem item;
    item.tree =
        std::make_shared<openvdb_spheretree::SphereTree>(openvdb_spheretree::givenTree(spheres));
    item.given = std::make_shared<openvdb_spheretree::WorldSpheres>(std::move(spheres));
    return item;
}

/// What files are read with.
struct Reading {
    Loading loading;
    std::optional<double> scale;
    NameFilter filter;
    bool pointsAreSpheres = false;
    std::optional<int> level = {}; ///< of files of spheres
    openvdb_spheretree::VolumeSettings volume = {};
};

Loading loadingOf(const ActionCall& call)
{
    const std::string delayed = call.text("delayed");
    if (delayed == "auto") return Loading::Auto;
    return delayed == "1" ? Loading::Delayed : Loading::Whole;
}

/// A grid of a file that is no sphere-tree.
void pushGrid(
    const GridBase::Ptr& grid, const std::string& path, const Reading& reading, Session& session)
{
    StackItem item;
    if (reading.pointsAreSpheres && grid->isType<PointDataGrid>()) {
        try {
            item = sphereItem(openvdb_spheretree::spheresOfPoints(*grid), reading.scale, session);
        } catch (...) {
            rethrowNamed(path, kInput);
        }
    } else {
        item.grid = grid;
        scaleItem(item, reading.scale);
    }
    session.stack.push(item);
}

void readVdbFile(const std::string& path, Reading& reading, Session& session)
{
    openvdb::GridPtrVec grids = readVdb(path, reading.loading);
    const CompanionIndex index(grids);
    std::set<GridBase::Ptr> ofTrees;
    for (const GridBase::Ptr& grid : grids) {
        if (!openvdb_spheretree::isSphereTree(*grid)) continue;
        const Companions companions = index.of(grid->getName());
        ofTrees.insert(companions.dag);
        ofTrees.insert(companions.cuts);
    }
    for (const GridBase::Ptr& grid : grids) {
        throwIfStopped();
        if (ofTrees.count(grid) || !reading.filter.accepts(grid->getName())) continue;
        if (openvdb_spheretree::isEmptyTree(*grid)) {
            const StackItem item = emptyTreeItem(grid);
            scaleItem(item, reading.scale);
            session.stack.push(item);
            continue;
        }
        if (!openvdb_spheretree::isSphereTree(*grid)) {
            pushGrid(grid, path, reading, session);
            continue;
        }
        const auto points = openvdb::gridPtrCast<PointDataGrid>(grid);
        StackItem item = treeItem(*points, index.of(grid->getName()), path, session.progress);
        scaleItem(item, reading.scale);
        session.stack.push(std::move(item));
    }
}

/// @param file  where the content of @a path is
StackItem readSpheres(
    const std::string& file, const std::string& path, const Reading& reading, Session& session)
{
    const auto spheres = openvdb_spheretree::readSphereFile(file, reading.level, path);
    try {
        return sphereItem(spheres, reading.scale, session);
    } catch (...) {
        rethrowNamed(path, kInput);
    }
}

/// @param file  where the content of @a path is
GridBase::Ptr readVolume(
    const std::string& file, const std::string& path, const Reading& reading, Session& session)
{
    if (fileKind(path) != FileKind::Vol) {
        return openvdb_spheretree::readVolumeFile(file, reading.volume, &session.progress, path);
    }
    const GridBase::Ptr grid = openvdb_spheretree::readVolFile(file, &session.progress, path);
    const auto& spacing = reading.volume.spacing;
    if (!spacing) return grid;
    try {
        grid->setTransform(openvdb_spheretree::detail::transformOf(*spacing));
    } catch (const openvdb::IoError&) {
        rethrowNamed(path, kInput);
    }
    return grid;
}

void warnOfNotNumbers(const std::string& path, const GridBase& grid, Session& session)
{
    const auto count =
        grid.getMetadata<openvdb::Int64Metadata>(openvdb_spheretree::detail::kNotNumbersMeta);
    if (count) session.warn(path + ": " + notNumbersText(count->value(), "background"));
}

void readContent(const std::string& path, Reading& reading, Session& session)
{
    const FileKind kind = fileKind(path);
    if (kind == FileKind::Vdb) return readVdbFile(path, reading, session);
    std::optional<SpooledInput> spooled;
    if (isStdin(path)) spooled.emplace(path);
    const std::string file = spooled ? spooled->path() : path;
    StackItem item;
    if (kind == FileKind::Csv || kind == FileKind::Json) {
        item = readSpheres(file, path, reading, session);
        if (reading.filter.accepts(item.tree->settings.name)) session.stack.push(item);
        return;
    }
    if (kind == FileKind::Mesh) {
        item.mesh = std::make_shared<openvdb_spheretree::TriangleMesh>(
            openvdb_spheretree::readMeshFile(file, path, &session.progress));
    } else {
        item.grid = readVolume(file, path, reading, session);
        if (!reading.filter.accepts(item.grid->getName())) return;
        warnOfNotNumbers(path, *item.grid, session);
    }
    scaleItem(item, reading.scale);
    session.stack.push(item);
}

void readFile(const std::string& path, Reading& reading, Session& session)
{
    session.stack.setFile(path);
    std::vector<InputStamp> stamps;
    if (openvdb_spheretree::isStackName(path)) {
        for (const std::string& slice : openvdb_spheretree::stackFiles(path)) {
            stamps.emplace_back(slice);
        }
    } else {
        stamps.emplace_back(path);
    }
    readContent(path, reading, session);
    for (const InputStamp& stamp : stamps) {
        stamp.requireUnchanged();
        if (reading.loading != Loading::Whole) session.inputs.push_back(stamp);
    }
}

void check(const ActionCall& call, Plan& plan)
{
    if (!call.given("files")) throwUsage("names no file");
    if (call.given("scale") && call.given("units"))
        throwUsage("scale and units exclude each other");
    for (const std::string& path : call.list("files")) plan.addInput(path);
    plan.addWorldUnit(call.given("units"));
    const auto isOf = [&](std::initializer_list<FileKind> kinds) {
        const std::vector<std::string> files = call.list("files");
        return std::any_of(files.begin(), files.end(), [&](const std::string& path) {
            return std::count(kinds.begin(), kinds.end(), fileKind(path)) > 0;
        });
    };
    if (call.given("level") && !isOf({FileKind::Csv, FileKind::Json})) {
        throwUsage("level is for spheres of a .csv or .json, and none is read; use -level");
    }
    if (call.given("spheres") && !isOf({FileKind::Vdb})) {
        throwUsage("spheres=1 is for points of a .vdb, and none is read");
    }
    checkVolumeOptions(call);
}

void run(const ActionCall& call, Session& session)
{
    const Stopwatch watch;
    Reading reading{loadingOf(call), scaleOf(call), NameFilter(call.list("grids"))};
    reading.pointsAreSpheres = call.flag("spheres");
    if (call.given("level")) reading.level = int(call.integer("level"));
    reading.volume = volumeSettings(call);
    session.stack.beginBatch("");
    for (const std::string& path : call.list("files")) readFile(path, reading, session);
    reading.filter.requireAllFound();
    session.seconds.read += watch.seconds();
    for (const auto& item : session.stack.items()) session.remark(item->description());
}

OptionSpec unitsOption()
{
    std::vector<std::string> names;
    for (const auto& unit : unitsOfLength()) names.push_back(unit.first);
    OptionSpec units = choice("units", names, "what unit files are in; everything becomes metres");
    units.fallback.clear(); // they stay as they are
    return units;
}

} // namespace

ActionSpec readAction()
{
    ActionSpec action{"read", "i", "files",
        "read grids and sphere-trees (.vdb), volumes (.vol, .longvol, .npy, .raw, .nrrd, .nii, "
        ".nii.gz), gray pictures (.png, .pgm) and stacks of them (slice_%04d.png), meshes (.obj, "
        ".ply, .stl, .off ...) and spheres of other tools (.csv, .json)"};
    action.options = {list("files", "",
                          "files to read, or stdin.vdb, .vol, .npy, .obj, .csv ...; the extension "
                          "says what they are. With %04d or #### in its name, a picture is all "
                          "slices of that name, one behind the other along z"),
        list("grids", "*", "names of the grids and sphere-trees to take"),
        text("frames", "",
            "of a sequence, whose files have #### or %04d in their names: which frames, such as "
            "1-25, "
            "1-25x2 or 1,5,9-12; by default those that are there. All that follows is done for "
            "each of "
            "them"),
        flag("spheres", false,
            "take points of a .vdb with P and pscale (or radius) as spheres, not as an object"),
        integer("level", "", 0, 1000,
            ".csv and .json whose spheres have levels: which one is taken; by default the finest"),
        choice("delayed", {"auto", "1", "0"},
            "leave the values of a .vdb in the file until they are needed, and read them node by "
            "node: grids may be larger than memory then; auto does so from 64 MiB on"),
        real("scale", "", 1e-30, 1e30,
            "make meshes, grids and volumes larger by this factor, in world space"),
        unitsOption()};
    addVolumeOptions(action);
    action.isSource = true;
    action.check = check;
    action.run = run;
    return action;
}

} // namespace command
