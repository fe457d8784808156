// SPDX-License-Identifier: Apache-2.0
#include "SphereTreePoints.h"

#include "PointLeaves.h"
#include "TreeChecksum.h"
#include "TreeMetadata.h"
#include <openvdb_spheretree/base/ParallelSort.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/tree/TreeShape.h>

#include <algorithm>
#include <string>
#include <vector>

namespace openvdb_spheretree {

namespace {

using openvdb::GridBase;
using openvdb::Vec3i;
using openvdb::points::PointDataGrid;
using openvdb::util::NullInterrupter;

// ---- Writing

/// Runs @a check; what it finds wrong is why the tree cannot be stored.
template <typename Check>
void requireStorable(const char* where, const Check& check)
{
    try {
        check();
    } catch (const openvdb::ValueError& error) {
        OPENVDB_THROW(openvdb::ValueError,
            "this sphere-tree cannot be stored: " << where << detail::messageOf(error));
    }
}

/// @throw openvdb::ValueError if fromPoints() would not take the tree back
void requireStorable(const SphereTree& tree)
{
    requireStorable("", [&] { detail::throwFirst(detail::treeDamage(tree)); });
    tree.settings.validate();
}

// ---- Which grids are ours

bool differInOneCharacter(const std::string& a, const std::string& b)
{
    if (a.size() != b.size()) return false;
    const auto [left, right] = std::mismatch(a.begin(), a.end(), b.begin());
    return left != a.end() && std::equal(left + 1, a.end(), right + 1);
}

/// @return whether a grid without the key of a format had one: it has a tree's levels, or the key is damaged.
bool hadFormat(const GridBase& grid)
{
    if (grid[detail::kLevelsKey]) return true;
    for (auto meta = grid.beginMeta(); meta != grid.endMeta(); ++meta) {
        for (const char* format :
            {detail::kFormatKey, detail::kDagFormatKey, detail::kCutsFormatKey}) {
            if (differInOneCharacter(meta->first, format)) return true;
        }
    }
    return false;
}

// ---- Reading: first everything into arrays in the order of ids, then checks in that order, so
// that the first offender named is the same every time

std::string describe(const GridBase& grid)
{
    return "point grid " + detail::inQuotes(grid.getName(), 80);
}

/// Runs @a read; whatever is wrong with the grid is reported as its damage.
template <typename Read>
auto blaming(const GridBase& grid, const char* kind, const Read& read)
{
    try {
        return read();
    } catch (const openvdb::Exception& error) {
        const std::string why =
            describe(grid) + " is a damaged " + kind + ": " + detail::messageOf(error);
        if (dynamic_cast<const openvdb::IoError*>(&error)) OPENVDB_THROW(openvdb::IoError, why);
        OPENVDB_THROW(openvdb::ValueError, why);
    }
}

/// Reads what a grid holds, of a format that this version knows.
template <typename Read>
auto readGrid(const GridBase& grid, const char* kind, const char* formatKey, const Read& read)
{
    const int format = blaming(grid, kind, [&] {
        const int value = detail::getMeta<int32_t>(grid, formatKey);
        if (value < 1) OPENVDB_THROW(openvdb::ValueError, "its format is " << value);
        return value;
    });
    if (format > kPointsFormat) {
        OPENVDB_THROW(openvdb::ValueError,
            describe(grid) << " is of format " << format << ", newer than this version reads ("
                           << kPointsFormat << "): update openvdb_spheretree");
    }
    return blaming(grid, kind, read);
}

/// @return where node id is among the points.
std::vector<std::size_t> pointOfId(const std::vector<int32_t>& ids)
{
    constexpr std::size_t kNone = ~std::size_t(0);
    std::vector<std::size_t> points(ids.size(), kNone);
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (ids[i] < 0 || std::size_t(ids[i]) >= ids.size()) {
            OPENVDB_THROW(openvdb::ValueError,
                "there is an id " << ids[i] << ", but ids must be 0 to " << ids.size() - 1);
        }
        if (points[ids[i]] != kNone) {
            OPENVDB_THROW(openvdb::ValueError, "two points have the id " << ids[i]);
        }
        points[ids[i]] = i;
    }
    return points;
}

template <typename T, typename Out>
void gather(
    const std::vector<T>& values, const std::vector<std::size_t>& order, std::vector<Out>& out)
{
    out.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) out[i] = Out(values[order[i]]);
}

