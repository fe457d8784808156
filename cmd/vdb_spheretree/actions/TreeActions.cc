// SPDX-License-Identifier: Apache-2.0
/// @file TreeActions.cc
/// @brief -spheretree, -level and -check: build a tree, keep one level of it, verify it.

#include "base/Errors.h"
#include "base/Terminal.h"
#include "GivenSpheres.h"
#include "line/Actions.h"
#include "ObjectChoice.h"
#include "TreeOptions.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/build/MemoryPlan.h>
#include <openvdb_spheretree/check/MeshCheck.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/tree/SphereTracks.h>
#include <openvdb_spheretree/voxel/BoxSides.h>
#include <openvdb_spheretree/voxel/FlatAxis.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

namespace command {

namespace spheretree = openvdb_spheretree;
using openvdb::BoolGrid;
using spheretree::SphereBudget;
using spheretree::SphereTree;

namespace {

/// The object of a grid, and how long it took to find it.
BoolGrid::ConstPtr timedObjectOf(
    const StackItem& item, const spheretree::ObjectSettings& settings, Session& session)
{
    const Stopwatch watch;
    BoolGrid::ConstPtr object = objectOf(item, settings, session);
    session.seconds.mask += watch.seconds();
    return object;
}

/// What is seldom meant: a solid in too few voxels to have a shape, as of other units than one thinks;
/// and a flat one that is taken for a solid.
void warnOfSize(const BoolGrid& object, int dim, Session& session)
{
    constexpr int64_t kFewVoxels = 16;
    const openvdb::CoordBBox box = object.evalActiveVoxelBoundingBox();
    const int64_t longest = spheretree::detail::longestSideOf(box);
    const std::string name = "the object '" + oneLine(object.getName(), 60) + "' is ";
    if (longest < kFewVoxels) {
        session.warn(name + "only " + std::to_string(longest)
            + (longest == 1 ? " voxel" : " voxels")
            + " across its longest side: is its unit another (scale= or units= of -read), or the "
              "voxel too large?");
    }
    const int flat = spheretree::flatAxisOf(box);
    if (flat >= 0 && dim != 2) {
        session.warn(name + "one voxel thick along " + "xyz"[flat]
            + ": a picture or a slice wants -spheretree dim=2, and a solid a smaller voxel");
    }
}

/// A bound that any sphere around the object is within was seldom meant.
void warnOfDistance(
    const BoolGrid& object, const spheretree::SphereTreeSettings& settings, Session& session)
{
    using spheretree::detail::shortNumber;
    const auto* tight = settings.find<spheretree::TightOptions>();
    if (!tight || !tight->budget.distance) return;
    const double voxel = spheretree::voxelSizeOf(object.transform());
    const double size = voxel * spheretree::detail::diagonalOf(object.evalActiveVoxelBoundingBox());
    const double bound = tight->budget.distanceWorld(voxel);
    if (bound < size) return;
    session.warn("distance=" + shortNumber(bound)
        + " is more than the size of the object, which is " + shortNumber(size)
        + " across (world units): is its unit another, as in 5mm?");
}

/// Says so if there are fewer spheres than were asked for.
void noteIfAll(int64_t asked, int64_t all, Session& session)
{
    if (asked <= all) return;
    session.note("spheres=" + std::to_string(asked) + " is more than there are: "
        + (all == 1 ? "the only one is taken" : "all " + std::to_string(all) + " are taken"));
}

/// Levels may have fewer spheres than were asked for: all leaves that there are, or nothing better
/// was found with more. Of coarser levels a few may be missing without a note: spheres without a
/// child are dropped.
void noteOnBudget(const SphereBudget& budget, const SphereTree& tree, Session& session)
{
    if (budget.spheres.empty() || budget.hasBound()) return; // a bound may be met by fewer
    const std::vector<int64_t> counts = budget.counts(INT64_MAX);
    const auto& finest = tree.levels.front();
    const bool areLeaves = finest.pyramidVoxels > 0;
    if (areLeaves) return noteIfAll(counts.front(), finest.size(), session);
    for (std::size_t k = 0; k < std::min(counts.size(), tree.levels.size()); ++k) {
        const int64_t there = tree.levels[k].size();
        if (there >= (k == 0 ? counts[k] : counts[k] - counts[k] / 4)) continue;
        session.note(counted(there, "sphere") + (there == 1 ? " does" : " do") + " for spheres="
            + std::to_string(counts[k]) + ": with more, nothing better was found");
    }
}

/// The newest spheres that were read.
StackItem& selectGivenSpheres(Session& session)
{
    const auto& items = session.stack.items();
    const auto newest = std::find_if(
        items.rbegin(), items.rend(), [](const auto& item) { return bool(item->given); });
    if (newest == items.rend()) {
        throwInput("leaves=given takes spheres that -read found, and there are none: put -read "
                   "spheres.csv before");
    }
    return **newest;
}

SphereTree treeOf(const BoolGrid& object, const spheretree::TreeStart& start,
    const spheretree::SphereTreeSettings& settings, Session& session)
{
    if (session.verbosity >= Verbosity::Verbose) { // it costs something
        session.remark(toString(spheretree::memoryPlan(object, settings, &session.progress)));
    }
    try {
        return spheretree::buildSphereTreeFrom(
            start, object, settings, &session.seconds.build, &session.progress);
    } catch (const openvdb::IoError&) { // of its temporary file
        rethrowNamed("", kOutput);
    }
}

/// A cube of an object by other rules sticks out of the solid.
void requireWholeVoxels(const StackItem& input)
{
    const auto coverage = spheretree::coverageOf(*input.grid);
    if (!coverage || *coverage == spheretree::Coverage::Whole) return;
    throwInput("strict=1 wants voxels that lie wholly in the solid, and those of "
        + input.description() + " do not: make them with cover=whole of -mesh2ls or -mask");
}

constexpr const char* kPrevious = "previous";

/// @return the tree that like= names: null without it, and for the first frame.
std::shared_ptr<const SphereTree> lastTree(const ActionCall& call, Session& session)
{
    if (!call.given("like")) return nullptr;
    if (call.text("like") == kPrevious) return session.lastTrees[call.text("name")];
    StackItem& last = session.stack.selectTree(call.text("like"));
    const std::shared_ptr<const SphereTree> tree = last.tree;
    if (!call.flag("keep")) session.stack.drop(&last);
    return tree;
}

/// For the next frame. What -write is given may be used up by it.
void remember(const SphereTree& tree, Session& session)
{
    const auto copy = std::make_shared<SphereTree>(tree);
    copy->dag = {};
    copy->cuts = {};
    copy->hasDag = copy->hasCuts = false;
    session.lastTrees[tree.settings.name] = copy;
}

void runSpheretree(const ActionCall& call, Session& session)
{
    StackItem* const leaves =
        call.text("leaves") == "given" ? &selectGivenSpheres(session) : nullptr;
    const auto last = lastTree(call, session);
    StackItem& input = selectObjectGrid(session, call.text("vdb"));
    spheretree::ObjectSettings objectSettings;
    if (call.flag("strict")) {
        requireWholeVoxels(input);
        objectSettings.coverage = spheretree::Coverage::Whole;
    }
    const BoolGrid::ConstPtr object = timedObjectOf(input, objectSettings, session);
    const double voxel = spheretree::voxelSizeOf(object->transform());
    if (call.flag("samevoxels")) session.requireVoxelsOfSequence(voxel);
    StackItem result;
    result.ofMesh = input.ofMesh;
    if (!call.flag("keep")) session.stack.drop(&input); // its memory is wanted now
    result.object = object;
    const auto settings = settingsOf(call);
    warnOfSize(*object, settings.dim, session);
    warnOfDistance(*object, settings, session);
    result.tree = std::make_shared<SphereTree>(
        treeOf(*object, {leaves ? leaves->given.get() : nullptr, last.get()}, settings, session));
    if (call.flag("samevoxels")) session.noteVoxelsOfSequence(voxel);
    if (leaves && !call.flag("keep")) session.stack.drop(leaves);
    if (call.given("like")) {
        if (!last) spheretree::startTracks(*result.tree);
        remember(*result.tree, session);
    }
    session.remark(counted(result.tree->size(), "sphere") + " on "
        + counted(int64_t(result.tree->levels.size()), "level"));
    if (const auto* options = settings.find<spheretree::BudgetOptions>()) {
        noteOnBudget(options->budget, *result.tree, session);
    }
    if (call.flag("errors")) computeErrors(result, session);
    session.stack.beginBatch(call.label());
    session.stack.push(result);
}

/// The tree of no object is a grid of points that has none, in the place of the frame's newest grid.
void runEmptySpheretree(const ActionCall& call, Session& session)
{
    const auto& items = session.stack.items();
    const auto input = std::find_if(items.rbegin(), items.rend(),
        [&](const auto& item) { return item->grid && item->frame == session.stack.frame(); });
    auto tree = std::make_shared<SphereTree>();
    tree->settings = settingsOf(call);
    tree->transform = input == items.rend() ? openvdb::math::Transform::createLinearTransform()
                                            : (*input)->grid->transform().copy();
    StackItem result;
    result.grid = spheretree::emptyTreeToPoints(*tree);
    result.emptyTree = tree;
    if (input != items.rend() && !call.flag("keep")) session.stack.drop(input->get());
    session.stack.beginBatch(call.label());
    session.stack.push(result);
}

void checkLevel(const ActionCall& call, Plan&)
{
    const bool byLevel = call.given("level"), bySpheres = call.given("spheres");
    if (byLevel && bySpheres) throwUsage("level and spheres exclude each other");
    if (!byLevel && !bySpheres) throwUsage("names no level: level= or spheres= is missing");
}

/// The spheres that were asked for, as a tree of one level.
SphereTree levelOf(const SphereTree& tree, const ActionCall& call, Session& session)
{
    if (call.given("level")) return spheretree::keepLevel(tree, int(call.integer("level")));
    const int64_t spheres = call.integer("spheres");
    SphereTree level = spheretree::keepSpheres(tree, spheres);
    const bool finest = !tree.cuts.empty() || level.levels.front().level == 0;
    if (finest) {
        noteIfAll(spheres, level.size(), session);
    } else if (level.size() < spheres) {
        session.note("spheres=" + std::to_string(spheres) + ": the level with at most as many has "
            + std::to_string(level.size()) + "; a tree made with cuts=1 has every number");
    }
    return level;
}

void runLevel(const ActionCall& call, Session& session)
{
    StackItem& input = session.stack.selectTree(call.text("vdb"));
    StackItem result;
    result.object = input.object;
    result.given = input.given; // all of them: they have one level
    result.unverified = input.unverified;
    result.ofMesh = input.ofMesh;
    result.tree = std::make_shared<SphereTree>(levelOf(*input.tree, call, session));
    if (call.given("name")) result.tree->settings.name = call.text("name");
    if (!call.flag("keep")) session.stack.drop(&input);
    session.stack.beginBatch(call.label());
    session.stack.push(result);
}

/// The newest mesh of the stack, or null.
std::shared_ptr<const spheretree::TriangleMesh> meshOf(const Session& session)
{
    const auto& items = session.stack.items();
    const auto newest = std::find_if(
        items.rbegin(), items.rend(), [](const auto& item) { return bool(item->mesh); });
    return newest == items.rend() ? nullptr : (*newest)->mesh;
}

/// The object that a tree is checked against; null if there is but a mesh.
BoolGrid::ConstPtr objectToCheck(const StackItem& item, const ActionCall& call, Session& session)
{
    if (item.object && !call.given("vdb")) return item.object;
    const auto& items = session.stack.items();
    const bool anyObject = std::any_of(
        items.begin(), items.end(), [](const auto& other) { return isObjectGrid(*other); });
    if (!anyObject && !call.given("vdb") && session.stack.holdsMesh()) return nullptr;
    const StackItem& grid = selectObjectGrid(session, call.text("vdb"));
    const Stopwatch watch;
    if (const auto object = objectOfTree(grid, *item.tree, session)) {
        session.seconds.mask += watch.seconds();
        return object;
    }
    const auto* inner = item.tree->settings.find<spheretree::InnerOptions>();
    spheretree::ObjectSettings settings;
    if (inner && inner->strict) settings.coverage = spheretree::Coverage::Whole;
    return timedObjectOf(grid, settings, session);
}

/// @param object  that the tree was held against; null if there is but a mesh
/// @throw CommandError (check failed) that says what the first fault means, if there is one
void requireNone(
    const std::vector<spheretree::TreeFault>& faults, const StackItem& item, const BoolGrid* object)
{
    if (faults.empty()) return;
    const std::string name = item.description(), first = faults.front().sentence;
    if (item.tree->settings.isGiven()) throw CommandError(kCheckFailed, name + ": " + first);
    const auto isOfMesh = [](const spheretree::TreeFault& fault) {
        return fault.kind == spheretree::FaultKind::Surface;
    };
    const bool holdsMesh =
        !object || spheretree::coverageOf(*object) == spheretree::Coverage::Cubes;
    if (!holdsMesh && std::all_of(faults.begin(), faults.end(), isOfMesh)) {
        throw CommandError(kCheckFailed,
            name + " covers all voxels of its object, but not all of the mesh (" + first
                + "); those of -mesh2ls cover=1 hold all of it");
    }
    throw CommandError(kCheckFailed,
        name + " does not hold what it promises: " + std::to_string(faults.size())
            + " of the checks failed, the first: " + first);
}

void runCheck(const ActionCall& call, Session& session)
{
    StackItem& item = session.stack.selectTree("");
    session.noteIfUnverified(item);
    placeInObject(item, session, call.text("vdb"));
    const auto object = objectToCheck(item, call, session);
    const auto& settings = item.tree->settings;
    const bool covers =
        !settings.isInner() && !settings.isFit(); // and there is something to prove of a mesh
    const auto anyMesh = meshOf(session);
    const auto mesh = covers ? anyMesh : nullptr;
    if (mesh) {
        warnOfUnits("mesh '" + oneLine(mesh->name, 60) + "' is",
            spheretree::boxOf(*mesh).extents().length(),
            item.tree->voxelSize() * spheretree::detail::diagonalOf(item.tree->object.bbox),
            session);
    }
    const auto faults =
        spheretree::checkAgainst(*item.tree, object.get(), mesh.get(), &session.progress);
    throwIfStopped();
    for (const auto& fault : faults) session.print(oneLine(fault.sentence) + "\n");
    requireNone(faults, item, object.get());
    if (session.verbosity == Verbosity::Quiet) return;
    if (object)
        session.print(settings.isGiven() ? "the spheres cover the object\n" : "all checks hold\n");
    if (mesh) {
        session.print("every triangle of mesh '" + oneLine(mesh->name, 60)
            + "' lies in the stored spheres of every level\n");
        if (!object) {
            session.note(
                "what is inside of the mesh was not looked at: -mesh2ls cover=1 keep=1 before "
                "-check has an object for that");
        }
    } else if (anyMesh) {
        session.note("spheres of side=" + std::string(settings.isFit() ? "fit" : "inner")
            + " need not cover anything, so they are not held against mesh '"
            + oneLine(anyMesh->name, 60) + "'");
    } else if (covers && item.ofMesh) {
        session.note("held against the voxels alone, as the mesh is not there any more: keep=1 of "
                     "-mesh2ls leaves it for -check");
    }
}

} // namespace

void computeErrors(StackItem& item, Session& session)
{
    const Stopwatch watch;
    spheretree::computeLevelErrors(*item.tree, *item.object, &session.progress);
    session.seconds.error += watch.seconds();
}

ActionSpec spheretreeAction()
{
    ActionSpec action{"spheretree", "", "tree", "build the sphere-tree of a grid's object"};
    action.options = spheretreeOptions();
    action.numberOption = "spheres";
    action.isForLater = true;
    action.check = checkTreeOptions;
    action.work = longWorkOf;
    action.run = runSpheretree;
    action.runEmpty = runEmptySpheretree;
    return action;
}

ActionSpec levelAction()
{
    ActionSpec action{"level", "", "level", "keep one level of a sphere-tree"};
    action.options = {integer("level", "", 0, 1000, "the level; 0 is the finest"),
        integer("spheres", "", 1, SphereBudget::kMaxSpheres,
            "in place of a level: as many spheres, of a tree with cuts=1; of any other the finest "
            "level that has at most so many"),
        vdbOption("the tree"), keepOption(), nameOption("", "name of the result")};
    action.check = checkLevel;
    action.run = runLevel;
    return action;
}

ActionSpec checkAction()
{
    ActionSpec action{"check", "", "vdb",
        "verify everything that a sphere-tree promises against its object, and that its spheres "
        "cover the "
        "mesh on the stack, if there is one; exit code 6 if anything fails"};
    action.options = {text("vdb", "",
        "the object, by its age on the stack (0 is the newest) or its name; by default what the "
        "tree "
        "was built from, or the only grid that suits")};
    action.givesOut = true;
    action.run = runCheck;
    return action;
}

} // namespace command
