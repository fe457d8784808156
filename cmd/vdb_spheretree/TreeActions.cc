// SPDX-License-Identifier: Apache-2.0
/// @file TreeActions.cc
/// @brief -spheretree, -level and -check: build a tree, keep one level of it, verify it.

#include "Actions.h"
#include "ObjectChoice.h"

#include <openvdb_spheretree/LevelErrors.h>
#include <openvdb_spheretree/TreeCheck.h>

namespace command {

namespace spheretree = openvdb_spheretree;
using openvdb::BoolGrid;
using spheretree::SphereTree;
using spheretree::SphereTreeSettings;

namespace {

SphereTreeSettings settingsOf(const ActionCall& call)
{
    SphereTreeSettings settings;
    settings.tree = spheretree::treeTypeFromString(call.text("tree"));
    settings.factor = int(call.integer("factor"));
    settings.dim = int(call.integer("dim"));
    settings.dist = spheretree::distanceFromString(call.text("dist"));
    settings.closing = spheretree::closingFromString(call.text("model"));
    settings.parent = spheretree::parentRuleFromString(call.text("parent"));
    settings.finalFit = call.flag("final_fit");
    settings.reconstruct = spheretree::reconstructionFromString(call.text("reconstruct"));
    settings.scale = spheretree::radiusScaleFromString(call.text("scale"));
    settings.padding = spheretree::paddingFromString(call.text("padding"));
    settings.dag = call.flag("dag");
    settings.edges = spheretree::dagEdgesFromString(call.text("edges"));
    settings.topology = call.flag("topology");
    settings.name = call.text("name");
    return settings;
}

void checkSpheretree(const ActionCall& call, Plan&)
{
    if (call.text("tree") == "tight") {
        throwUsage(
            "tree=tight is not available yet in this version; there are extended and reversible");
    }
    if (call.given("edges") && !call.flag("dag")) {
        throwUsage("-spheretree edges=" + call.text("edges")
            + " says which edges of the Sphere-DAG to store, and none are: add dag=1");
    }
    settingsOf(call).validate();
}

/// The object of a grid, and how long it took to find it.
BoolGrid::ConstPtr objectOf(const openvdb::GridBase& grid, Session& session)
{
    const Stopwatch watch;
    BoolGrid::ConstPtr object = spheretree::objectMask(grid, {}, &session.progress);
    session.seconds.mask += watch.seconds();
    return object;
}

void runSpheretree(const ActionCall& call, Session& session)
{
    StackItem& input = selectObjectGrid(session, call.text("vdb"));
    const BoolGrid::ConstPtr object = objectOf(*input.grid, session);
    if (!call.flag("keep")) session.stack.drop(&input); // its memory is wanted now
    StackItem result;
    result.object = object;
    result.tree = std::make_shared<SphereTree>(spheretree::buildSphereTree(
        *object, settingsOf(call), &session.progress, &session.seconds.build));
    session.remark(std::to_string(result.tree->size()) + " spheres on "
        + std::to_string(result.tree->levels.size()) + " levels");
    if (call.flag("errors")) computeErrors(result, session);
    session.stack.beginBatch(call.label());
    session.stack.push(result);
}

void checkLevel(const ActionCall& call, Plan&)
{
    const bool byLevel = call.given("level"), bySpheres = call.given("spheres");
    if (byLevel && bySpheres) throwUsage("level and spheres exclude each other");
    if (!byLevel && !bySpheres) throwUsage("names no level: level= or spheres= is missing");
}

/// The finest level that has no more spheres than asked for.
int levelOfAtMost(const SphereTree& tree, int64_t spheres)
{
    for (const auto& level : tree.levels) {
        if (level.size() <= spheres) return level.level;
    }
    throwInput("no level has at most " + std::to_string(spheres) + " spheres: the coarsest has "
        + std::to_string(tree.root().size()));
}

void runLevel(const ActionCall& call, Session& session)
{
    StackItem& input = session.stack.selectTree(call.text("vdb"));
    const int level = call.given("level") ? int(call.integer("level"))
                                          : levelOfAtMost(*input.tree, call.integer("spheres"));
    StackItem result;
    result.object = input.object;
    result.tree = std::make_shared<SphereTree>(spheretree::keepLevel(*input.tree, level));
    if (call.given("name")) result.tree->settings.name = call.text("name");
    if (!call.flag("keep")) session.stack.drop(&input);
    session.stack.beginBatch(call.label());
    session.stack.push(result);
}

void runCheck(const ActionCall& call, Session& session)
{
    const StackItem& item = session.stack.selectTree("");
    BoolGrid::ConstPtr object = item.object;
    if (call.given("vdb") || !object) {
        object = objectOf(*selectObjectGrid(session, call.text("vdb")).grid, session);
    }
    const auto failures = spheretree::checkSphereTree(*item.tree, *object, &session.progress);
    throwIfStopped();
    for (const std::string& failure : failures) session.print(oneLine(failure) + "\n");
    if (!failures.empty()) {
        throw CommandError(kCheckFailed,
            item.description()
                + " does not hold what it promises: " + std::to_string(failures.size())
                + " of the checks failed, the first: " + failures.front());
    }
    if (session.verbosity != Verbosity::Quiet) session.print("all checks hold\n");
}

std::vector<OptionSpec> spheretreeOptions()
{
    std::vector<OptionSpec> options = {
        choice("tree", {"extended", "reversible", "tight"},
            "extended: spheres contain the leaf balls below them; reversible: every level rebuilds "
            "its own pyramid level; tight: not available yet"),
        integer("factor", "2", 2, SphereTreeSettings::kMaxFactor,
            "voxels per axis merged from level to level, 2 to 32768"),
        integer("dim", "3", 2, 3, "2 for an object one voxel thick along an axis"),
        text("dist", "l2",
            "what balls are balls of: l2 (Euclidean), l1, linf, or chamfer:a,b,c with the costs of "
            "a "
            "step across a face, an edge and a corner, such as chamfer:3,4,5"),
        text("model", "or",
            "what becomes of 2x2x2 voxels (or factor per axis): or, one voxel if any is on; or "
            "closing:R, the same after a closing by a ball of radius R, 1 to 64 voxels"),
        choice("parent", {"centre", "dag"},
            "which ball a ball hangs below: by its centre, or by its edges in the Sphere-DAG"),
        flag("final_fit", true, "store the smallest radius around the leaf balls (extended)"),
        choice("reconstruct", {"clip", "free", "none"},
            "how a level is rebuilt before it is coarsened (extended)"),
        choice("scale", {"tight", "paper"},
            "how the radii of a level's balls become those of level 0 (reversible)"),
        text("padding", "cubes",
            "added to stored radii: cubes covers whole voxels, voxels their centres; or a number "
            "of voxels"),
        flag("dag", false, "collect and store the edges of the Sphere-DAG too"),
        choice("edges", {"shared", "intersecting"},
            "with dag=1: edges between balls whose cells share a voxel, or between all spheres "
            "that meet"),
        flag("topology", true, "count components, tunnels and cavities of every level's voxels"),
        flag("errors", true, "count the exact error of every level, and store it"),
        vdbOption("the grid"), keepOption(), nameOption("spheretree", "name of the tree")};
    for (const char* name : {"cover", "center", "leaves", "quality", "spheres", "branching",
             "error", "distance", "cuts", "side", "memory"}) {
        options.push_back(later(name));
    }
    return options;
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
    action.check = checkSpheretree;
    action.run = runSpheretree;
    return action;
}

ActionSpec levelAction()
{
    ActionSpec action{"level", "", "level", "keep one level of a sphere-tree"};
    action.options = {integer("level", "", 0, 1000, "the level; 0 is the finest"),
        integer("spheres", "", 1, int64_t(1) << 31,
            "in place of a level: the finest that has at most this many spheres"),
        vdbOption("the tree"), keepOption(), nameOption("", "name of the result")};
    action.check = checkLevel;
    action.run = runLevel;
    return action;
}

ActionSpec checkAction()
{
    ActionSpec action{"check", "", "vdb",
        "verify everything that a sphere-tree promises against its object; exit code 6 if anything "
        "fails"};
    action.options = {text("vdb", "",
        "the object, by its age on the stack (0 is the newest) or its name; by default what the "
        "tree "
        "was built from, or the only grid that suits")};
    action.run = runCheck;
    return action;
}

} // namespace command
