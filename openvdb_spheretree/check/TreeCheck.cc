// SPDX-License-Identifier: Apache-2.0
/// @file TreeCheck.cc
/// @brief One function for each thing that holds for a finished tree. Nothing is taken from how
/// trees are built, the edges of the Sphere-DAG aside: all is computed anew from what is stored.
/// (checkErrors finds level 0 by the object's medial balls; checkDigitalBalls and checkCoverage
/// draw it, without them.)
///
/// 1. checkShape, checkNodes: arrays, level ranges and numbers that the rest relies on. If these
///    fail, nothing else is looked at
/// 2. checkTransform, checkObject, checkRecords, checkTopology, checkErrors: the place, and
///    recorded counts
/// 3. checkRadii, checkParents, checkChildren, checkLeavesContained: node against node;
///    checkDagEdges: stored edges against those of the object
/// 4. checkDigitalBalls, checkCoverage: spheres against the object (CoverageCheck.cc), and
///    checkChains, checkCutChains, checkInside: those of tight trees (TightCheck.cc)
///
/// A tree of a single level has no links to check; only what concerns the level is. Spheres that
/// were read (GivenTree.h) are held against the object by steps 1 and 2, and must cover it.

#include "TreeCheck.h"

#include "CheckReport.h"
#include <openvdb_spheretree/base/IntegerRoot.h>
#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/paper/IntersectionDag.h>
#include <openvdb_spheretree/tree/TreeShape.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>
#include <openvdb_spheretree/voxel/Masks.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/Grid.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace openvdb_spheretree {
namespace {

constexpr double kMuchOfVoxel = 1e-3; ///< farther away from there, an object lies elsewhere

using detail::Offenders;
using Check = detail::CheckReport;

bool hasLinks(const SphereTree& tree) { return tree.levels.size() > 1; }
bool isTight(const SphereTree& tree) { return tree.settings.type() == TreeType::Tight; }
bool isInner(const SphereTree& tree) { return tree.settings.isInner(); }
bool isFit(const SphereTree& tree) { return tree.settings.isFit(); }
bool isGiven(const SphereTree& tree) { return tree.settings.isGiven(); }

const char kInCuts[] = "in the cuts, ";

void reportAll(Check& check, const char* where, const std::vector<detail::Damage>& damage)
{
    for (const detail::Damage& rule : damage) check.fail(where, rule.all);
}

/// Arrays, levels and cuts, without which nothing else can be looked at. Cuts are there where the
/// settings say so, and each is of as many spheres as it should be.
void checkShape(Check& check)
{
    const SphereTree& tree = check.tree;
    reportAll(check, "", detail::shapeDamage(tree));
    if (tree.hasCuts && tree.cuts.empty()) check.fail("the tree lacks the cuts it was made with");
    const std::string damage = detail::cutsDamage(tree.cuts);
    if (!damage.empty()) check.fail(kInCuts, damage);
}

void checkNodes(Check& check)
{
    const SphereTree& tree = check.tree;
    const bool norm = !tree.settings.dist().isEuclidean();
    Offenders balls, roots;
    for (int32_t id = 0; id < tree.size(); ++id) {
        const bool mayBeFree = isTight(tree) || isGiven(tree);
        if (mayBeFree && tree.radiusSq[id] == -1) continue; // a sphere that is no digital ball
        if (tree.radiusSq[id] < 1) balls.add(id);
        else if (norm && detail::square(detail::floorSqrt(tree.radiusSq[id])) != tree.radiusSq[id])
            roots.add(id);
    }
    if (roots) check.fail("radius_sq is no square, as those of a norm are, for ", roots);
    reportAll(check, "", detail::sphereDamage(tree.spheres, tree.subdivision));
    if (balls) check.fail("radius_sq is less than 1 for ", balls);
    reportAll(check, kInCuts, detail::sphereDamage(tree.cuts.spheres, tree.subdivision));
}

/// The object is where the tree is. Files and programs round transforms differently: what counts is
/// that no corner of the object's box moves by a thousandth of a voxel.
void checkTransform(Check& check)
{
    check.kind = FaultKind::Place;
    const SphereTree& tree = check.tree;
    const openvdb::CoordBBox& box = check.box;
    double farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
        openvdb::Vec3d at;
        for (int a = 0; a < 3; ++a) {
            at[a] = corner >> a & 1 ? double(box.max()[a]) + 1 : double(box.min()[a]);
        }
        const openvdb::Vec3d here = check.object.transform().indexToWorld(at);
        farthest = std::max(farthest, (here - tree.transform->indexToWorld(at)).length());
    }
    const double voxel = voxelSizeOf(check.object.transform());
    if (farthest <= kMuchOfVoxel * voxel) return;
    check.fail("the object's transform is not the tree's: the corners of its box (voxels of ",
        voxel, ", first corner at ", check.object.transform().indexToWorld(box.min()),
        ") lie up to ", farthest, " world units from where the tree has them (voxels of ",
        tree.voxelSize(), ')');
}

