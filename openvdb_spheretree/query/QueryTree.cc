// SPDX-License-Identifier: Apache-2.0
#include "QueryTree.h"

#include "LeafIdentity.h"
#include "QueryData.h"
#include "SphereForest.h"
#include <openvdb_spheretree/base/TextStream.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace openvdb_spheretree {
namespace {

using detail::ForestNode;
using detail::QueryData;
using detail::SphereForest;
using openvdb::Vec3d;

/// Half the diagonal of a voxel's cube, rounded up.
constexpr double kCubeRadius = 0.86602540378443876;

[[noreturn]] void refuse(const std::string& why)
{
    OPENVDB_THROW(openvdb::ValueError, "no questions can be asked of this tree: " << why);
}

void requireAnswers(const SphereTree& tree, const QueryTreeSettings& settings)
{
    tree.validate();
    if (tree.spheres.radiusWorld.size() != std::size_t(tree.size()))
        refuse("it has no stored radii");
    if (!tree.settings.dist().isEuclidean()) {
        refuse(
            "it is of the norm " + toString(tree.settings.dist()) + ", whose balls are not round");
    }
    if (tree.settings.isFit()) {
        refuse("spheres of side=fit neither hold the object nor lie inside it: build it with "
               "side=outer or side=inner");
    }
    const bool isReversible =
        tree.settings.type() == TreeType::Reversible && tree.levels.size() > 1;
    if (isReversible && settings.exactness == Exactness::Object) {
        refuse("spheres of a reversible tree do not hold those below them. Ask for "
               "Exactness::LeafUnion, which "
               "makes a new hierarchy over its leaves, or build a tight tree");
    }
    if (!(settings.scale > 0) || !std::isfinite(settings.scale)) {
        detail::TextStream text;
        text << "a tree cannot be scaled by " << settings.scale
             << ": the scale must be above 0, and finite";
        OPENVDB_THROW(openvdb::ValueError, text.str());
    }
}

/// @return the leaves' level.
const SphereTreeLevel& leafLevel(const SphereTree& tree, const QueryTreeSettings& settings)
{
    return settings.level < 0 ? tree.levels.front() : tree.level(settings.level);
}

/// Whether the tree's own spheres go above the leaves: else a hierarchy is made over these alone. That
/// of an extended tree is exact, but its spheres are so large that questions take 14 to 90 times as
/// long.
bool keepsHierarchy(const SphereTree& tree, Exactness exactness)
{
    if (const TightOptions* tight = tree.settings.find<TightOptions>()) {
        return exactness == Exactness::Object || tight->cover == Cover::Balls;
    }
    return false;
}

/// The spheres of a tree about an origin, and which of them is whose child.
class ForestMaker {
public:
    ForestMaker(const SphereTree& tree, const SphereTreeLevel& leaves, double scale)
        : mTree(tree), mLeaves(leaves), mScale(scale), mOrigin(centerOfBox())
    {}

    const Vec3d& origin() const { return mOrigin; }

    /// The leaves alone, as roots.
    SphereForest leavesOnly() const
    {
        SphereForest forest;
        forest.nodes.reserve(std::size_t(mLeaves.size()));
        for (int32_t id = mLeaves.begin; id < mLeaves.end; ++id) {
            forest.roots.push_back(id - mLeaves.begin);
            forest.nodes.push_back(node(id));
        }
        return forest;
    }

    /// The tree's own hierarchy, without what no leaf is below. A node's place is its id.
    SphereForest hierarchy() const
    {
        SphereForest forest;
        forest.nodes.reserve(std::size_t(mLeaves.end));
        for (int32_t id = 0; id < mLeaves.end; ++id) forest.nodes.push_back(node(id));
        for (int32_t id = mLeaves.end;
             id-- > 0;) { // children before parents, which have smaller ids
            if (forest.nodes[id].leaf < 0 && forest.nodes[id].children.empty()) continue;
            const int32_t parent = mTree.spheres.parent[id];
            (parent < 0 ? forest.roots : forest.nodes[parent].children).push_back(id);
        }
        return forest;
    }

private:
    Vec3d scaled(int32_t id) const { return mScale * mTree.centerWorld(id); }

    Vec3d centerOfBox() const
    {
        Vec3d low = scaled(mLeaves.begin), high = low;
        for (int32_t id = mLeaves.begin; id < mLeaves.end; ++id) {
            low = openvdb::math::minComponent(low, scaled(id));
            high = openvdb::math::maxComponent(high, scaled(id));
        }
        return 0.5 * (low + high);
    }

    /// A sphere grows by more than changes of frame can be off: a part in 10^14 of where it is.
    ForestNode node(int32_t id) const
    {
        ForestNode result;
        const Vec3d center = scaled(id);
        result.center = center - mOrigin;
        result.radius = mScale * double(mTree.spheres.radiusWorld[id])
            + 1e-15 * (center.length() + mOrigin.length());
        if (id >= mLeaves.begin) result.leaf = id - mLeaves.begin;
        return result;
    }

