// SPDX-License-Identifier: Apache-2.0
/// @file FclBodies.h
/// @brief The same questions to FCL: meshes of the same voxels under OBBRSS trees, its quickest for distances.
/// What it is asked is what it does best: no contacts are made where a verdict is wanted.

#pragma once

#include "QueryBodies.h"

#include <openvdb_spheretree/query/RigidMotion.h>

#include <memory>
#include <vector>

namespace spheretree_benchmark {

class FclBodies {
public:
    FclBodies(const BodyMesh& a, const BodyMesh& b);
    ~FclBodies();

    /// Where b is in the frame of a: poses are turned into FCL's before the clock runs.
    void setPoses(const std::vector<openvdb_spheretree::RigidTransform>& poses);
    void setMotions(const std::vector<openvdb_spheretree::RigidMotion>& motions);

    bool collide(int pose) const;
    std::size_t allContacts(int pose) const;
    /// With the nearest points.
    double distance(int pose) const;
    /// By 100 samples of the screw: contacts between two of them are missed.
    double timeOfContact(int motion) const;

private:
    struct Data;
    std::unique_ptr<Data> mData;
};

} // namespace spheretree_benchmark
