// SPDX-License-Identifier: Apache-2.0
/// @file PointsFiles.h
/// @brief Grids of points through files and into bytes, and with one value of one node changed.

#pragma once

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/points/AttributeArray.h>
#include <openvdb/points/PointDataGrid.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace spheretree_test {

using openvdb::points::PointDataGrid;

/// @return a path that no other test has.
inline std::string testFile()
{
    const std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    return (std::filesystem::temp_directory_path() / ("spheretree_" + name + ".vdb")).string();
}

/// Writes the grids to a file as people do, and reads them back.
inline std::vector<PointDataGrid::Ptr> throughFile(const openvdb::GridCPtrVec& grids)
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

/// The grid as bytes, without the random number that every file starts with.
inline std::string bytesOf(const PointDataGrid::Ptr& grid)
{
    std::ostringstream out(std::ios::binary);
    openvdb::io::Stream stream(out);
    stream.write(openvdb::GridCPtrVec{grid});
    constexpr std::size_t kUuidBegin = 21, kUuidSize = 36;
    return out.str().erase(kUuidBegin, kUuidSize);
}

/// Sets an attribute of the node with that id.
template <typename T>
void damage(PointDataGrid& grid, const char* attribute, int32_t id, const T& value)
{
    for (auto leaf = grid.tree().beginLeaf(); leaf; ++leaf) {
        const openvdb::points::AttributeHandle<int32_t> ids(leaf->constAttributeArray("id"));
        std::vector<openvdb::Index> found;
        for (openvdb::Index n = 0; n < ids.size(); ++n) {
            if (ids.get(n) == id) found.push_back(n);
        }
        openvdb::points::AttributeWriteHandle<T> handle(leaf->attributeArray(attribute));
        for (openvdb::Index n : found) handle.set(n, value);
    }
}

} // namespace spheretree_test
