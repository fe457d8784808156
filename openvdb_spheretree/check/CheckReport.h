// SPDX-License-Identifier: Apache-2.0
/// @file CheckReport.h
/// @brief What the checks of a sphere-tree share: what is checked, and the faults found.

#pragma once

#include "TreeCheck.h"
#include <openvdb_spheretree/sphere/SphereUnion.h>
#include <openvdb_spheretree/tree/SphereTree.h>
#include <openvdb_spheretree/tree/TreeShape.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

struct CheckReport {
    const SphereTree& tree;
    const openvdb::BoolGrid& object;
    const openvdb::MaskTree& mask; ///< the object's topology
    openvdb::CoordBBox box;        ///< of its voxels
    openvdb::util::NullInterrupter* interrupter;
    FaultKind kind = FaultKind::Shape; ///< of what is found: each check begins by setting it
    std::vector<TreeFault> faults = {};

    template <typename... Parts>
    void fail(const Parts&... parts)
    {
        faults.push_back({kind, sentence(parts...)});
    }
};

/// @return "3 voxels (first: [1, 2, 3])".
inline std::string voxelsText(int64_t voxels, const openvdb::Coord& first)
{
    return sentence(voxels, voxels == 1 ? " voxel" : " voxels", " (first: ", first, ')');
}

/// @return the stored spheres of a level without their padding: what is left must hold voxel
///         centers.
std::vector<ExactSphere> unpaddedSpheres(const SphereTree& tree, const SphereTreeLevel& level);

/// @return whether each sphere is at least as large as its counterpart.
bool noneSmaller(const std::vector<ExactSphere>& spheres, const std::vector<ExactSphere>& than);

/// The topology that a level records, if any, is that of its voxels.
void checkTopologyOf(
    CheckReport& check, const SphereTreeLevel& level, const openvdb::MaskTree& voxels);

/// Level 0's digital balls are the object; those of other levels have the recorded volume. A level
/// whose spheres are no digital balls records no volume.
void checkDigitalBalls(CheckReport& check);

/// No level misses a voxel of the object, in exact radii nor in stored ones.
void checkCoverage(CheckReport& check);

/// Spheres that were read cover the object.
void checkGivenCoverage(CheckReport& check);

/// Every voxel of the object has a chain of nodes, one a level, each the child of the one above,
/// that all hold it, in exact radii and in stored ones. So no level misses a voxel. Parents must be
/// in order.
/// @return whether every voxel has one
bool checkChains(CheckReport& check);

/// The same for chains from the leaves of the cuts up to the cuts of 1, 2, 4, ... and all spheres.
/// cutsDamage() must find nothing.
void checkCutChains(CheckReport& check);

/// No sphere of a level or a cut holds a voxel that the object has not.
void checkInside(CheckReport& check);

} // namespace openvdb_spheretree::detail
