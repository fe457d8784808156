// SPDX-License-Identifier: Apache-2.0
#include "VoxelMoments.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <algorithm>
#include <vector>

namespace openvdb_spheretree::detail {
namespace {

using Integer = VoxelMoments::Integer;

/// Of the voxels of a row along z, which are the bits of a byte.
struct Row {
    int count = 0, first = 0, second = 0;
};

constexpr std::array<Row, 256> allRows()
{
    std::array<Row, 256> rows{};
    for (int bits = 0; bits < 256; ++bits) {
        for (int z = 0; z < kLeafDim; ++z) {
            if (!(bits >> z & 1)) continue;
            rows[bits].count += 1;
            rows[bits].first += z;
            rows[bits].second += z * z;
        }
    }
    return rows;
}

constexpr std::array<Row, 256> kRows = allRows();

std::array<Integer, 3> placeOf(const openvdb::Coord& ijk) { return {ijk[0], ijk[1], ijk[2]}; }

template <typename TreeType>
VoxelMoments momentsOfTree(const TreeType& tree, openvdb::util::NullInterrupter* interrupter)
{
    constexpr std::size_t kAtOnce = 256;
    std::vector<const typename TreeType::LeafNodeType*> leaves;
    tree.getNodes(leaves);
    std::vector<VoxelMoments> parts((leaves.size() + kAtOnce - 1) / kAtOnce);
    parallelFor(parts.size(), interrupter, [&](std::size_t part) {
        const std::size_t end = std::min(leaves.size(), (part + 1) * kAtOnce);
        for (std::size_t i = part * kAtOnce; i < end; ++i) {
            const LeafMask mask = LeafMask::from(leaves[i]->getValueMask());
            parts[part] += momentsOf(mask).movedBy(placeOf(leaves[i]->origin()));
        }
    });
    VoxelMoments sum;
    for (const VoxelMoments& part : parts) sum += part;
    forEachTile(tree, [&](const openvdb::CoordBBox& tile) {
        const int64_t side = int64_t(tile.max()[0]) - tile.min()[0] + 1;
        sum += momentsOfCube(side).movedBy(placeOf(tile.min()));
    });
    return sum;
}

} // namespace

VoxelMoments& VoxelMoments::operator+=(const VoxelMoments& other)
{
    count += other.count;
    for (int a = 0; a < 3; ++a) first[a] += other.first[a];
    for (int i = 0; i < 6; ++i) second[i] += other.second[i];
    return *this;
}

/// Of (p + o)(q + u): pq + o q + u p + o u, summed.
VoxelMoments VoxelMoments::movedBy(const std::array<Integer, 3>& offset) const
{
    VoxelMoments moved = *this;
    for (int a = 0; a < 3; ++a) {
        moved.first[a] += offset[a] * count;
        for (int b = a; b < 3; ++b) {
            moved.second[product(a, b)] +=
                offset[a] * first[b] + offset[b] * first[a] + offset[a] * offset[b] * count;
        }
    }
    return moved;
}

VoxelMoments momentsOfCube(int64_t side)
{
    const Integer n = side, layer = n * n;
    const Integer sum = n * (n - 1) / 2; // 0 + 1 + .. + (n - 1)
    const Integer sumOfSquares = n * (n - 1) * (2 * n - 1) / 6;
    VoxelMoments moments;
    moments.count = layer * n;
    for (int a = 0; a < 3; ++a) {
        moments.first[a] = layer * sum;
        moments.second[a] = layer * sumOfSquares;
        moments.second[3 + a] = n * sum * sum;
    }
    return moments;
}

VoxelMoments momentsOf(const LeafMask& mask)
{
    if (mask.all()) return momentsOfCube(kLeafDim);
    int count = 0, x1 = 0, y1 = 0, z1 = 0, xx = 0, yy = 0, zz = 0, yz = 0, xz = 0, xy = 0;
    for (int x = 0; x < kLeafDim; ++x) {
        for (int y = 0; y < kLeafDim; ++y) {
            const Row& row = kRows[mask[x] >> 8 * y & 0xff];
            count += row.count;
            x1 += x * row.count;
            y1 += y * row.count;
            z1 += row.first;
            xx += x * x * row.count;
            yy += y * y * row.count;
            zz += row.second;
            yz += y * row.first;
            xz += x * row.first;
            xy += x * y * row.count;
        }
    }
    return {count, {x1, y1, z1}, {xx, yy, zz, yz, xz, xy}};
}

VoxelMoments momentsOf(const openvdb::MaskTree& tree, openvdb::util::NullInterrupter* interrupter)
{
    return momentsOfTree(tree, interrupter);
}

VoxelMoments momentsOf(const openvdb::BoolTree& tree, openvdb::util::NullInterrupter* interrupter)
{
    return momentsOfTree(tree, interrupter);
}

} // namespace openvdb_spheretree::detail
