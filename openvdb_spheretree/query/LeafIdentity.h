// SPDX-License-Identifier: Apache-2.0
/// @file LeafIdentity.h
/// @brief A number that tells the leaves of one tree from those of another.

#pragma once

#include <openvdb_spheretree/base/Hash.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <cstdint>
#include <cstring>

namespace openvdb_spheretree::detail {

/// @return the same for the same leaves in the same place, and almost surely another one for others.
inline uint64_t identityOf(const SphereTree& tree, const SphereTreeLevel& leaves, double scale)
{
    uint64_t identity = hash(uint64_t(leaves.size()));
    const auto add = [&](double number) {
        uint64_t bits;
        std::memcpy(&bits, &number, sizeof(bits));
        identity = hash(identity ^ bits);
    };
    for (int32_t id = leaves.begin; id < leaves.end; ++id) {
        const openvdb::Vec3d center = scale * tree.centerWorld(id);
        for (int axis = 0; axis < 3; ++axis) add(center[axis]);
        add(scale * double(tree.spheres.radiusWorld[id]));
    }
    return identity;
}

} // namespace openvdb_spheretree::detail
