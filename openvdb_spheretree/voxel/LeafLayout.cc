// SPDX-License-Identifier: Apache-2.0
#include "LeafLayout.h"

#include "BoxSides.h"
#include "Masks.h"
#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Parallel.h>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>

namespace openvdb_spheretree {

namespace {

/// Coordinates as numbers without a sign, in the same order.
uint32_t ordered(int32_t coordinate) { return uint32_t(coordinate) ^ 0x80000000u; }
int32_t coordinate(uint64_t ordered) { return int32_t(uint32_t(ordered) ^ 0x80000000u); }
uint64_t ordered(int32_t first, int32_t second)
{
    return uint64_t(ordered(first)) << 32 | ordered(second);
}

/// Stands for the leaves of tiles, which have no node.
constexpr uint32_t kInTile = std::numeric_limits<uint32_t>::max();

/// A leaf before it has a number.
struct Place {
    uint64_t yz;
    uint32_t x, node; ///< node: its index among the tree's leaf nodes

    bool operator<(const Place& o) const { return x != o.x ? x < o.x : yz < o.yz; }
    openvdb::Coord origin() const { return {coordinate(x), coordinate(yz >> 32), coordinate(yz)}; }
};

Place placeOf(const openvdb::Coord& origin, uint32_t node)
{
    return {ordered(origin[1], origin[2]), ordered(origin[0]), node};
}

/// Leaves are ordered by key, then by number.
struct Keyed {
    uint64_t key;
    uint32_t leaf;

    bool operator<(const Keyed& o) const { return key != o.key ? key < o.key : leaf < o.leaf; }
};

/// @return all leaves that hold voxels, in order.
std::vector<Place> placesOf(const openvdb::MaskTree& level,
    const std::vector<const detail::LeafNode*>& nodes, int64_t count)
{
    std::vector<Place> places;
    detail::resizeLarge(places, nodes.size());
    detail::parallelFor(nodes.size(), nullptr, [&](std::size_t i) {
        places[i] = placeOf(nodes[i]->origin(), nodes[i]->isEmpty() ? kInTile : uint32_t(i));
    });
    places.erase(std::remove_if(places.begin(), places.end(),
                     [](const Place& place) { return place.node == kInTile; }),
        places.end());
    places.reserve(std::size_t(count));
    detail::forEachTile(level, [&](const openvdb::CoordBBox& tile) {
        const auto side = int(detail::sidesOf(tile)[0]);
        for (int x = 0; x < side; x += kLeafDim) {
            for (int y = 0; y < side; y += kLeafDim) {
                for (int z = 0; z < side; z += kLeafDim) {
                    places.push_back(placeOf(tile.min().offsetBy(x, y, z), kInTile));
                }
            }
        }
    });
    tbb::parallel_sort(places.begin(), places.end());
    return places;
}

} // namespace

void LeafLayout::requireRoom(const openvdb::MaskTree& level)
{
    const int64_t leaves = detail::leafNodesOf(level);
    if (leaves > std::numeric_limits<uint32_t>::max() / 2) {
        OPENVDB_THROW(openvdb::ValueError,
            "the object has "
                << leaves
                << " leaf nodes, those inside its tiles included, more than 2^31: use a "
                   "larger voxel, or split the object");
    }
    // The layout itself, twice while it is sorted, and at least the gaps along x.
    detail::requireMemory(leaves, 2 * 100 + 2 * 64);
}

LeafLayout::LeafLayout(const openvdb::MaskTree& level)
{
    requireRoom(level);
    collectLeaves(level);
    for (uint32_t leaf = 0; leaf < leafCount(); ++leaf) {
        if (leaf == 0 || mOrigins[leaf][0] != mOrigins[leaf - 1][0]) mSlabBegin.push_back(leaf);
    }
    mSlabBegin.push_back(leafCount());
    for (Lines& lines : mLines) {
        lines.leaves.resize(leafCount());
        lines.position.resize(leafCount());
    }
    orderAlongX();
    orderAlongY();
    std::vector<uint32_t>& alongZ = mLines[int(Axis::Z)].leaves;
    std::iota(alongZ.begin(), alongZ.end(), 0u);
    tbb::parallel_invoke(
        [this] { cutRuns(Axis::X); }, [this] { cutRuns(Axis::Y); }, [this] { cutRuns(Axis::Z); });
}

void LeafLayout::collectLeaves(const openvdb::MaskTree& level)
{
    const int64_t count = detail::leafNodesOf(level);
    std::vector<const detail::LeafNode*> nodes;
    nodes.reserve(level.leafCount());
    level.getNodes(nodes);
    const std::vector<Place> places = placesOf(level, nodes, count);

    detail::resizeLarge(mOrigins, places.size());
    detail::resizeLarge(mMasks, places.size());
    std::atomic<int64_t> voxels{0};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places.size(), 1024), [&](auto range) {
        int64_t sum = 0;
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
            mOrigins[i] = places[i].origin();
            mMasks[i] = places[i].node == kInTile
                ? LeafMask::full()
                : LeafMask::from(nodes[places[i].node]->getValueMask());
            sum += mMasks[i].count();
        }
        voxels += sum;
    });
    mVoxelCount = voxels;
}