/// What is recorded of the object is so.
void checkObject(Check& check)
{
    check.kind = FaultKind::Counts;
    const ObjectInfo& info = check.tree.object;
    const auto compare = [&](const char* what, int64_t recorded, int64_t actual) {
        if (recorded == actual) return;
        check.fail("the tree records ", recorded, ' ', what, " of the object, which has ", actual);
    };
    const openvdb::BoolTree& object = check.object.tree();
    compare("voxels", info.voxels, detail::countVoxels(check.mask));
    compare("leaves", info.leaves, int64_t(object.leafCount()));
    compare("tiles", info.tiles, int64_t(object.activeTileCount()));
    if (info.bbox != check.box) {
        check.fail("the tree records ", info.bbox, " as the object's box, which is ", check.box);
    }
}

/// What is recorded of one level is recorded of all that can have it: nothing got lost.
void checkRecords(Check& check)
{
    check.kind = FaultKind::Records;
    const SphereTree& tree = check.tree;
    const auto wasTried = [](const SphereTreeLevel& level) {
        return level.error || !level.errorUnknown.empty();
    };
    const bool anyTried = std::any_of(tree.levels.begin(), tree.levels.end(), wasTried);
    for (const SphereTreeLevel& level : tree.levels) {
        if (anyTried && !wasTried(level)) {
            check.fail("level ", level.level, " records no errors, though other levels do");
        }
        if (level.error && !level.errorUnknown.empty()) {
            check.fail("level ", level.level, " records errors, and why it has none");
        }
        if (!tree.settings.find<PyramidOptions>()) continue;
        if (level.topology.has_value() == tree.settings.topology) continue;
        check.fail("level ", level.level, " records ", level.topology ? "a" : "no",
            " topology, but the tree was made with topology=", int(tree.settings.topology));
    }
}

/// The same of errors of stored spheres, which stand beside the others. Files of version 0.1 have none.
void checkStoredRecords(Check& check)
{
    check.kind = FaultKind::Records;
    const std::vector<SphereTreeLevel>& levels = check.tree.levels;
    const auto wasTried = [](const SphereTreeLevel& level) {
        return level.stored || !level.storedUnknown.empty();
    };
    const bool anyTried = std::any_of(levels.begin(), levels.end(), wasTried);
    for (const SphereTreeLevel& level : levels) {
        const bool isTried = wasTried(level);
        if (anyTried && level.error && !isTried) {
            check.fail("level ", level.level,
                " records no errors of its stored spheres, though other levels do");
        }
        if (isTried && !level.error) {
            check.fail("level ", level.level, " records ", level.stored ? "" : "why it has no ",
                "errors of its stored spheres, but none without padding");
        }
        if (level.stored && !level.storedUnknown.empty()) {
            check.fail("level ", level.level,
                " records errors of its stored spheres, and why it has none");
        }
    }
}

/// What is recorded of level 0, whose voxels are the object's, is so.
void checkTopology(Check& check)
{
    const SphereTreeLevel& finest = check.tree.levels.front();
    if (finest.level == 0) detail::checkTopologyOf(check, finest, check.mask);
}

