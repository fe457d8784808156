// SPDX-License-Identifier: Apache-2.0
#include "VoxelBlocks.h"

#include <openvdb_spheretree/tight/fit/FineSphere.h>

#include <openvdb/math/Coord.h>

#include <algorithm>

namespace openvdb_spheretree::tight {

namespace {

using openvdb::Coord;

/// The voxels of a block, added up.
struct BlockSum {
    Coord block; ///< coordinates of its voxels without the lowest k bits
    int64_t sum[3] = {0, 0, 0};
    int64_t voxels = 0;
};

/// Joins the sums of equal blocks.
void join(std::vector<BlockSum>& sums)
{
    std::stable_sort(sums.begin(), sums.end(),
        [](const BlockSum& a, const BlockSum& b) { return a.block < b.block; });
    std::size_t size = 0;
    for (const BlockSum& some : sums) {
        if (size == 0 || sums[size - 1].block != some.block) {
            sums[size++] = some;
            continue;
        }
        BlockSum& all = sums[size - 1];
        for (int a = 0; a < 3; ++a) all.sum[a] += some.sum[a];
        all.voxels += some.voxels;
    }
    sums.resize(size);
}

/// Appends the blocks of one leaf, of 2^k voxels a side, k at most 3.
void appendLeaf(const Coord& origin, const LeafMask& mask, int k, std::vector<BlockSum>& sums)
{
    const int perSide = kLeafDim >> k;
    BlockSum blocks[kLeafVoxels];
    mask.visitOn([&](uint32_t index) {
        const int32_t ijk[3] = {int32_t(index >> 6), int32_t(index >> 3 & 7), int32_t(index & 7)};
        BlockSum& block =
            blocks[((ijk[0] >> k) * perSide + (ijk[1] >> k)) * perSide + (ijk[2] >> k)];
        for (int a = 0; a < 3; ++a) {
            block.block[a] = (origin[a] + ijk[a]) >> k;
            block.sum[a] += origin[a] + ijk[a];
        }
        ++block.voxels;
    });
    for (int b = 0; b < perSide * perSide * perSide; ++b) {
        if (blocks[b].voxels > 0) sums.push_back(blocks[b]);
    }
}

int64_t rounded(int64_t sum, int64_t count)
{
    const int64_t twice = 2 * sum + count; // floor of it over 2 count is the nearest
    const int64_t quotient = twice / (2 * count);
    return quotient - (twice % (2 * count) < 0);
}

} // namespace

std::vector<VoxelBlock> voxelBlocks(const SampleLevel& object, std::size_t most)
{
    int64_t voxels = 0;
    for (std::size_t leaf = 0; leaf < object.leafCount(); ++leaf) {
        voxels += object.mask(leaf).count();
    }
    constexpr int kWholeLeaf = 3; // 2^3 voxels a side
    int k = 0;                    // no smaller blocks could be few enough
    while (k < kWholeLeaf && voxels >> (3 * k) > int64_t(most)) ++k;
    std::vector<BlockSum> sums;
    for (std::size_t leaf = 0; leaf < object.leafCount(); ++leaf) {
        appendLeaf(object.origin(leaf), object.mask(leaf), k, sums);
    }
    join(sums);
    while (sums.size() > most) {
        for (BlockSum& some : sums) some.block >>= 1;
        join(sums);
    }
    std::vector<VoxelBlock> blocks;
    for (const BlockSum& some : sums) {
        VoxelBlock& block = blocks.emplace_back();
        for (int a = 0; a < 3; ++a) block.center[a] = rounded(kFine * some.sum[a], some.voxels);
        block.voxels = some.voxels;
    }
    return blocks;
}

} // namespace openvdb_spheretree::tight