void LeafLayout::orderAlongX()
{
    std::vector<Keyed> order(leafCount());
    detail::parallelFor(order.size(), nullptr, [&](std::size_t i) {
        order[i] = {ordered(mOrigins[i][1], mOrigins[i][2]), uint32_t(i)};
    });
    tbb::parallel_sort(order.begin(), order.end());
    std::vector<uint32_t>& leaves = mLines[int(Axis::X)].leaves;
    detail::parallelFor(order.size(), nullptr, [&](std::size_t i) { leaves[i] = order[i].leaf; });
}

/// Each slab by z, then y.
void LeafLayout::orderAlongY()
{
    std::vector<uint32_t>& leaves = mLines[int(Axis::Y)].leaves;
    using Order = std::vector<Keyed>;
    detail::parallelForWithScratch<Order>(slabCount(), nullptr, [&](std::size_t i, Order& order) {
        const Slab s = slab(uint32_t(i));
        order.clear();
        for (uint32_t leaf = s.begin; leaf < s.end; ++leaf) {
            order.push_back({ordered(mOrigins[leaf][2], mOrigins[leaf][1]), leaf});
        }
        std::sort(order.begin(), order.end());
        for (uint32_t k = 0; k < order.size(); ++k) leaves[s.begin + k] = order[k].leaf;
    });
}

void LeafLayout::cutRuns(Axis axis)
{
    // The other two axes tell lines apart.
    const int along = int(axis), first = along == 0 ? 1 : 0, second = along == 2 ? 1 : 2;
    Lines& lines = mLines[along];
    const auto touches = [&](const openvdb::Coord& a, const openvdb::Coord& b) {
        return a[first] == b[first] && a[second] == b[second]
            && int64_t(a[along]) + kLeafDim == b[along];
    };
    std::size_t slab = 0;
    for (uint32_t i = 0; i < leafCount(); ++i) {
        const uint32_t leaf = lines.leaves[i];
        lines.position[leaf] = i;
        if (i > 0 && touches(mOrigins[lines.leaves[i - 1]], mOrigins[leaf])) continue;
        if (axis != Axis::X && i == mSlabBegin[slab]) {
            lines.slabBegin.push_back(uint32_t(lines.runBegin.size()));
            ++slab;
        }
        lines.runBegin.push_back(i);
    }
    if (axis != Axis::X) lines.slabBegin.push_back(uint32_t(lines.runBegin.size()));
    lines.runBegin.push_back(leafCount());
}

uint32_t LeafLayout::slabOf(uint32_t leaf) const
{
    const auto next = std::upper_bound(mSlabBegin.begin(), mSlabBegin.end(), leaf);
    return uint32_t(next - mSlabBegin.begin()) - 1;
}

std::optional<uint32_t> LeafLayout::findLeaf(const openvdb::Coord& ijk) const
{
    const openvdb::Coord origin = ijk & ~7;
    const auto it = std::lower_bound(mOrigins.begin(), mOrigins.end(), origin);
    if (it == mOrigins.end() || *it != origin) return std::nullopt;
    return uint32_t(it - mOrigins.begin());
}

} // namespace openvdb_spheretree