/// Errors that are recorded are right; levels without one are not measured.
void checkErrors(Check& check)
{
    check.kind = FaultKind::Errors;
    SphereTree copy = check.tree;
    const auto hasNone = [](const SphereTreeLevel& level) { return !level.error; };
    const auto end = std::remove_if(copy.levels.begin(), copy.levels.end(), hasNone);
    copy.levels.erase(end, copy.levels.end());
    const std::vector<SphereTreeLevel> recorded = copy.levels;
    if (recorded.empty()) return;
    computeLevelErrors(copy, check.object, check.interrupter);
    for (std::size_t i = 0; i < recorded.size(); ++i) {
        const int level = recorded[i].level;
        if (!copy.levels[i].error) {
            check.fail("level ", level, " records an error, but ", copy.levels[i].errorUnknown);
            continue;
        }
        const auto compare = [&](const char* what, auto was, auto is) {
            bool same = was == is;
            if constexpr (std::is_floating_point_v<decltype(is)>) {
                same = std::abs(was - is) <= 1e-9 * std::max(1.0, std::abs(is));
            }
            if (same) return;
            check.fail("level ", level, " records ", was, ' ', what, ", but it is ", is);
        };
        const LevelError &was = *recorded[i].error, &is = *copy.levels[i].error;
        compare("voxels covered", was.covered, is.covered);
        compare("voxels of excess", was.excess, is.excess);
        compare("voxels missing", was.missing, is.missing);
        compare("% Hamming error", was.hammingPercent, is.hammingPercent);
        compare("voxels of Hausdorff distance", was.hausdorff, is.hausdorff);
        if (!recorded[i].stored) continue; // as in files of version 0.1
        if (!copy.levels[i].stored) {
            check.fail("level ", level, " records an error of its stored spheres, but ",
                copy.levels[i].storedUnknown);
            continue;
        }
        const StoredError &wasStored = *recorded[i].stored, &isStored = *copy.levels[i].stored;
        compare(
            "% Hamming error of stored spheres", wasStored.hammingPercent, isStored.hammingPercent);
        compare("as the reach of stored spheres", wasStored.reachWorld, isStored.reachWorld);
    }
}

/// The three radii of a node agree: coverSq is the floor of the radius squared, in the tree's
/// units, or of two such terms' sum; the stored one is no less than radius and padding, or no more
/// than the radius where spheres lie inside the object, or the same with side=fit.
/// @param nodes  of a tree or of its cuts
/// @param where  what sentences about them begin with
void checkRadii(Check& check, const Spheres& nodes, const char* where)
{
    check.kind = FaultKind::Radii;
    const SphereTree& tree = check.tree;
    const double padding = tree.settings.paddingVoxels(), voxel = tree.voxelSize();
    constexpr double kRounding = 1e-12; // of doubles, many times over; floats are far coarser
    const double unit = double(tree.subdivision) * tree.settings.dist().unit();
    Offenders apart, small, large, unequal;
    for (int32_t id = 0; id < nodes.size(); ++id) {
        const double exact = std::sqrt(double(nodes.coverRadiusSq[id])) / unit;
        const double over = nodes.radius[id] - exact, rounding = kRounding * nodes.radius[id];
        if (over < -rounding || over > 0.5 + rounding) apart.add(id);
        const double padded = (nodes.radius[id] + padding) * voxel;
        const double stored = nodes.radiusWorld[id];
        if (isFit(tree)) {
            if (std::abs(stored - padded) > padded * kRounding) unequal.add(id);
        } else if (isInner(tree)) {
            if (stored > nodes.radius[id] * voxel * (1 + kRounding)) large.add(id);
        } else if (stored < padded * (1 - kRounding)) {
            small.add(id);
        }
    }
    if (apart) check.fail(where, "radius and cover_sq are not the same sphere for ", apart);
    if (small) check.fail(where, "the stored radius is less than radius and padding for ", small);
    if (unequal) check.fail(where, "the stored radius is not the radius for ", unequal);
    if (large)
        check.fail(where, "the stored radius is more than that inside the object for ", large);
}

