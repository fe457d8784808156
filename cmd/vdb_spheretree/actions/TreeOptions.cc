// SPDX-License-Identifier: Apache-2.0
#include "TreeOptions.h"

#include <initializer_list>
#include <limits>

namespace command {

namespace spheretree = openvdb_spheretree;
using spheretree::SphereBudget;
using spheretree::SphereTreeSettings;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

SphereBudget budgetOf(const ActionCall& call)
{
    SphereBudget budget;
    if (call.given("spheres")) budget.spheres = spheretree::countsFromString(call.text("spheres"));
    if (call.given("branching")) budget.branching = int(call.integer("branching"));
    if (call.given("error")) budget.error = call.real("error");
    if (call.given("distance")) budget.distance = call.real("distance");
    return budget;
}

/// An option that would change nothing is a mistake: whoever typed it expects something of it.
void refuse(
    const ActionCall& call, std::initializer_list<const char*> options, const std::string& why)
{
    for (const char* option : options) {
        if (!call.given(option)) continue;
        throwUsage(call.label() + " " + option + "=" + call.text(option) + " " + why);
    }
}

void refuseOptionsOfOtherTrees(const ActionCall& call)
{
    const std::string tree = call.text("tree");
    if (tree != "tight") {
        refuse(call,
            {"quality", "spheres", "branching", "error", "distance", "cover", "leaves", "cuts",
                "side"},
            "is for tree=tight, not for tree=" + tree);
        return;
    }
    refuse(call,
        {"factor", "model", "center", "parent", "final_fit", "reconstruct", "scale", "dag",
            "edges"},
        "is for tree=extended and tree=reversible, not for tree=tight");
    if (call.text("side") != "inner") return;
    refuse(call, {"quality", "cover", "leaves", "error", "distance"},
        "is for spheres that cover the object, not for side=inner");
    refuse(call, {"padding"},
        "would make spheres stick out of the object, and those of side=inner lie inside: leave it "
        "out");
}

std::vector<OptionSpec> pyramidOptions()
{
    return {integer("factor", "2", 2, openvdb_spheretree::kMaxFactor,
                "voxels per axis merged from level to level, 2 to 32768 (extended, reversible)"),
        text("model", "or",
            "what becomes of 2x2x2 voxels (or factor per axis): or, one voxel if any is on; or "
            "closing:R, the same after a closing by a ball of radius R, 1 to 64 voxels (extended, "
            "reversible)"),
        choice("center", {"medial", "miniball"},
            "where spheres are centred: where the medial ball is; or where the smallest sphere "
            "around the leaf balls below is (extended, reversible)"),
        choice("parent", {"centre", "dag"},
            "which ball a ball hangs below: by its centre, or by its edges in the Sphere-DAG "
            "(extended, reversible)"),
        flag("final_fit", true, "store the smallest radius around the leaf balls (extended)"),
        choice("reconstruct", {"clip", "free", "none"},
            "how a level is rebuilt before it is coarsened (extended)"),
        choice("scale", {"tight", "paper"},
            "how the radii of a level's balls become those of level 0 (reversible)"),
        flag("dag", false,
            "collect and store the edges of the Sphere-DAG too (extended, reversible)"),
        choice("edges", {"shared", "intersecting"},
            "with dag=1: edges between balls whose cells share a voxel, or between all spheres "
            "that meet")};
}

std::vector<OptionSpec> tightOptions()
{
    return {choice("quality", {"normal", "fast", "best"},
                "how much work goes into placing and searching spheres (tight)"),
        text("spheres", "",
            "how many spheres levels have, at most, such as 512,64,8; one number with error= or "
            "distance= is the most that these may take (tight)"),
        integer("branching", "8", 2, SphereBudget::kMaxBranching,
            "in place of spheres=: levels of 1, B, B^2, ... spheres, and all leaves (tight)"),
        real("error", "", 0, kInfinity,
            "the level of fewest spheres whose Hamming error is at most this, in % (tight)"),
        real("distance", "", 0, kInfinity,
            "the level of fewest spheres that reach at most so far out of the object, in world "
            "units (tight)"),
        choice("cover", {"voxels", "balls"},
            "what spheres contain for certain: together, down the tree, every voxel; or each of "
            "them the leaf balls below it (tight)"),
        choice("leaves", {"pruned", "medial"},
            "what level 0 is made of: the medial balls that are needed, or all (tight)"),
        flag("cuts", false,
            "also store the spheres of every number of spheres, for -level spheres=N (tight)"),
        choice("side", {"outer", "inner"},
            "outer: spheres cover the object; inner: they lie inside it and cover what they can "
            "(tight)")};
}

} // namespace

std::vector<OptionSpec> spheretreeOptions()
{
    std::vector<OptionSpec> options = {
        choice("tree", {"tight", "extended", "reversible"},
            "tight: the least error for a number of spheres; the paper's two: extended: spheres "
            "contain the leaf balls below them; reversible: every level rebuilds its own pyramid "
            "level"),
        integer("dim", "3", 2, 3, "2 for an object one voxel thick along an axis"),
        text("dist", "l2",
            "what balls are balls of: l2 (Euclidean), l1, linf, or chamfer:a,b,c with the costs of "
            "a step across a face, an edge and a corner, such as chamfer:3,4,5 (tight: l2)"),
        text("padding", "cubes",
            "added to stored radii: cubes covers whole voxels, voxels their centres; or a number "
            "of voxels; nothing with side=inner")};
    for (const auto& some : {pyramidOptions(), tightOptions()}) {
        options.insert(options.end(), some.begin(), some.end());
    }
    for (const OptionSpec& option :
        {flag("topology", true, "count components, tunnels and cavities of every level's voxels"),
            flag("errors", true, "count the exact error of every level, and store it"),
            vdbOption("the grid"), keepOption(), nameOption("spheretree", "name of the tree"),
            text("memory", "75%",
                "what the labels of voxels may take while they are computed: bytes such as 4GiB or "
                "500MB, or a share of the machine's; more are compressed, and go to a temporary "
                "file in $TMPDIR where they must; the tree is the same")}) {
        options.push_back(option);
    }
    return options;
}

SphereTreeSettings settingsOf(const ActionCall& call)
{
    SphereTreeSettings settings;
    settings.tree = spheretree::treeTypeFromString(call.text("tree"));
    settings.quality = spheretree::qualityFromString(call.text("quality"));
    settings.budget = budgetOf(call);
    settings.cover = spheretree::coverFromString(call.text("cover"));
    settings.leaves = spheretree::leavesFromString(call.text("leaves"));
    settings.side = spheretree::sideFromString(call.text("side"));
    settings.cuts = call.flag("cuts");
    settings.center = spheretree::centerFromString(call.text("center"));
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
    settings.memory = spheretree::memoryFromString(call.text("memory"));
    return settings;
}

void checkTreeOptions(const ActionCall& call)
{
    refuseOptionsOfOtherTrees(call);
    if (call.given("edges") && !call.flag("dag")) {
        throwUsage("-spheretree edges=" + call.text("edges")
            + " says which edges of the Sphere-DAG to store, and none are: add dag=1");
    }
    settingsOf(call).validate();
}

} // namespace command