/// Reads what nodes of trees and of cuts have in common. @return where node id is among the points
std::vector<std::size_t> readSpheres(const detail::PointReader& reader, int scale, Spheres& spheres)
{
    const std::vector<std::size_t> order = pointOfId(reader.attribute<int32_t>("id"));
    gather(reader.positions(scale), order, spheres.center);
    gather(reader.attribute<double>("radius"), order, spheres.radius);
    gather(reader.attribute<int64_t>("cover_sq"), order, spheres.coverRadiusSq);
    gather(reader.attribute<float>("pscale"), order, spheres.radiusWorld);
    gather(reader.attribute<int32_t>("parent"), order, spheres.parent);
    return order;
}

void checkLevels(const SphereTree& tree, const std::vector<int32_t>& levels)
{
    std::vector<int32_t> counts(tree.levels.size());
    const int lowest = tree.levels.front().level, top = tree.levels.back().level;
    for (int32_t id = 0; id < tree.size(); ++id) {
        if (levels[id] < lowest || levels[id] > top) {
            OPENVDB_THROW(openvdb::ValueError,
                "node " << id << " has the level " << levels[id] << ", but there are levels "
                        << lowest << " to " << top);
        }
        ++counts[levels[id] - lowest];
    }
    for (const SphereTreeLevel& level : tree.levels) {
        if (counts[level.level - lowest] == level.size()) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "level " << level.level << " has " << counts[level.level - lowest]
                     << " nodes, by its metadata " << level.size());
    }
    for (int32_t id = 1; id < tree.size(); ++id) {
        if (levels[id] <= levels[id - 1]) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "node " << id << " is on level " << levels[id] << ", above the level of node " << id - 1
                    << ": ids must go down from the top level");
    }
}

/// @return the names of the groups of a tree, level 0 first.
std::vector<std::string> groupNames(const SphereTree& tree)
{
    std::vector<std::string> names;
    for (const SphereTreeLevel& level : tree.levels) {
        names.push_back("level_" + std::to_string(level.level));
    }
    return names;
}

SphereTree readTree(const PointDataGrid& points, NullInterrupter* interrupter)
{
    if (hasChecksum(points)) detail::verifyDescription(points);
    SphereTree tree = detail::readTreeMetadata(points);
    const detail::PointReader reader(points, interrupter);
    const std::size_t expected = std::size_t(tree.levels.front().end);
    if (reader.size() != expected) {
        OPENVDB_THROW(openvdb::ValueError,
            "it has " << reader.size() << " points, by its metadata " << expected
                      << ": was it cut short, or are points deleted?");
    }
    detail::throwFirst(detail::unitDamage(tree.subdivision));
    const auto order = readSpheres(reader, detail::readPointScale(points), tree.spheres);
    gather(reader.attribute<Vec3i>("ijk"), order, tree.ijk);
    gather(reader.attribute<int32_t>("radius_sq"), order, tree.radiusSq);
    if (tree.nextTrack > 0) gather(reader.attribute<int32_t>("track"), order, tree.track);
    std::vector<int32_t> levelsOfPoints = reader.attribute<int32_t>("level");
    std::vector<int32_t> levels;
    gather(levelsOfPoints, order, levels);
    checkLevels(tree, levels);
    detail::throwFirst(detail::treeDamage(tree));
    if (hasChecksum(points)) {
        detail::verifyContent(points, detail::nodeChecksums(tree, interrupter));
        for (int32_t& level : levelsOfPoints) level -= tree.levels.front().level;
        reader.requireGroups(groupNames(tree), levelsOfPoints);
    }
    return tree;
}

std::vector<DagEdge> readDag(
    const PointDataGrid& grid, const SphereTree& tree, NullInterrupter* interrupter)
{
    if (hasChecksum(grid)) detail::verifyDescription(grid);
    const int32_t nodes = detail::getMeta<int32_t>(grid, "spheretree_nodes");
    const int32_t count = detail::getMeta<int32_t>(grid, "spheretree_edges");
    const detail::PointReader reader(grid, interrupter);
    if (nodes != tree.size() || reader.size() != std::size_t(count)) {
        OPENVDB_THROW(openvdb::ValueError,
            "it has " << reader.size() << " edges of " << nodes << " nodes, " << count
                      << " edges of " << tree.size() << " nodes are expected");
    }
    const std::vector<int32_t> parents = reader.attribute<int32_t>("parent");
    const std::vector<int32_t> children = reader.attribute<int32_t>("child");
    std::vector<DagEdge> edges(parents.size());
    for (std::size_t i = 0; i < edges.size(); ++i) edges[i] = {parents[i], children[i]};
    detail::parallelSort(edges.begin(), edges.end(), interrupter);
    detail::throwFirst(detail::edgeDamage(edges, tree));
    if (hasChecksum(grid)) {
        detail::verifyContent(grid, detail::edgeChecksums(edges, interrupter));
        const std::size_t astray =
            reader.firstAstray(detail::readPointScale(grid), tree.spheres.center, parents);
        if (astray < parents.size()) {
            OPENVDB_THROW(openvdb::IoError,
                "an edge from node " << parents[astray] << " is not at the centre of that node");
        }
    }
    return edges;
}