/// Every node but the root has a parent, on the next level up.
void checkParents(Check& check)
{
    check.kind = FaultKind::Links;
    const SphereTree& tree = check.tree;
    reportAll(check, "", detail::parentDamage(tree));
    const bool endsAnywhere = isTight(tree); // at as many spheres as the settings say
    if (hasLinks(tree) && tree.root().size() != 1 && !endsAnywhere) {
        check.fail("level ", tree.root().level, ", the top one, has ", tree.root().size(),
            " nodes instead of one root");
    }
}

/// The edges are those of the object, none more and none less. What a voxel witnesses is found by
/// building the tree again; which spheres meet is seen from the stored ones. A tree whose custom
/// model is not at hand (files hold none) cannot be built again: its edges are not looked at here.
void checkDagEdges(Check& check)
{
    const SphereTree& tree = check.tree;
    const PyramidOptions& options = tree.settings.pyramid();
    const bool shared = options.edges == DagEdges::Shared;
    if (shared && isUnknown(options.customModel)) return;
    SphereTreeSettings settings = tree.settings;
    settings.topology = false;
    const std::vector<DagEdge> expected = shared
        ? buildSphereTree(check.object, settings, nullptr, check.interrupter).dag
        : intersectionDag(tree, check.interrupter);
    std::vector<DagEdge> lost, wrong;
    std::set_difference(expected.begin(), expected.end(), tree.dag.begin(), tree.dag.end(),
        std::back_inserter(lost));
    std::set_difference(tree.dag.begin(), tree.dag.end(), expected.begin(), expected.end(),
        std::back_inserter(wrong));
    for (const auto& [what, edges] :
        {std::pair("lacks ", &lost), std::pair("should lack ", &wrong)}) {
        if (edges->empty()) continue;
        check.fail("the DAG ", what, edges->size(), edges->size() == 1 ? " edge" : " edges",
            " (first: ", edges->front().parent, " to ", edges->front().child, ')');
    }
}

/// Extended and tight trees, but for side=fit: every node above level 0 has a child.
void checkChildren(Check& check)
{
    check.kind = FaultKind::Links;
    const SphereTree& tree = check.tree;
    std::vector<char> hasChild(tree.size(), 0);
    for (const int32_t parent : tree.spheres.parent) {
        if (parent >= 0) hasChild[parent] = 1;
    }
    for (std::size_t k = 1; k < tree.levels.size(); ++k) {
        Offenders childless;
        for (int32_t id = tree.levels[k].begin; id < tree.levels[k].end; ++id) {
            if (!hasChild[id]) childless.add(id);
        }
        if (childless) check.fail("level ", tree.levels[k].level, ": no child for ", childless);
    }
}

/// Where nodes contain their leaf balls: the stored spheres contain those of the leaves below them,
/// in world space. Distances are those of centers in the world, as a reader of the file has them.
/// Norms have the axes of index space, whatever way it is turned: their lengths are scaled.
void checkLeavesContained(Check& check)
{
    check.kind = FaultKind::LeafBalls;
    const SphereTree& tree = check.tree;
    const Distance& distance = tree.settings.dist();
    const bool euclidean = distance.isEuclidean();
    const double scale = euclidean ? 1 : largestStretch(*tree.transform) / distance.unit();
    const auto place = [&](int32_t id) {
        return euclidean ? tree.centerWorld(id) : tree.spheres.center[id];
    };
    std::vector<char> sticksOut(tree.size(), 0); // of the node, some leaf
    const SphereTreeLevel& finest = tree.levels.front();
    for (int32_t leaf = finest.begin; leaf < finest.end; ++leaf) {
        for (int32_t t = tree.spheres.parent[leaf]; t >= 0; t = tree.spheres.parent[t]) {
            const openvdb::Vec3d d = place(leaf) - place(t);
            const double apart = distance.length(d[0], d[1], d[2]) * scale;
            const double needed = apart + double(tree.spheres.radiusWorld[leaf]);
            if (double(tree.spheres.radiusWorld[t]) < needed) sticksOut[t] = 1;
        }
    }
    Offenders open;
    for (int32_t id = 0; id < tree.size(); ++id) {
        if (sticksOut[id]) open.add(id);
    }
    if (open) check.fail("the stored sphere does not contain every leaf ball below it for ", open);
}