    const SphereTree& mTree;
    const SphereTreeLevel& mLeaves;
    double mScale;
    Vec3d mOrigin;
};

/// Stored radii are rounded one by one: a sphere that holds those below it by its numbers may miss
/// them by a rounding. Here it is made to hold them. Cost: leaves times levels.
void holdLeaves(SphereForest& forest, const SphereTree& tree)
{
    for (const ForestNode& leaf : forest.nodes) {
        if (leaf.leaf < 0) continue;
        const int32_t id = int32_t(&leaf - forest.nodes.data());
        for (int32_t above = tree.spheres.parent[id]; above >= 0;
             above = tree.spheres.parent[above]) {
            ForestNode& node = forest.nodes[above];
            const double reach = (leaf.center - node.center).length() + leaf.radius;
            node.radius = std::max(node.radius, reach * (1 + 1e-14));
        }
    }
}

void requireSize(const SphereForest& forest)
{
    const double radius = detail::enclosingSphere(forest.nodes, forest.roots).radius;
    if (radius >= detail::kLeastExtent && radius <= detail::kMostExtent) return;
    detail::TextStream text;
    text << "its radius is " << radius
         << " world units. Questions square lengths in floats, and take " << detail::kLeastExtent
         << " to " << detail::kMostExtent << ": choose another unit";
    refuse(text.str());
}

/// Fills in what the leaves promise: docs/queries.md, "Leaves and the object". Leaves of blocks are larger than those of
/// the tree by what floats round: a center is off by sqrt(3) 2^-24 of the extent, its radius grows by as much and is
/// rounded up, so no point of a leaf is farther out than 2^-21 of the extent.
void setPromises(
    QueryData& data, const SphereTree& tree, const SphereTreeLevel& leaves, double scale)
{
    const bool isOuter = !tree.settings.isInner() && !tree.settings.isGiven();
    const double padding = tree.settings.paddingVoxels(), voxel = scale * tree.voxelSize();
    if (tree.settings.dim != 3) return; // cubes reach out of the plane that 2-D balls are made for
    data.holdsObject = isOuter && padding >= kCubeRadius * (1 - 1e-12);
    const auto begin = tree.radiusSq.begin();
    const bool areDigital = leaves.level == 0
        && std::all_of(begin + leaves.begin, begin + leaves.end, [](int32_t r) { return r > 0; });
    const double rounding = 0x1p-21 * double(data.spheres.extent);
    if (isOuter && areDigital) {
        data.leafReach = data.leafInset = (padding + kCubeRadius) * voxel * (1 + 1e-6) + rounding;
    } else if (isOuter && leaves.stored) {
        data.leafReach = scale * leaves.stored->reachWorld + rounding;
    } else if (const auto* inner = tree.settings.find<InnerOptions>()) {
        data.leafInset = (inner->strict ? 0 : kCubeRadius * voxel * (1 + 1e-6)) + rounding;
        data.leafReach = data.leafInset;
    }
}

} // namespace

QueryTree makeQueryTree(const SphereTree& tree, const QueryTreeSettings& settings)
{
    requireAnswers(tree, settings);
    const SphereTreeLevel& leaves = leafLevel(tree, settings);
    const ForestMaker maker(tree, leaves, settings.scale);
    const auto data = std::make_shared<QueryData>();
    const bool keeps = keepsHierarchy(tree, settings.exactness);
    SphereForest forest = keeps ? maker.hierarchy() : maker.leavesOnly();
    data->holdsLeaves = !keeps || tree.settings.tight().cover == Cover::Balls;
    if (keeps && data->holdsLeaves) holdLeaves(forest, tree);
    requireSize(forest);
    detail::divideWideNodes(forest);
    data->spheres = detail::blocksOf(forest, leaves.size());
    data->origin = maker.origin();
    data->firstLeafId = leaves.begin;
    data->identity = detail::identityOf(tree, leaves, settings.scale);
    setPromises(*data, tree, leaves, settings.scale);
    return QueryTree(data);
}

QueryTree makeQueryTree(const SphereTree& tree, Exactness exactness)
{
    QueryTreeSettings settings;
    settings.exactness = exactness;
    return makeQueryTree(tree, settings);
}

int32_t QueryTree::leafCount() const { return mData->spheres.leafCount(); }
int32_t QueryTree::nodeId(int32_t leaf) const { return mData->firstLeafId + leaf; }

int32_t QueryTree::leafOf(int32_t nodeId) const
{
    const int64_t leaf = int64_t(nodeId) - mData->firstLeafId;
    if (leaf >= 0 && leaf < leafCount()) return int32_t(leaf);
    OPENVDB_THROW(openvdb::LookupError,
        "node " << nodeId << " is no leaf of this tree: these are " << mData->firstLeafId << " to "
                << mData->firstLeafId + leafCount() - 1);
}

Vec3d QueryTree::leafCenter(int32_t leaf) const { return mData->world(mData->spheres.leaf(leaf)); }
double QueryTree::leafRadius(int32_t leaf) const { return mData->spheres.leaf(leaf).r; }
Vec3d QueryTree::center() const { return mData->world(mData->spheres.root); }
double QueryTree::radius() const { return mData->spheres.root.r; }
bool QueryTree::holdsObject() const { return mData->holdsObject; }
bool QueryTree::holdsLeaves() const { return mData->holdsLeaves; }
double QueryTree::leafReach() const { return mData->leafReach; }
double QueryTree::leafInset() const { return mData->leafInset; }

std::size_t QueryTree::bytes() const
{
    return sizeof(QueryData) + mData->spheres.blocks.capacity() * sizeof(detail::SphereBlock)
        + mData->spheres.leafPlace.capacity() * sizeof(int32_t);
}

int32_t QueryTree::blockCount() const { return int32_t(mData->spheres.blocks.size()); }

} // namespace openvdb_spheretree
