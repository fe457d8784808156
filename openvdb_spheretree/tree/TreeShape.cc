// SPDX-License-Identifier: Apache-2.0
#include "TreeShape.h"

#include "GivenTree.h"
#include <openvdb_spheretree/pyramid/OrPyramid.h>
#include <openvdb_spheretree/voxel/BoxSides.h>

#include <openvdb/math/Transform.h>
#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace openvdb_spheretree {
namespace detail {

namespace {

/// Coordinates of voxels are of 32 bits.
constexpr double kMaxCoordinate = 2147483648.0;
/// A sum of two such squares, as distances have them, is of 63 bits.
constexpr int64_t kMaxRadiusSq = int64_t(1) << 62;

/// A rule that one thing breaks.
template <typename... Parts>
Damage single(const Parts&... parts)
{
    const std::string text = sentence(parts...);
    return {text, text};
}

/// What breaks one rule about nodes: the count of them, and a sentence about the first.
class Breach {
public:
    template <typename... Parts>
    void add(int32_t id, const Parts&... parts)
    {
        if (!mNodes) mFirst = sentence("node ", id, parts...);
        mNodes.add(id);
    }

    template <typename... Parts>
    void report(std::vector<Damage>& damage, const Parts&... rule) const
    {
        if (mNodes) damage.push_back({sentence(rule..., " for ", mNodes), mFirst});
    }

private:
    Offenders mNodes;
    std::string mFirst;
};

/// @param isWrong  of an edge's place
/// @param all      what the edges do that break the rule; @a first: what the first of them does
template <typename IsWrong>
std::vector<Damage> damageOf(
    const std::vector<DagEdge>& edges, const IsWrong& isWrong, const char* all, const char* first)
{
    int64_t count = 0;
    DagEdge edge; // the first
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (isWrong(i) && count++ == 0) edge = edges[i];
    }
    if (count == 0) return {};
    return {{sentence(count, " edges of the DAG ", all, " (first: ", edge.parent, " to ",
                 edge.child, ')'),
        sentence(
            "the edge of the DAG from node ", edge.parent, " to node ", edge.child, ' ', first)}};
}

template <typename Is>
bool allAre(const openvdb::Vec3d& center, const Is& is)
{
    return is(center[0]) && is(center[1]) && is(center[2]);
}

} // namespace

std::vector<Damage> unitDamage(int subdivision)
{
    if (subdivision == 2 || subdivision == 16 || subdivision == kGivenSubdivision) return {};
    return {
        single("centres are in units of 1/", subdivision, " of a voxel, not 1/2, 1/16 or 1/1024")};
}

std::vector<Damage> shapeDamage(const SphereTree& tree)
{
    std::vector<Damage> damage;
    const auto add = [&](const auto&... parts) { damage.push_back(single(parts...)); };
    const std::size_t count = tree.spheres.center.size();
    if (count == 0) add("the tree has no nodes");
    const std::pair<const char*, std::size_t> arrays[] = {{"radius", tree.spheres.radius.size()},
        {"coverRadiusSq", tree.spheres.coverRadiusSq.size()},
        {"radiusWorld", tree.spheres.radiusWorld.size()}, {"parent", tree.spheres.parent.size()},
        {"ijk", tree.ijk.size()}, {"radiusSq", tree.radiusSq.size()}};
    if (!tree.track.empty() && tree.track.size() != count) {
        add("the tree has ", count, " centres, but ", tree.track.size(), " entries in track");
    }
    for (const auto& [name, size] : arrays) {
        if (size != count)
            add("the tree has ", count, " centres, but ", size, " entries in ", name);
    }
    for (const Damage& unit : unitDamage(tree.subdivision)) damage.push_back(unit);
    if (!tree.transform) add("the tree has no transform");
    else if (!tree.transform->isLinear()) add("the tree's transform is not linear");

    if (tree.levels.empty()) add("the tree has no levels");
    int32_t next = 0;
    for (std::size_t k = tree.levels.size(); k-- > 0;) {
        const SphereTreeLevel& level = tree.levels[k];
        if (level.level < 0 || (tree.levels.size() > 1 && level.level != int(k))) {
            add("level ", level.level, " stands where level ", k, " belongs");
        }
        if (level.begin != next || level.end <= level.begin || level.end > tree.size()) {
            add("level ", level.level, " is nodes ", level.begin, " to ", level.end,
                " (exclusive), where nodes from ", next, " on are expected");
        }
        next = level.end;
    }
    if (next != tree.size()) {
        add("the levels have ", next, " nodes, but the tree has ", tree.size());
    }
    return damage;
}