bool containsLeaves(const SphereTree& tree)
{
    const SphereTreeSettings& settings = tree.settings;
    if (const auto* tight = settings.find<TightOptions>()) return tight->cover == Cover::Balls;
    const auto* pyramid = settings.find<PyramidOptions>();
    return pyramid && (settings.find<ExtendedOptions>() || pyramid->center == Center::Miniball);
}

/// The checks of links and edges. Those that follow parents need parents in order.
/// @return whether they are
bool checkLinks(Check& check)
{
    const SphereTree& tree = check.tree;
    const std::size_t before = check.faults.size();
    checkParents(check);
    const bool parentsRight = check.faults.size() == before;
    check.kind = FaultKind::Edges;
    reportAll(check, "", detail::edgeDamage(tree.dag, tree));
    if (check.faults.empty() && tree.hasDag && hasLinks(tree)) checkDagEdges(check);
    if (!parentsRight || !hasLinks(tree)) return parentsRight;
    if (tree.settings.type() != TreeType::Reversible && !isFit(tree)) checkChildren(check);
    if (containsLeaves(tree)) checkLeavesContained(check);
    return true;
}

/// Every voxel has a chain of nodes that hold it, in a tight tree; in others it has a node of every
/// level. In those that lie inside the object, nodes hold nothing else. Nearest spheres may do either.
void checkCovering(Check& check, bool parentsRight)
{
    const SphereTree& tree = check.tree;
    if (isFit(tree)) return;
    if (isInner(tree)) {
        detail::checkInside(check);
        return;
    }
    const bool chained =
        isTight(tree) && hasLinks(tree) && parentsRight && detail::checkChains(check);
    if (!chained) detail::checkCoverage(check);
    if (!tree.cuts.empty()) detail::checkCutChains(check);
}

} // namespace

std::string toString(FaultKind kind)
{
    switch (kind) {
    case FaultKind::Shape: return "shape";
    case FaultKind::Place: return "place";
    case FaultKind::Counts: return "counts";
    case FaultKind::Records: return "records";
    case FaultKind::Topology: return "topology";
    case FaultKind::Radii: return "radii";
    case FaultKind::Links: return "links";
    case FaultKind::Edges: return "edges";
    case FaultKind::LeafBalls: return "leaf balls";
    case FaultKind::DigitalBalls: return "digital balls";
    case FaultKind::Coverage: return "coverage";
    case FaultKind::Chains: return "chains";
    case FaultKind::Inside: return "inside";
    case FaultKind::Surface: return "surface";
    case FaultKind::Errors: break;
    }
    return "errors";
}

bool isObjectOf(const openvdb::BoolGrid& object, const SphereTree& tree)
{
    const auto& info = tree.object;
    if (int64_t(object.activeVoxelCount()) != info.voxels) return false;
    if (object.evalActiveVoxelBoundingBox() != info.bbox) return false;
    const double much = kMuchOfVoxel * tree.voxelSize();
    for (const openvdb::Coord& corner : {info.bbox.min(), info.bbox.max()}) {
        const auto here = object.transform().indexToWorld(corner);
        if ((here - tree.transform->indexToWorld(corner)).length() > much) return false;
    }
    return true;
}

std::vector<TreeFault> checkSphereTree(const SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter)
{
    const openvdb::MaskTree mask = detail::maskOf(object.tree());
    openvdb::CoordBBox box;
    mask.evalActiveVoxelBoundingBox(box);
    Check check{tree, object, mask, box, interrupter};
    checkShape(check);
    if (check.faults.empty()) checkNodes(check);
    if (!check.faults.empty()) return check.faults;

    checkTransform(check);
    checkObject(check);
    checkRecords(check);
    checkStoredRecords(check);
    checkTopology(check);
    checkRadii(check, tree.spheres, "");
    if (isGiven(tree)) { // which have no links, and promise nothing but what is asked of them
        detail::checkGivenCoverage(check);
        checkErrors(check);
        return check.faults;
    }
    checkRadii(check, tree.cuts.spheres, kInCuts);
    const bool parentsRight = checkLinks(check);
    detail::checkDigitalBalls(check);
    checkCovering(check, parentsRight);
    checkErrors(check);
    return check.faults;
}

} // namespace openvdb_spheretree
