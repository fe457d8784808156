// SPDX-License-Identifier: Apache-2.0
/// @file NearestVoxel.cc
/// @brief Building and descending the tree of boxes. Recursion is as deep as the tree: at most 11
/// levels, since groups of eight over 2^31 items are no more.

#include "NearestVoxel.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/Masks.h>
#include <openvdb_spheretree/voxel/NearestBit.h>

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Coord;

/// Morton order without building keys: the axis whose coordinates differ in the highest bit
/// decides.
bool mortonLess(const Coord& a, const Coord& b)
{
    int axis = 0;
    uint32_t highest = 0;
    for (int i = 0; i < 3; ++i) {
        const uint32_t differ = uint32_t(a[i]) ^ uint32_t(b[i]);
        if (highest < differ && highest < (highest ^ differ)) { // a higher leading bit
            axis = i;
            highest = differ;
        }
    }
    return a[axis] < b[axis];
}

/// Three squares of 2^30 fit 63 bits.
int64_t clamped(int64_t distance) { return std::min(distance, NearestVoxel::kFar2); }

/// Bits of a row that are next to each other: [first, last].
struct BitRun {
    int first, last;
};

/// @return the run of a row, which is not empty, that is nearest to @a point, where bit z is the
///         interval from z - 1/2 to z + 1/2.
BitRun nearestRun(uint32_t row, double point)
{
    const int split = int(std::max(0.0, std::min(std::floor(point) + 1, 8.0)));
    const uint32_t below = row & ((1u << split) - 1), above = row & ~((1u << split) - 1);
    int z = below ? highestBit(below) : lowestBit(above);
    if (below && above && lowestBit(above) - point < point - z) z = lowestBit(above);
    BitRun run{z, z};
    while (run.first > 0 && row >> (run.first - 1) & 1) --run.first;
    while (run.last < 7 && row >> (run.last + 1) & 1) ++run.last;
    return run;
}

/// @return the cubes of a box of voxels.
NearestVoxel::Block cubesOf(const int32_t lo[3], const int32_t hi[3])
{
    NearestVoxel::Block block;
    for (int a = 0; a < 3; ++a) {
        block.lo[a] = lo[a] - 0.5;
        block.hi[a] = hi[a] + 0.5;
    }
    return block;
}

} // namespace

NearestVoxel::NearestVoxel(const openvdb::MaskTree& mask, const Distance& distance)
    : mDistance(distance)
{
    std::vector<const LeafNode*> leaves;
    for (auto leaf = mask.cbeginLeaf(); leaf; ++leaf) {
        if (!leaf->isEmpty()) leaves.push_back(&*leaf);
    }
    mItems.resize(leaves.size());
    parallelFor(leaves.size(), nullptr, [&](std::size_t i) { mItems[i] = itemOf(*leaves[i]); });
    forEachTile(mask, [&](const openvdb::CoordBBox& box) {
        const Coord &lo = box.min(), &hi = box.max();
        mItems.push_back({{{lo[0], lo[1], lo[2]}, {hi[0], hi[1], hi[2]}}, lo, /*solid=*/true, {}});
    });
    group();
}

NearestVoxel::Item NearestVoxel::itemOf(const openvdb::MaskTree::LeafNodeType& leaf)
{
    Item item;
    item.origin = leaf.origin();
    uint64_t anyX = 0; // bit 8 y + z
    uint32_t xs = 0, ys = 0, zs = 0;
    item.voxels = LeafMask::from(leaf.getValueMask());
    for (int x = 0; x < 8; ++x) {
        anyX |= item.voxels[x];
        if (item.voxels[x]) xs |= 1u << x;
    }
    for (int y = 0; y < 8; ++y) {
        const uint32_t row = anyX >> (8 * y) & 0xff;
        zs |= row;
        if (row) ys |= 1u << y;
    }
    const uint32_t along[3] = {xs, ys, zs};
    int64_t volume = 1;
    for (int a = 0; a < 3; ++a) {
        item.box.lo[a] = item.origin[a] + lowestBit(along[a]);
        item.box.hi[a] = item.origin[a] + highestBit(along[a]);
        volume *= item.box.hi[a] - item.box.lo[a] + 1;
    }
    item.solid = int64_t(leaf.onVoxelCount()) == volume;
    return item;
}

