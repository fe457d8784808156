// SPDX-License-Identifier: Apache-2.0
/// @file PointsFiles.h
/// @brief Grids of points through files and into bytes, and with one value of one node changed.

#pragma once

#include <openvdb/points/AttributeArray.h>
#include <openvdb/points/PointDataGrid.h>

#include <cstdint>
#include <string>
#include <vector>

namespace spheretree_test {

using openvdb::points::PointDataGrid;

/// Writes the grids to a file as people do, and reads them back.
std::vector<PointDataGrid::Ptr> throughFile(const openvdb::GridCPtrVec& grids);

/// The grid as bytes, without the random number that every file starts with.
std::string bytesOf(const PointDataGrid::Ptr& grid);

/// Removes the checksum, as version 0.1 wrote none.
void removeChecksum(PointDataGrid& grid);

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
