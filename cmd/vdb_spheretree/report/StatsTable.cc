// SPDX-License-Identifier: Apache-2.0
#include "StatsReport.h"

#include "base/Terminal.h"

#include <openvdb_spheretree/tree/DagAdjacency.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

#include <sys/resource.h>

namespace command {

using openvdb_spheretree::SphereTree;
using openvdb_spheretree::SphereTreeLevel;

namespace {

using Row = std::vector<std::string>;

Row headerOf(const SphereTree& tree)
{
    Row row = {"level", "spheres", "voxels", "parts", "tunnels", "cavities", "radius min",
        "radius max", "covered", "excess", "missing", "hamming %", "hausdorff"};
    if (tree.settings.isInner()) row.push_back("covered %");
    return row;
}

std::string fixed(double number, int digits)
{
    char text[64];
    std::snprintf(text, sizeof(text), "%.*f", digits, number);
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
            fixed(error.hammingPercent, 2), fixed(error.hausdorff, 2)});
    if (tree.settings.isInner()) row.push_back(fixed(coveredPercent(tree, level), 2));
    return row;
}

void printRows(std::ostream& out, const std::vector<Row>& rows)
{
    std::vector<size_t> width(rows.front().size(), 0);
    for (const Row& row : rows) {
        for (size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
    }
    for (const Row& row : rows) {
        for (size_t i = 0; i < row.size(); ++i) {
            out << (i ? "  " : "") << std::string(width[i] - row[i].size(), ' ') << row[i];
        }
        out << "\n";
    }
}

/// Levels one after the other that have the same reason share a line.
void printReasons(std::ostream& out, const SphereTree& tree)
{
    std::string last;
    for (const SphereTreeLevel& level : tree.levels) {
        if (level.error) continue;
        const char* const uncounted = tree.settings.isGiven()
            ? "no object is on the stack that the spheres could be held against"
            : "errors were not counted (errors=0)";
        const std::string reason =
            level.errorUnknown.empty() ? uncounted : oneLine(level.errorUnknown);
        if (reason == last) continue;
        out << "'-' for errors from level " << level.level << " on: " << reason << "\n";
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

void printDag(std::ostream& out, const SphereTree& tree)
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
    printRows(out, rows);
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
    if (tight) text += std::string(", quality ") + toString(tight->quality);
    if (tight && tight->cover == Cover::Balls) text += ", cover balls";
    if (tight && tight->leaves == Leaves::Medial) text += ", leaves medial";
    if (pyramid && pyramid->center == Center::Miniball) text += ", center miniball";
    if (settings.dim == 2) text += ", dim 2";
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

std::vector<std::pair<const char*, double>> stageSeconds(const Session& session)
{
    const StageSeconds& s = session.seconds;
    return {{"read", s.read}, {"mask", s.mask}, {"pyramid", s.build.pyramid},
        {"distance", s.build.distance}, {"power", s.build.power}, {"medial", s.build.medial},
        {"tree", s.build.tree}, {"topology", s.build.topology}, {"error", s.error},
        {"write", s.write}};
}

std::string statsTable(const SphereTree& tree, const Session& session)
{
    std::ostringstream out;
    const auto& object = tree.object;
    const openvdb::Coord size = object.bbox.dim();
    const bool alone = tree.settings.isGiven() && object.voxels == 0;
    if (alone) out << "no object; voxels of " << tree.voxelSize() << " are of the spheres' box\n";
    else
        out << "object '" << oneLine(object.name, 60) << "': " << withCommas(object.voxels)
            << " voxels of " << tree.voxelSize() << ", " << withCommas(object.leaves) << " leaves, "
            << withCommas(object.tiles) << " tiles, box " << size[0] << " x " << size[1] << " x "
            << size[2] << "\n";
    out << (tree.settings.isGiven() ? "spheres '" : "tree '") << oneLine(tree.settings.name, 60)
        << "': " << kindOf(tree.settings) << ", " << withCommas(tree.size())
        << " spheres; radii and distances in voxels of level 0\n";
    std::vector<Row> rows = {headerOf(tree)};
    for (const SphereTreeLevel& level : tree.levels) rows.push_back(rowOf(tree, level));
    printRows(out, rows);
    printReasons(out, tree);
    printTopologyReason(out, tree);
    printDag(out, tree);
    printSeconds(out, session);
    return out.str();
}

} // namespace command