SphereCuts readCuts(const PointDataGrid& grid, const SphereTree& tree, NullInterrupter* interrupter)
{
    if (hasChecksum(grid)) detail::verifyDescription(grid);
    const int32_t nodes = detail::getMeta<int32_t>(grid, "spheretree_nodes");
    const int32_t count = detail::getMeta<int32_t>(grid, "spheretree_cuts_nodes");
    const detail::PointReader reader(grid, interrupter);
    if (nodes != tree.size() || reader.size() != std::size_t(count)) {
        OPENVDB_THROW(openvdb::ValueError,
            "it has " << reader.size() << " spheres beside a tree of " << nodes << " nodes, "
                      << count << " spheres beside " << tree.size() << " nodes are expected");
    }
    SphereCuts cuts;
    const auto order = readSpheres(reader, detail::readPointScale(grid), cuts.spheres);
    gather(reader.attribute<int32_t>("first"), order, cuts.first);
    gather(reader.attribute<int32_t>("last"), order, cuts.last);
    detail::requireCuts(cuts, tree.subdivision);
    if (hasChecksum(grid)) detail::verifyContent(grid, detail::cutsChecksums(cuts, interrupter));
    return cuts;
}

/// What becomes of an array of a tree once it has been written.
constexpr auto kKeep = [](const auto&) {};
constexpr auto kRelease = [](auto& values) { std::decay_t<decltype(values)>().swap(values); };

/// Attributes that nodes of trees and of cuts have in common.
template <typename Nodes, typename Written>
void addSpheres(detail::PointWriter& writer, Nodes& nodes, const Written& written)
{
    writer.addAttribute<float>("pscale", [&](uint32_t id) { return nodes.radiusWorld[id]; });
    written(nodes.radiusWorld);
    writer.addAttribute<int32_t>("id", [&](uint32_t id) { return id; });
    writer.addAttribute<int32_t>("parent", [&](uint32_t id) { return nodes.parent[id]; });
    written(nodes.parent);
    writer.addAttribute<double>("radius", [&](uint32_t id) { return nodes.radius[id]; });
    written(nodes.radius);
    writer.addAttribute<int64_t>("cover_sq", [&](uint32_t id) { return nodes.coverRadiusSq[id]; });
    written(nodes.coverRadiusSq);
}

/// Attribute by attribute: where @a written releases arrays, one at most is both in the tree and in
/// the grid.
template <typename Tree, typename Written>
PointDataGrid::Ptr writeTree(Tree& tree, NullInterrupter* interrupter, const Written& written)
{
    requireStorable(tree);
    const auto checksums = detail::nodeChecksums(tree, interrupter);
    detail::PointWriter writer(tree.spheres.center, interrupter);
    written(tree.spheres.center);
    addSpheres(writer, tree.spheres, written);
    const auto levelOf = [&](uint32_t id) { return tree.levelOf(int32_t(id)); };
    writer.addAttribute<int32_t>("level", levelOf);
    writer.addAttribute<int32_t>("radius_sq", [&](uint32_t id) { return tree.radiusSq[id]; });
    written(tree.radiusSq);
    if (!tree.track.empty()) {
        writer.addAttribute<int32_t>("track", [&](uint32_t id) { return tree.track[id]; });
        written(tree.track);
    }
    writer.addAttribute<Vec3i>("ijk", [&](uint32_t id) { return tree.ijk[id].asVec3i(); });
    written(tree.ijk);
    const int lowest = tree.levels.front().level;
    writer.addGroups(groupNames(tree), [&](uint32_t id) { return levelOf(id) - lowest; });

    const PointDataGrid::Ptr grid = writer.finish(*tree.transform);
    detail::writeTreeMetadata(*grid, tree, writer.scale());
    detail::writeChecksum(*grid, checksums);
    return grid;
}

} // namespace

PointDataGrid::Ptr toPoints(const SphereTree& tree, NullInterrupter* interrupter)
{
    return writeTree(tree, interrupter, kKeep);
}

PointDataGrid::Ptr releaseToPoints(SphereTree& tree, NullInterrupter* interrupter)
{
    return writeTree(tree, interrupter, kRelease);
}

