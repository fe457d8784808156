// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tight/cluster/VoxelBlocks.h>

#include "support/MergedLeaves.h"

#include <map>

namespace {

using namespace openvdb_spheretree::tight;
using namespace spheretree_test;

/// The blocks of 2^k voxels a side, from a list of voxels; by place.
std::vector<VoxelBlock> blocksOf(const Voxels& voxels, int k)
{
    struct Sum {
        int64_t at[3] = {0, 0, 0}, voxels = 0;
    };
    std::map<Coord, Sum> sums;
    for (const Coord& v : voxels) {
        Sum& sum = sums[v >> k];
        for (int a = 0; a < 3; ++a) sum.at[a] += v[a];
        ++sum.voxels;
    }
    std::vector<VoxelBlock> blocks;
    for (const auto& [block, sum] : sums) {
        VoxelBlock& made = blocks.emplace_back();
        for (int a = 0; a < 3; ++a) {
            made.center[a] =
                int64_t(std::floor(16.0 * double(sum.at[a]) / double(sum.voxels) + 0.5));
        }
        made.voxels = sum.voxels;
    }
    return blocks;
}

void expectBlocks(const Voxels& voxels, std::size_t most, int k)
{
    const MergedLeaves merged(voxels);
    const auto blocks = voxelBlocks(merged.object.level(0), most);
    const auto expected = blocksOf(merged.voxels, k);
    ASSERT_LE(expected.size(), most);
    ASSERT_EQ(blocks.size(), expected.size());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        for (int a = 0; a < 3; ++a) EXPECT_EQ(blocks[i].center[a], expected[i].center[a]);
        EXPECT_EQ(blocks[i].voxels, expected[i].voxels);
    }
}

TEST(VoxelBlocks, AreTheVoxelsThemselvesWhereThereIsRoom)
{
    Random random(1);
    const Voxels voxels = shapes::noise(Coord(7, 6, 9), 0.4, random);
    expectBlocks(voxels, voxels.size(), 0);
}

TEST(VoxelBlocks, AreAsSmallAsTheirNumberAllows)
{
    Random random(2);
    Voxels voxels = shapes::noise(Coord(13, 14, 15), 0.5, random);
    for (Coord& v : voxels) v -= Coord(9, 3, 20); // negative ones, and halves
    for (int k = 1; k < 5; ++k) expectBlocks(voxels, blocksOf(voxels, k).size(), k);
}

TEST(VoxelBlocks, HaveEveryVoxelOfAThinSheet)
{
    Voxels sheet;
    for (int x = 0; x < 20; ++x) {
        for (int y = 0; y < 20; ++y) sheet.push_back(Coord(x, y, 3));
    }
    expectBlocks(sheet, 30, 2); // 400 voxels in 25 blocks, not in 400 / 64
    EXPECT_TRUE(voxelBlocks(SampleLevel({}, {}), 10).empty());
}

} // namespace