std::vector<Damage> sphereDamage(const Spheres& spheres, int subdivision)
{
    const auto inRange = [](double x) { return std::abs(x) <= kMaxCoordinate; }; // false of a NaN
    const auto isOfUnits = [&](double x) { return subdivision * x == std::floor(subdivision * x); };
    Breach centers, radii, stored;
    for (int32_t id = 0; id < spheres.size(); ++id) {
        const openvdb::Vec3d& center = spheres.center[id];
        const double radius = spheres.radius[id], world = spheres.radiusWorld[id];
        const int64_t radiusSq = spheres.coverRadiusSq[id];
        if (!allAre(center, inRange)) {
            centers.add(id, " has the position ", center, ", which no sphere has");
        } else if (!allAre(center, isOfUnits)) {
            centers.add(id, " has the position ", center, ", which is no multiple of 1/",
                subdivision, " voxel");
        }
        if (!(radius >= 0 && radius <= kMaxCoordinate)) {
            radii.add(id, " has the radius ", radius, ", which no sphere has");
        } else if (radiusSq < 0 || radiusSq > kMaxRadiusSq) {
            radii.add(id, " has the cover_sq ", radiusSq, ", which no sphere has");
        }
        if (!(std::isfinite(world) && world >= 0)) {
            stored.add(id, " has the pscale ", world, ", which no sphere has");
        }
    }
    std::vector<Damage> damage;
    centers.report(
        damage, "the centre is not a multiple of 1/", subdivision, " of a voxel in range");
    radii.report(damage, "the radius is negative or not a number");
    stored.report(damage, "the stored radius is negative or not a number");
    return damage;
}

std::vector<Damage> parentDamage(const SphereTree& tree)
{
    std::vector<Damage> damage;
    for (std::size_t k = tree.levels.size(); k-- > 0;) {
        const SphereTreeLevel& level = tree.levels[k];
        const bool top = k + 1 == tree.levels.size();
        Breach wrong;
        for (int32_t id = level.begin; id < level.end; ++id) {
            const int32_t parent = tree.spheres.parent[id];
            if (top ? parent == -1
                    : parent >= tree.levels[k + 1].begin && parent < tree.levels[k + 1].end) {
                continue;
            }
            const std::string node =
                sentence(" on level ", level.level, " has the parent ", parent);
            if (top) {
                wrong.add(id, node, ", but the top level has no parents (-1)");
            } else if (parent < 0 || parent >= tree.size()) {
                wrong.add(id, node, ", but its parent must be a node of the next level up");
            } else {
                wrong.add(id, node, " on level ", tree.levelOf(parent),
                    ", but a parent must be on the next level up");
            }
        }
        wrong.report(damage, "level ", level.level, ": ",
            top ? "the parent is not -1, though this is the top level,"
                : "the parent is not on the next level up");
    }
    return damage;
}

std::vector<Damage> edgeOrderDamage(const std::vector<DagEdge>& edges)
{
    return damageOf(
        edges, [&](std::size_t i) { return i > 0 && !(edges[i - 1] < edges[i]); },
        "are out of order or repeated", "is out of order or there twice");
}

std::vector<Damage> edgeDamage(const std::vector<DagEdge>& edges, const SphereTree& tree)
{
    if (edges.empty()) return {};
    std::vector<int32_t> places(std::size_t(tree.size())); // of nodes' levels among the levels
    for (std::size_t k = 0; k < tree.levels.size(); ++k) {
        const SphereTreeLevel& level = tree.levels[k];
        std::fill(places.begin() + level.begin, places.begin() + level.end, int32_t(k));
    }
    const auto exists = [&](int32_t id) { return id >= 0 && id < tree.size(); };
    const auto isWrong = [&](std::size_t i) {
        const int32_t parent = edges[i].parent, child = edges[i].child;
        return !exists(parent) || !exists(child) || places[parent] != places[child] + 1;
    };
    std::vector<Damage> damage = damageOf(edges, isWrong, "do not lead to the next level down",
        "does not lead to a node of the next level down");
    for (const Damage& order : edgeOrderDamage(edges)) damage.push_back(order);
    return damage;
}

std::vector<Damage> trackDamage(const SphereTree& tree)
{
    std::vector<int32_t> tracks = tree.track;
    std::sort(tracks.begin(), tracks.end());
    const auto twice = std::adjacent_find(tracks.begin(), tracks.end());
    std::vector<Damage> damage;
    if (twice != tracks.end()) damage.push_back(single("two nodes have the track ", *twice));
    if (!tracks.empty() && (tracks.front() < 0 || tracks.back() >= tree.nextTrack)) {
        damage.push_back(single("there are tracks from ", tracks.front(), " to ", tracks.back(),
            ", and all should be from 0 to ", int64_t(tree.nextTrack) - 1));
    }
    return damage;
}

