// SPDX-License-Identifier: Apache-2.0
/// @file DenseTopology.h
/// @brief Betti numbers by definition, on dense arrays: floods of object and background, and every
/// cell of every cube counted once. Shares no code with the library.

#pragma once

#include "NaiveReference.h"

#include <openvdb_spheretree/topology/LevelTopology.h>

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <vector>

namespace openvdb_spheretree {

std::ostream& operator<<(std::ostream& out, const LevelTopology& t);

} // namespace openvdb_spheretree

namespace spheretree_test {

class DenseTopology {
public:
    /// @param voxels  not empty
    explicit DenseTopology(const Voxels& voxels);

    /// In space, voxels connected by corners and background by faces.
    openvdb_spheretree::LevelTopology numbers() const;

    /// In the plane @a axis points away from, of voxels one voxel thick along it: squares connected
    /// by corners and background by edges, holes counted as such.
    openvdb_spheretree::LevelTopology numbersInPlane(int axis) const;

private:
    std::size_t index(const Coord& v) const;

    /// The number of components of voxels that are @a on, connected where up to @a steps of their
    /// coordinates differ by one.
    int64_t count(char on, int steps) const;

    /// Cells by their doubled centres: a cell extends along the axes where its voxel's centre lies.
    int64_t eulerNumber() const;

    CoordBBox mBox;
    std::vector<char> mOn;
    int mFlat = -1; ///< the axis that takes no part
};

} // namespace spheretree_test