void NearestVoxel::group()
{
    tbb::parallel_sort(mItems.begin(), mItems.end(),
        [](const Item& a, const Item& b) { return mortonLess(a.origin, b.origin); });
    mLevels.emplace_back();
    for (const Item& item : mItems) mLevels[0].push_back(item.box);
    while (mLevels.back().size() > 1) {
        const std::vector<Box>& below = mLevels.back();
        std::vector<Box> boxes;
        for (std::size_t i = 0; i < below.size(); i += kFanout) {
            Box box = below[i];
            for (std::size_t j = i + 1; j < std::min(i + kFanout, below.size()); ++j) {
                for (int a = 0; a < 3; ++a) {
                    box.lo[a] = std::min(box.lo[a], below[j].lo[a]);
                    box.hi[a] = std::max(box.hi[a], below[j].hi[a]);
                }
            }
            boxes.push_back(box);
        }
        mLevels.push_back(std::move(boxes));
    }
}

/// No voxel of the box is nearer than this.
int64_t NearestVoxel::nearSq(const Box& box, const int64_t point2[3]) const
{
    int64_t gap[3];
    for (int a = 0; a < 3; ++a) {
        const int64_t below = 2 * int64_t(box.lo[a]) - point2[a];
        const int64_t above = point2[a] - 2 * int64_t(box.hi[a]);
        gap[a] = clamped(std::max<int64_t>({below, above, 0}));
    }
    return mDistance.lengthSq(gap[0], gap[1], gap[2]);
}

/// Some voxel of the box is at least as near: one on the face nearest along some axis, which may be
/// anywhere on it.
int64_t NearestVoxel::faceSq(const Box& box, const int64_t point2[3]) const
{
    int64_t far[3], near[3];
    for (int a = 0; a < 3; ++a) {
        const int64_t lo = std::abs(2 * int64_t(box.lo[a]) - point2[a]);
        const int64_t hi = std::abs(2 * int64_t(box.hi[a]) - point2[a]);
        far[a] = std::max(lo, hi);
        near[a] = std::min(lo, hi);
        if (far[a] > kFar2) return std::numeric_limits<int64_t>::max();
    }
    return std::min({mDistance.lengthSq(near[0], far[1], far[2]),
        mDistance.lengthSq(far[0], near[1], far[2]), mDistance.lengthSq(far[0], far[1], near[2])});
}

int64_t NearestVoxel::distSq(const int64_t point2[3], int64_t enough) const
{
    Query query{point2, enough, std::numeric_limits<int64_t>::max()};
    if (!mItems.empty()) searchNode(mLevels.size() - 1, 0, query);
    return query.best;
}

int64_t NearestVoxel::nearest(const Coord& voxel, Coord& nearest) const
{
    const int64_t point2[3] = {2 * int64_t(voxel[0]), 2 * int64_t(voxel[1]), 2 * int64_t(voxel[2])};
    Query query{point2, -1, std::numeric_limits<int64_t>::max()};
    searchNode(mLevels.size() - 1, 0, query);
    nearest = query.voxel;
    return query.best;
}

bool NearestVoxel::anyWithin(const int64_t point2[3], int64_t limit) const
{
    if (limit < 0 || mItems.empty()) return false;
    Query query{point2, limit, limit + 1}; // what is farther need not be looked at
    if (nearSq(mLevels.back()[0], point2) <= limit) searchNode(mLevels.size() - 1, 0, query);
    return query.best <= limit;
}

bool NearestVoxel::areAllWithin(const openvdb::CoordBBox& box, double distance2) const
{
    int64_t center2[3], side[3];
    for (int a = 0; a < 3; ++a) {
        side[a] = int64_t(box.max()[a]) - box.min()[a];
        center2[a] = int64_t(box.min()[a]) + box.max()[a];
    }
    const double diagonal = std::sqrt(double(mDistance.lengthSq(side[0], side[1], side[2])));
    constexpr double kLess = 1 - 1e-12; // by more than all that the roots may be off
    const double reach = distance2 * kLess - diagonal / kLess;
    if (reach < 0) return false;
    return anyWithin(center2, int64_t(reach * reach * kLess));
}

void NearestVoxel::searchNode(std::size_t level, std::size_t node, Query& query) const
{
    if (level == 0) {
        searchItem(mItems[node], query);
        return;
    }
    struct Near {
        int64_t sq;
        std::size_t child;
    } order[kFanout];
    int count = 0;
    const std::vector<Box>& boxes = mLevels[level - 1];
    const std::size_t end = std::min((node + 1) * kFanout, boxes.size());
    for (std::size_t child = node * kFanout; child < end; ++child) {
        const int64_t sq = nearSq(boxes[child], query.point2);
        if (sq >= query.best) continue;
        if (faceSq(boxes[child], query.point2) <= query.enough) {
            query.best = query.enough;
            return;
        }
        int at = count++;
        for (; at > 0 && order[at - 1].sq > sq; --at) order[at] = order[at - 1];
        order[at] = {sq, child};
    }
    for (int i = 0; i < count && order[i].sq < query.best; ++i) {
        searchNode(level - 1, order[i].child, query);
        if (query.best <= query.enough) return;
    }
}

