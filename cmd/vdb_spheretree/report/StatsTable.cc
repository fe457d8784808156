// SPDX-License-Identifier: Apache-2.0
#include "StatsReport.h"

#include "base/Terminal.h"
#include "TextTable.h"

#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/tree/DagAdjacency.h>
#include <openvdb_spheretree/voxel/BoxSides.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <sys/resource.h>

namespace command {

using openvdb_spheretree::SphereTree;
using openvdb_spheretree::SphereTreeLevel;

namespace {

constexpr std::size_t kFirstOfErrors = 8; // columns before it are of spheres and topology

Row headerOf(const SphereTree& tree)
{
    Row row = {"level", "spheres", "voxels", "parts", "tunnels", "cavities", "radius min",
        "radius max", "covered", "excess", "missing", "hamming %", "hausdorff", "stored %",
        "reach"};
    if (tree.settings.isInner()) row.push_back("covered %");
    if (tree.settings.isFit()) row.push_back("dice");
    return row;
}

/// Of a length in world units, whose size nobody knows. Rounded up: it is a bound.
std::string significant(double length)
{
    if (length == 0) return "0";
    const double digit = std::pow(10.0, std::floor(std::log10(length)) - 3); // the fourth
    char text[64];
    std::snprintf(text, sizeof(text), "%.4g", std::ceil(length / digit * (1 - 1e-12)) * digit);
    return text;
}

Row rowOf(const SphereTree& tree, const SphereTreeLevel& level)
{
    const LevelRadii radii = radiiOf(tree, level);
    Row row = {
        std::to_string(level.level), withCommas(level.size()), withCommas(level.pyramidVoxels)};
    if (level.topology) {
        row.insert(row.end(),
            {withCommas(level.topology->components), withCommas(level.topology->tunnels),
                withCommas(level.topology->cavities)});
    } else {
        row.insert(row.end(), 3, "-");
    }
    row.insert(row.end(), {fixed(radii.smallest, 2), fixed(radii.largest, 2)});
    if (!level.error) {
        row.resize(headerOf(tree).size(), "-");
        return row;
    }
    const auto& error = *level.error;
    row.insert(row.end(),
        {withCommas(error.covered), withCommas(error.excess), withCommas(error.missing),
            fixed(error.hammingPercent, 2), fixed(error.hausdorff, 2),
            level.stored ? fixed(level.stored->hammingPercent, 2) : "-",
            level.stored ? significant(level.stored->reachWorld) : "-"});
    if (tree.settings.isInner()) row.push_back(fixed(coveredPercent(tree, level), 2));
    if (tree.settings.isFit()) row.push_back(fixed(diceOf(tree, level), 4));
    return row;
}

/// Most numbers are those of spheres without padding, and files have larger ones.
void printPadding(std::ostream& out, const SphereTree& tree)
{
    const double padding = tree.settings.paddingVoxels();
    if (padding == 0) return;
    char text[64];
    std::snprintf(text, sizeof(text), "%.4g", padding * tree.voxelSize());
    out << "stored radii are " << fixed(padding, 2) << " voxel (" << text
        << " world units) larger: stored % and reach (world units) are of these\n";
}

/// Levels one after the other that have the same reason share a line.
void printReasons(std::ostream& out, const SphereTree& tree)
{
    std::string last;
    for (const SphereTreeLevel& level : tree.levels) {
        if (level.error) continue;
        const char* const uncounted = tree.settings.isGiven()
            ? "no object is on the stack that the spheres could be held against"
            : "errors were not counted; -stats counts them where the object is on the stack";
        const std::string reason =
            level.errorUnknown.empty() ? uncounted : oneLine(level.errorUnknown);
        if (reason == last) continue;
        out << "'-' for errors from level " << level.level << " on: " << reason << "\n";
        last = reason;
    }
}

/// The same of the errors of stored spheres alone.
void printStoredReasons(std::ostream& out, const SphereTree& tree)
{
    std::string last;
    for (const SphereTreeLevel& level : tree.levels) {
        if (!level.error || level.stored) continue;
        const std::string reason = level.storedUnknown.empty()
            ? "its file does not have them; -stats counts them where the object is on the stack"
            : oneLine(level.storedUnknown);
        if (reason == last) continue;
        out << "'-' for stored % and reach from level " << level.level << " on: " << reason << "\n";
        last = reason;
    }
}

void printTopologyReason(std::ostream& out, const SphereTree& tree)
{
    if (tree.settings.isGiven()) return; // spheres of others never have
    const auto counted = [](const SphereTreeLevel& level) { return level.topology.has_value(); };
    if (std::all_of(tree.levels.begin(), tree.levels.end(), counted)) return;
    out << "'-' for parts, tunnels and cavities: "
        << (tree.settings.topology ? "the level has no voxels of its own"
                                   : "these were not counted (topology=0)")
        << "\n";
}

std::string range(const openvdb_spheretree::Degrees& degrees)
{
    return withCommas(degrees.min) + " / " + fixed(degrees.mean, 2) + " / "
        + withCommas(degrees.max);
}

void printDag(std::ostream& out, const SphereTree& tree, std::size_t limit)
{
    if (tree.dag.empty()) return;
    out << "Sphere-DAG: " << withCommas(int64_t(tree.dag.size())) << ' '
        << toString(tree.settings.pyramid().edges) << " edges, to each level from the one above\n";
    std::vector<Row> rows = {{"level", "edges", "children min / mean / max",
        "parents min / mean / max", "shared", "tree in dag %"}};
    for (const auto& level : dagStats(tree)) {
        rows.push_back({std::to_string(level.level), withCommas(level.edges),
            range(level.childrenPerParent), range(level.parentsPerChild),
            withCommas(level.sharedChildren), fixed(level.treeEdgesInDagPercent, 1)});
    }
    printRows(out, rows, /*second=*/4, limit);
}

void printSeconds(std::ostream& out, const Session& session)
{
    out << "seconds:";
    for (const auto& [name, seconds] : stageSeconds(session)) {
        if (seconds > 0) out << " " << name << " " << fixed(seconds, 3) << ",";
    }
    out << " total " << fixed(session.total.seconds(), 3) << "; peak memory "
        << withCommas(peakBytes() >> 20) << " MiB\n";
}

/// The kind of a tree, and all settings that are not the default and change the numbers.
std::string kindOf(const openvdb_spheretree::SphereTreeSettings& settings)
{
    using namespace openvdb_spheretree;
    const auto* tight = settings.find<TightOptions>();
    const auto* pyramid = settings.find<PyramidOptions>();
    std::string text = settings.isGiven() ? "as they were read" : toString(settings.type());
    if (pyramid) text += ", factor " + std::to_string(pyramid->factor);
    if (settings.isInner()) text += ", side inner";
    if (settings.isFit()) text += ", side fit";
    if (tight) text += std::string(", quality ") + toString(tight->quality);
    if (tight && tight->cover == Cover::Balls) text += ", cover balls";
    if (tight && tight->leaves == Leaves::Medial) text += ", leaves medial";
    if (pyramid && pyramid->center == Center::Miniball) text += ", center miniball";
    if (settings.dim == 2) text += ", dim 2";
    if (tight && tight->budget.hasBound() && tight->budget.bounds == BoundOf::Unpadded) {
        text += ", bounds unpadded";
    }
    if (!settings.dist().isEuclidean()) text += ", dist " + toString(settings.dist());
    if (!pyramid) return text;
    const std::string model = modelToString(*pyramid);
    if (model != "or") text += ", model " + model;
    if (pyramid->origin) text += ", origin " + originToString(pyramid->origin);
    if (pyramid->scale == RadiusScale::Paper) text += ", scale paper";
    return text;
}

} // namespace

LevelRadii radiiOf(const SphereTree& tree, const SphereTreeLevel& level)
{
    const auto [smallest, largest] = std::minmax_element(
        tree.spheres.radius.begin() + level.begin, tree.spheres.radius.begin() + level.end);
    return level.size() ? LevelRadii{*smallest, *largest} : LevelRadii{};
}

int64_t peakBytes()
{
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return int64_t(usage.ru_maxrss) * 1024;
}

double coveredPercent(const SphereTree& tree, const SphereTreeLevel& level)
{
    const int64_t inside = level.error->covered - level.error->excess;
    return 100.0 * double(inside) / double(tree.object.voxels);
}

double diceOf(const SphereTree& tree, const SphereTreeLevel& level)
{
    const int64_t both = level.error->covered - level.error->excess;
    return 2 * double(both) / double(tree.object.voxels + level.error->covered);
}

std::vector<std::pair<const char*, double>> stageSeconds(const Session& session)
{
    const StageSeconds& s = session.seconds;
    return {{"read", s.read}, {"mask", s.mask}, {"pyramid", s.build.pyramid},
        {"distance", s.build.distance}, {"power", s.build.power}, {"medial", s.build.medial},
        {"tree", s.build.tree}, {"topology", s.build.topology}, {"error", s.error},
        {"write", s.write}};
}

std::string statsTable(const SphereTree& tree, const StatsMass& mass, const Session& session)
{
    openvdb_spheretree::detail::TextStream out;
    const auto& object = tree.object;
    const auto size = openvdb_spheretree::detail::sidesOf(object.bbox);
    const bool alone = tree.settings.isGiven() && object.voxels == 0;
    if (alone) out << "no object; voxels of " << tree.voxelSize() << " are of the spheres' box\n";
    else
        out << "object '" << oneLine(object.name, 60) << "': " << counted(object.voxels, "voxel")
            << " of " << tree.voxelSize() << ", " << withCommas(object.leaves)
            << (object.leaves == 1 ? " leaf, " : " leaves, ") << counted(object.tiles, "tile")
            << ", box " << size[0] << " x " << size[1] << " x " << size[2] << "\n";
    out << (tree.settings.isGiven() ? "spheres '" : "tree '") << oneLine(tree.settings.name, 60)
        << "': " << kindOf(tree.settings) << ", " << counted(tree.size(), "sphere")
        << "; radii and distances in voxels of level 0\n";
    const std::size_t limit = terminalColumns(session.textOut());
    printMass(out, mass);
    std::vector<Row> rows = {headerOf(tree)};
    for (const SphereTreeLevel& level : tree.levels) rows.push_back(rowOf(tree, level));
    printRows(out, rows, kFirstOfErrors, limit);
    printPadding(out, tree);
    printReasons(out, tree);
    printStoredReasons(out, tree);
    printTopologyReason(out, tree);
    printLevelMass(out, tree, mass, limit);
    printDag(out, tree, limit);
    printSeconds(out, session);
    return brokenAt(out.str(), limit);
}

} // namespace command
