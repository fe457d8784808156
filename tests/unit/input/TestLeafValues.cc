// SPDX-License-Identifier: Apache-2.0
// Grids whose values OpenVDB has left in the file: the same objects come of them, and the values
// stay where they are.

#include <openvdb_spheretree/input/LeafValues.h>
#include <openvdb_spheretree/input/Object.h>
#include <openvdb_spheretree/voxel/MakeGrid.h>

#include "support/PointGrids.h"

#include <openvdb/io/File.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <vector>

#include <unistd.h>

using namespace openvdb_spheretree;
using openvdb::Coord;
using openvdb::FloatGrid;

namespace {

class LeafValuesTest : public testing::Test {
protected:
    void SetUp() override
    {
        openvdb::initialize();
        if (!openvdb::io::Archive::isDelayedLoadingEnabled()) {
            GTEST_SKIP() << "OpenVDB is built without delayed loading";
        }
        std::string name = (std::filesystem::temp_directory_path() / "leaves.XXXXXX").string();
        mFile = mkstemp(name.data());
        mPath = name;
    }
    void TearDown() override
    {
        if (mFile < 0) return;
        close(mFile);
        std::filesystem::remove(mPath);
    }

    template <typename GridT>
    typename GridT::Ptr delayed(const typename GridT::Ptr& grid, uint32_t compression) const
    {
        openvdb::io::File out(mPath.string());
        out.setCompression(compression);
        out.write(openvdb::GridCPtrVec{grid});
        return openDelayed<GridT>();
    }

    template <typename GridT>
    typename GridT::Ptr openDelayed() const
    {
        openvdb::io::File in(mPath.string());
        in.setCopyMaxBytes(0);
        in.open(/*delayLoad=*/true);
        return openvdb::gridPtrCast<GridT>(in.readGrid(in.beginName().gridName()));
    }

    std::filesystem::path mPath;

private:
    int mFile = -1;
};

template <typename GridT>
std::pair<int, int> leavesInAndOutOfFile(const GridT& grid)
{
    std::pair<int, int> count{0, 0};
    for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
        ++(leaf->buffer().isOutOfCore() ? count.first : count.second);
    }
    return count;
}

/// Values of 0 to 9 in scattered leaves, some of them inactive; and a tile.
template <typename GridT>
typename GridT::Ptr scattered()
{
    using ValueT = typename GridT::ValueType;
    std::mt19937 random(20);
    const auto grid = openvdb_spheretree::detail::makeGrid<GridT>();
    for (int i = 0; i < 4000; ++i) {
        const Coord ijk(int(random() % 50) - 25, int(random() % 50) - 25, int(random() % 400));
        const ValueT value = ValueT(random() % 10);
        if (i % 5 == 0) grid->tree().setValueOff(ijk, value);
        else grid->tree().setValueOn(ijk, value);
    }
    grid->tree().addTile(1, Coord(160, 0, 0), ValueT(7), true);
    return grid;
}

openvdb::points::PointDataGrid::Ptr scatteredPoints()
{
    std::mt19937 random(21);
    std::vector<openvdb::Vec3d> positions;
    for (int i = 0; i < 1000; ++i) {
        positions.push_back({random() % 400 / 8.0, random() % 400 / 8.0, random() % 400 / 8.0});
    }
    return spheretree_test::pointsAt(positions);
}

template <typename GridT>
void expectSameObject(
    const typename GridT::Ptr& whole, const typename GridT::Ptr& inFile, double threshold)
{
    SCOPED_TRACE(whole->type());
    ObjectSettings settings;
    settings.threshold = threshold;
    const int leaves = int(whole->tree().leafCount());
    ASSERT_EQ(leavesInAndOutOfFile(*inFile), std::make_pair(leaves, 0));
    const auto expected = objectOf(*whole, settings), actual = objectOf(*inFile, settings);
    EXPECT_TRUE(actual->tree().hasSameTopology(expected->tree()));
    EXPECT_GT(actual->activeVoxelCount(), 100u);
    EXPECT_EQ(leavesInAndOutOfFile(*inFile), std::make_pair(leaves, 0));
}

} // namespace

TEST_F(LeafValuesTest, AGridWhoseValuesAreInTheFileIsTheSameObjectAndTheyStayThere)
{
    using namespace openvdb;
    const std::vector<uint32_t> compressions = {io::COMPRESS_NONE, io::COMPRESS_ACTIVE_MASK,
        io::COMPRESS_ACTIVE_MASK | io::COMPRESS_ZIP, io::COMPRESS_ACTIVE_MASK | io::COMPRESS_BLOSC};
    for (const uint32_t compression : compressions) {
        const auto check = [&](auto grid, double threshold) {
            using GridT = typename decltype(grid)::element_type;
            expectSameObject<GridT>(grid, delayed<GridT>(grid, compression), threshold);
        };
        check(scattered<FloatGrid>(), 4.5);
        check(scattered<DoubleGrid>(), 4.5);
        check(scattered<Int32Grid>(), 4);
        check(scattered<Int64Grid>(), 4);
        check(tools::createLevelSetSphere<FloatGrid>(20, Vec3f(0), 1), 0);
        check(scatteredPoints(), 0);
    }
}

TEST_F(LeafValuesTest, HalfFloatsAreReadAsTheyWouldBe)
{
    const auto grid = scattered<FloatGrid>();
    grid->setSaveFloatAsHalf(true);
    expectSameObject<FloatGrid>(
        grid, delayed<FloatGrid>(grid, openvdb::io::COMPRESS_ACTIVE_MASK), 4.5);
}

TEST_F(LeafValuesTest, OfALeafInMemoryTheyAreItsOwn)
{
    const auto grid = scattered<FloatGrid>();
    for (auto leaf = grid->tree().cbeginLeaf(); leaf; ++leaf) {
        const detail::LeafValues<FloatGrid::TreeType::LeafNodeType> values(*leaf);
        EXPECT_EQ(values.data(), leaf->buffer().data());
    }
}

TEST_F(LeafValuesTest, DamagedValuesAreAnErrorAndLeaveTheGridAlone)
{
    const auto grid = scattered<FloatGrid>();
    delayed<FloatGrid>(grid, openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_ZIP);
    const auto size = std::streamoff(std::filesystem::file_size(mPath));
    {
        std::fstream file(mPath, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(size - 30); // in the last leaf's values
        file.write("damaged damaged", 15);
    }
    const auto damaged = openDelayed<FloatGrid>();
    EXPECT_THROW(objectOf(*damaged), openvdb::Exception);
    EXPECT_THROW(objectOf(*damaged), openvdb::Exception) << "again: the leaf is as it was";
    EXPECT_EQ(leavesInAndOutOfFile(*damaged).second, 0);
}