void NearestVoxel::searchItem(const Item& item, Query& query) const
{
    if (item.solid) {
        const int64_t sq = nearSq(item.box, query.point2);
        if (sq >= query.best) return;
        query.best = sq;
        for (int a = 0; a < 3; ++a) {
            const int64_t from = item.box.lo[a], to = item.box.hi[a];
            query.voxel[a] = int32_t(std::max(from, std::min(query.point2[a] >> 1, to)));
        }
        return;
    }
    int64_t local2[3]; // the point, from the leaf's corner
    for (int a = 0; a < 3; ++a) local2[a] = query.point2[a] - 2 * int64_t(item.origin[a]);
    for (int x = 0; x < 8; ++x) {
        const int64_t dx = clamped(std::abs(2 * x - local2[0]));
        if (!item.voxels[x] || mDistance.lengthSq(dx, 0, 0) >= query.best) continue;
        for (int y = 0; y < 8; ++y) {
            const uint32_t row = (item.voxels[x] >> (8 * y)) & 0xff;
            const int64_t dy = clamped(std::abs(2 * y - local2[1]));
            if (!row || mDistance.lengthSq(dx, dy, 0) >= query.best) continue;
            const int z = nearestBit(row, local2[2]);
            const int64_t dz = clamped(std::abs(2 * z - local2[2]));
            const int64_t sq = mDistance.lengthSq(dx, dy, dz);
            if (sq >= query.best) continue;
            query.best = sq;
            query.voxel = item.origin.offsetBy(x, y, z);
        }
    }
}

NearestVoxel::Block NearestVoxel::blockOf(const Coord& voxel)
{
    return cubesOf(voxel.asPointer(), voxel.asPointer());
}

double NearestVoxel::nearestBlock(const double point[3], Block& block) const
{
    constexpr double kNone = std::numeric_limits<double>::infinity();
    BlockQuery query{point, block.empty() ? kNone : blockMeasure(block, point), block};
    searchBlocks(mLevels.size() - 1, 0, query);
    return mDistance.isEuclidean() ? std::sqrt(query.best) : query.best;
}

double NearestVoxel::blockMeasure(const Block& block, const double point[3]) const
{
    double gap[3];
    for (int a = 0; a < 3; ++a) {
        gap[a] = std::max(std::max(block.lo[a] - point[a], point[a] - block.hi[a]), 0.0);
    }
    if (!mDistance.isEuclidean()) return mDistance.norm(gap[0], gap[1], gap[2]);
    return gap[0] * gap[0] + gap[1] * gap[1] + gap[2] * gap[2];
}

void NearestVoxel::searchBlocks(std::size_t level, std::size_t node, BlockQuery& query) const
{
    const std::vector<Box>& boxes = mLevels[level];
    if (level == 0) {
        const Block cubes = cubesOf(boxes[node].lo, boxes[node].hi);
        const double distance = blockMeasure(cubes, query.point);
        if (distance >= query.best) return;
        if (!mItems[node].solid) return searchRows(mItems[node], query);
        query.best = distance;
        query.block = cubes;
        return;
    }
    struct Near {
        double distance;
        std::size_t child;
    } order[kFanout];
    int count = 0;
    const std::vector<Box>& below = mLevels[level - 1];
    const std::size_t end = std::min((node + 1) * kFanout, below.size());
    for (std::size_t child = node * kFanout; child < end; ++child) {
        const double distance =
            blockMeasure(cubesOf(below[child].lo, below[child].hi), query.point);
        if (distance >= query.best) continue;
        int at = count++;
        for (; at > 0 && order[at - 1].distance > distance; --at) order[at] = order[at - 1];
        order[at] = {distance, child};
    }
    for (int i = 0; i < count && order[i].distance < query.best; ++i) {
        searchBlocks(level - 1, order[i].child, query);
    }
}

void NearestVoxel::searchRows(const Item& item, BlockQuery& query) const
{
    const Coord& origin = item.origin;
    for (int x = 0; x < 8; ++x) {
        for (int y = 0; item.voxels[x] && y < 8; ++y) {
            const uint32_t row = (item.voxels[x] >> (8 * y)) & 0xff;
            if (!row) continue;
            const BitRun run = nearestRun(row, query.point[2] - origin[2]);
            const int32_t lo[3] = {origin[0] + x, origin[1] + y, origin[2] + run.first};
            const int32_t hi[3] = {lo[0], lo[1], origin[2] + run.last};
            const Block cubes = cubesOf(lo, hi);
            const double distance = blockMeasure(cubes, query.point);
            if (distance >= query.best) continue;
            query.best = distance;
            query.block = cubes;
        }
    }
}

} // namespace openvdb_spheretree::detail
