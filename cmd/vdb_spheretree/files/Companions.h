// SPDX-License-Identifier: Apache-2.0
/// @file Companions.h
/// @brief The grids that travel with a sphere-tree: edges of its DAG, and cuts.

#pragma once

#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <map>
#include <string>
#include <vector>

namespace command {

/// Null where there is none.
struct Companions {
    openvdb::points::PointDataGrid::Ptr dag, cuts;
};

/// Finds the companions of any tree of a file, of which there may be thousands.
class CompanionIndex {
public:
    explicit CompanionIndex(const openvdb::GridPtrVec& grids);

    /// @return the first of each kind that claims to belong to a tree of that name.
    Companions of(const std::string& tree) const;

private:
    std::map<std::string, std::vector<openvdb::points::PointDataGrid::Ptr>> mByName;
};

} // namespace command