PointDataGrid::Ptr dagToPoints(const SphereTree& tree, NullInterrupter* interrupter)
{
    if (tree.dag.empty()) return nullptr;
    requireStorable(tree);
    std::vector<openvdb::Vec3d> positions;
    positions.reserve(tree.dag.size());
    for (const DagEdge& edge : tree.dag) positions.push_back(tree.spheres.center[edge.parent]);
    detail::PointWriter writer(positions, interrupter);
    writer.addAttribute<int32_t>("parent", [&](uint32_t i) { return tree.dag[i].parent; });
    writer.addAttribute<int32_t>("child", [&](uint32_t i) { return tree.dag[i].child; });

    const PointDataGrid::Ptr grid = writer.finish(*tree.transform);
    grid->setName(tree.settings.name + "_dag");
    detail::setMeta<int32_t>(*grid, detail::kDagFormatKey, kPointsFormat);
    detail::setMeta<int32_t>(*grid, detail::kScaleKey, writer.scale());
    detail::setMeta<int32_t>(*grid, "spheretree_nodes", tree.size());
    detail::setMeta<int32_t>(*grid, "spheretree_edges", int32_t(tree.dag.size()));
    detail::writeChecksum(*grid, detail::edgeChecksums(tree.dag, interrupter));
    return grid;
}

PointDataGrid::Ptr cutsToPoints(const SphereTree& tree, NullInterrupter* interrupter)
{
    if (tree.cuts.empty()) return nullptr;
    requireStorable(tree);
    requireStorable("in its cuts, ", [&] { detail::requireCuts(tree.cuts, tree.subdivision); });
    detail::PointWriter writer(tree.cuts.spheres.center, interrupter);
    addSpheres(writer, tree.cuts.spheres, kKeep);
    writer.addAttribute<int32_t>("first", [&](uint32_t i) { return tree.cuts.first[i]; });
    writer.addAttribute<int32_t>("last", [&](uint32_t i) { return tree.cuts.last[i]; });

    const PointDataGrid::Ptr grid = writer.finish(*tree.transform);
    grid->setName(tree.settings.name + "_cuts");
    detail::setMeta<int32_t>(*grid, detail::kCutsFormatKey, kPointsFormat);
    detail::setMeta<int32_t>(*grid, detail::kScaleKey, writer.scale());
    detail::setMeta<int32_t>(*grid, "spheretree_nodes", tree.size());
    detail::setMeta<int32_t>(*grid, "spheretree_cuts_nodes", tree.cuts.size());
    detail::writeChecksum(*grid, detail::cutsChecksums(tree.cuts, interrupter));
    return grid;
}

bool isSphereTree(const GridBase& grid)
{
    if (!grid.isType<PointDataGrid>()) return false;
    return grid[detail::kFormatKey] || (hasChecksum(grid) && hadFormat(grid));
}

PointDataGrid::Ptr emptyTreeToPoints(const SphereTree& tree)
{
    const auto points = PointDataGrid::create();
    points->setName(tree.settings.name);
    points->setTransform(tree.transform->copy());
    points->insertMeta(detail::kEmptyKey, openvdb::BoolMetadata(true));
    return points;
}

bool isEmptyTree(const GridBase& grid)
{
    return grid.isType<PointDataGrid>() && grid[detail::kEmptyKey] && grid.empty();
}

bool isDagOf(const GridBase& grid, const std::string& treeName)
{
    return grid.isType<PointDataGrid>() && grid[detail::kDagFormatKey]
        && grid.getName() == treeName + "_dag";
}

bool isCutsOf(const GridBase& grid, const std::string& treeName)
{
    return grid.isType<PointDataGrid>() && grid[detail::kCutsFormatKey]
        && grid.getName() == treeName + "_cuts";
}

SphereTree fromPoints(const PointDataGrid& points, const PointDataGrid* dag,
    const PointDataGrid* cuts, NullInterrupter* interrupter)
{
    if (!isSphereTree(points)) {
        OPENVDB_THROW(openvdb::ValueError,
            describe(points) << " is no sphere-tree: it has no metadata '" << detail::kFormatKey
                             << "'. Point grids become one by way of a mask");
    }
    SphereTree tree = readGrid(
        points, "sphere-tree", detail::kFormatKey, [&] { return readTree(points, interrupter); });
    tree.hasDag = tree.hasDag && dag;
    tree.hasCuts = tree.hasCuts && cuts;
    if (dag) {
        tree.dag = readGrid(*dag, "Sphere-DAG", detail::kDagFormatKey,
            [&] { return readDag(*dag, tree, interrupter); });
    }
    if (cuts) {
        tree.cuts = readGrid(*cuts, "list of cuts", detail::kCutsFormatKey,
            [&] { return readCuts(*cuts, tree, interrupter); });
    }
    return tree;
}

} // namespace openvdb_spheretree
