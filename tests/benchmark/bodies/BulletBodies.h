// SPDX-License-Identifier: Apache-2.0
/// @file BulletBodies.h
/// @brief All pairs of leaf spheres by Bullet: a compound of them for each body, with its trees of boxes.

#pragma once

#include <openvdb_spheretree/query/QueryTree.h>
#include <openvdb_spheretree/query/RigidTransform.h>

#include <cstddef>
#include <memory>

namespace spheretree_benchmark {

class BulletBodies {
public:
    BulletBodies(const openvdb_spheretree::QueryTree& a, const openvdb_spheretree::QueryTree& b);
    ~BulletBodies();

    /// @return how many pairs of spheres meet where b is in the frame of a.
    std::size_t pairs(const openvdb_spheretree::RigidTransform& pose) const;

private:
    struct Data;
    std::unique_ptr<Data> mData;
};

} // namespace spheretree_benchmark
