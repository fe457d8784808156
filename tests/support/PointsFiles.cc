// SPDX-License-Identifier: Apache-2.0
#include "PointsFiles.h"

#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <filesystem>
#include <sstream>

namespace spheretree_test {

namespace {

/// @return a path that no other test has.
std::string testFile()
{
    const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    return (std::filesystem::temp_directory_path() / ("spheretree_" + name + ".vdb")).string();
}

} // namespace

std::vector<PointDataGrid::Ptr> throughFile(const openvdb::GridCPtrVec& grids)
{
    openvdb::initialize();
    const std::string path = testFile();
    openvdb::io::File out(path);
    out.setCompression(openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
    out.write(grids);
    out.close();

    std::vector<PointDataGrid::Ptr> read;
    openvdb::io::File in(path);
    in.open(/*delayLoad=*/false);
    const openvdb::GridPtrVec stored = *in.getGrids();
    for (const openvdb::GridBase::Ptr& grid : stored) {
        read.push_back(openvdb::gridPtrCast<PointDataGrid>(grid));
    }
    in.close();
    std::filesystem::remove(path);
    return read;
}

std::string bytesOf(const PointDataGrid::Ptr& grid)
{
    std::ostringstream out(std::ios::binary);
    openvdb::io::Stream stream(out);
    stream.write(openvdb::GridCPtrVec{grid});
    constexpr std::size_t kUuidBegin = 21, kUuidSize = 36;
    return out.str().erase(kUuidBegin, kUuidSize);
}

void removeChecksum(PointDataGrid& grid)
{
    grid.removeMeta("spheretree_checksum");
    grid.removeMeta("spheretree_checksum_transform");
}

} // namespace spheretree_test