std::vector<Damage> boxDamage(const SphereTree& tree)
{
    const ObjectInfo& object = tree.object;
    const openvdb::CoordBBox& box = object.bbox;
    if (object.voxels == 0 && box == openvdb::CoordBBox()) return {};
    if (box.empty()) {
        return {single("the object's box goes from ", box.min(), " to ", box.max(),
            ": it ends before it begins")};
    }
    const int64_t longest = longestSideOf(box);
    if (longest > kMaxExtent && !tree.settings.isGiven()) {
        return {
            single("the object's box goes from ", box.min(), " to ", box.max(), ", over ", longest,
                " voxels along an axis, and trees are built of 2^", kMaxExtentBits, " at most")};
    }
    const auto side = sidesOf(box);
    // As quotients: the box may have 2^96 voxels.
    const auto divideUp = [](int64_t a, int64_t b) { return a / b + (a % b > 0); };
    if (divideUp(divideUp(object.voxels, side[0]), side[1]) > side[2]) {
        return {single("the object's box is of ", side[0], " x ", side[1], " x ", side[2],
            " voxels, too small for the ", object.voxels, " of the object")};
    }
    return {};
}

std::vector<Damage> figureDamage(const SphereTree& tree)
{
    std::vector<Damage> damage;
    const auto count = [&](int64_t value, const auto&... of) {
        constexpr int64_t kMost = int64_t(1) << 62; // a sum of two fits
        if (value >= 0 && value <= kMost) return;
        damage.push_back(single(of..., " are ", value, ", and a count is from 0 to 2^62"));
    };
    const auto error = [&](double value, const auto&... of) {
        if (value >= 0 && value <= std::numeric_limits<double>::max()) return;
        damage.push_back(single(of..., " is ", value, ", and errors are numbers from 0 on"));
    };
    const ObjectInfo& object = tree.object;
    count(object.voxels, "the voxels of the object");
    count(object.leaves, "the leaf nodes of the object");
    count(object.tiles, "the tiles of the object");
    for (const Damage& box : boxDamage(tree)) damage.push_back(box);
    for (const SphereTreeLevel& level : tree.levels) {
        count(level.pyramidVoxels, "the voxels of the volume of level ", level.level);
        if (level.error) {
            count(level.error->covered, "the covered voxels of level ", level.level);
            count(level.error->excess, "the excess voxels of level ", level.level);
            count(level.error->missing, "the missing voxels of level ", level.level);
            error(level.error->hammingPercent, "the Hamming error of level ", level.level);
            error(level.error->hausdorff, "the Hausdorff distance of level ", level.level);
        }
        if (level.stored) {
            error(level.stored->hammingPercent, "the stored Hamming error of level ", level.level);
            error(level.stored->reachWorld, "the stored reach of level ", level.level);
        }
    }
    return damage;
}

std::vector<Damage> treeDamage(const SphereTree& tree)
{
    std::vector<Damage> damage = shapeDamage(tree);
    if (!damage.empty()) return damage;
    const auto add = [&](const std::vector<Damage>& more) {
        damage.insert(damage.end(), more.begin(), more.end());
    };
    add(figureDamage(tree));
    add(sphereDamage(tree.spheres, tree.subdivision));
    Breach balls;
    for (int32_t id = 0; id < tree.size(); ++id) {
        const int32_t radiusSq = tree.radiusSq[id];
        if (radiusSq > 0 || radiusSq == -1) continue;
        balls.add(id, " has the radius_sq ", radiusSq, ", which no sphere has");
    }
    balls.report(damage, "radius_sq is less than 1");
    add(parentDamage(tree));
    add(edgeDamage(tree.dag, tree));
    add(trackDamage(tree));
    return damage;
}

void throwFirst(const std::vector<Damage>& damage)
{
    if (!damage.empty()) OPENVDB_THROW(openvdb::ValueError, damage.front().first);
}

void requireCuts(const SphereCuts& cuts, int subdivision)
{
    const std::string damage = cutsDamage(cuts);
    if (!damage.empty()) OPENVDB_THROW(openvdb::ValueError, damage);
    throwFirst(sphereDamage(cuts.spheres, subdivision));
}

} // namespace detail

void SphereTree::validate() const
{
    detail::throwFirst(detail::treeDamage(*this));
    detail::requireCuts(cuts, subdivision);
    settings.validate();
}

} // namespace openvdb_spheretree
