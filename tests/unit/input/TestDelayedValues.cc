// SPDX-License-Identifier: Apache-2.0
/// @file TestDelayedValues.cc
/// @brief Leaves whose values are still in a file: each is tried, and stays there.

#include "support/TemporaryFolder.h"

#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/input/DelayedValues.h>

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace openvdb_spheretree;
using spheretree_test::TemporaryFolder;

constexpr int kLeaves = 3;

/// A grid of three leaves in a file, packed by zip.
template <typename GridT>
class StoredGrid {
public:
    StoredGrid()
    {
        openvdb::initialize();
        auto grid = GridT::create();
        std::mt19937 random(9);
        for (int i = 0; i < kLeaves * 512; ++i) {
            const openvdb::Coord voxel(i >> 6, i >> 3 & 7, i & 7);
            grid->tree().setValueOn(voxel, typename GridT::ValueType(random() % 1000));
        }
        grid->setName("grid");
        openvdb::io::File file(mPath);
        file.setCompression(openvdb::io::COMPRESS_ZIP);
        file.write(openvdb::GridCPtrVec{grid});
    }

    /// Makes the start of a leaf's packed values one that zip never has.
    void damage(int leaf) const
    {
        std::fstream file(mPath, std::ios::in | std::ios::out | std::ios::binary);
        const std::string bytes(std::istreambuf_iterator<char>(file), {});
        file.clear();
        file.seekp(std::streamoff(beginsOfValues(bytes).at(size_t(leaf))));
        file.write("\xff\xff", 2);
    }

    typename GridT::Ptr opened() const
    {
        openvdb::io::File file(mPath);
        file.setCopyMaxBytes(0);
        file.open(/*delayLoad=*/true);
        return openvdb::gridPtrCast<GridT>(file.readGrid("grid"));
    }

private:
    /// Leaves are the last in a file, each with its packed values, and the length of these before them.
    static std::vector<size_t> beginsOfValues(const std::string& bytes)
    {
        constexpr size_t kBefore = 64 + 1 + 8; // bytes: mask, what is stored, length
        std::vector<size_t> begins;
        size_t end = bytes.size();
        for (size_t at = end - 1; at > kBefore && begins.size() < kLeaves; --at) {
            int64_t length;
            std::memcpy(&length, &bytes[at - 8], sizeof(length));
            if (length != int64_t(end - at)) continue;
            begins.push_back(at);
            end = at - kBefore;
        }
        std::reverse(begins.begin(), begins.end());
        return begins;
    }

    TemporaryFolder mFolder;
    std::string mPath = mFolder.path() + "/grid.vdb";
};

template <typename GridT>
int leavesInTheFile(const GridT& grid)
{
    int leaves = 0;
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) leaves += leaf->buffer().isOutOfCore();
    return leaves;
}

template <typename GridT>
class DelayedValues : public testing::Test {};
using Grids = testing::Types<openvdb::FloatGrid, openvdb::Int64Grid, openvdb::Vec3DGrid>;
TYPED_TEST_SUITE(DelayedValues, Grids);

TYPED_TEST(DelayedValues, StayInTheFileWhereTheyAreSound)
{
    const StoredGrid<TypeParam> stored;
    const auto grid = stored.opened();
    ASSERT_EQ(leavesInTheFile(*grid), kLeaves);
    EXPECT_NO_THROW(requireReadableValues(*grid));
    EXPECT_EQ(leavesInTheFile(*grid), kLeaves);
}

TYPED_TEST(DelayedValues, AreDamagedIfThoseOfOneLeafAre)
{
    for (int leaf = 0; leaf < kLeaves; ++leaf) {
        const StoredGrid<TypeParam> stored;
        stored.damage(leaf);
        const auto grid = stored.opened();
        EXPECT_THROW(requireReadableValues(*grid), openvdb::Exception) << leaf;
        EXPECT_EQ(leavesInTheFile(*grid), kLeaves);
    }
}

class Stopped : public openvdb::util::NullInterrupter {
public:
    bool wasInterrupted(int) override { return true; }
};

TYPED_TEST(DelayedValues, AreNotReadOnceTheInterrupterSaysSo)
{
    Stopped stopped;
    EXPECT_THROW(requireReadableValues(*StoredGrid<TypeParam>().opened(), &stopped), Interrupted);
}

} // namespace
