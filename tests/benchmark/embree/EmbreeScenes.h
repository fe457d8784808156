// SPDX-License-Identifier: Apache-2.0
/// @file EmbreeScenes.h
/// @brief The leaf spheres of a tree, and a mesh of its object, as scenes of Embree.

#pragma once

#include <openvdb_spheretree/query/QueryTree.h>
#include <openvdb_spheretree/tree/SphereTree.h>

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace spheretree_benchmark {

/// A sphere as Embree reads it.
struct SceneBall {
    float x, y, z, r;
};

struct TriangleList {
    std::vector<std::array<float, 3>> points;
    std::vector<std::array<uint32_t, 3>> triangles;
};

/// The voxels of level 0 as triangles, where the share of solid is one half (OpenVDB's
/// volumeToMesh).
TriangleList meshOfObject(const openvdb_spheretree::SphereTree& tree);

std::vector<SceneBall> leafBalls(const openvdb_spheretree::QueryTree& tree);

/// From an origin along a direction, without end.
RTCRay rayOf(const float* origin, const float* direction);

/// An Embree scene of one geometry, committed at the highest build quality.
class EmbreeScene {
public:
    static EmbreeScene ofSpheres(const std::vector<SceneBall>& balls);
    static EmbreeScene ofMesh(const TriangleList& mesh);
    /// User geometry, for rtcPointQuery(): there is none for spheres.
    /// @param balls  live as long as the scene
    static EmbreeScene forPoints(const std::vector<SceneBall>& balls);

    /// @return where a ray enters, infinity if it misses.
    float intersect(const float* origin, const float* direction) const;
    bool occluded(const float* origin, const float* direction) const;
    /// @return the distance to the nearest ball, up to @a cutoff; of a scene made forPoints().
    float distance(const float* point, float cutoff) const;

    /// For questions of many at once; it lives as long as the scene.
    RTCScene handle() const { return mScene.get(); }

private:
    explicit EmbreeScene(RTCGeometry geometry);

    std::shared_ptr<RTCSceneTy> mScene;
    const std::vector<SceneBall>* mBalls = nullptr;
};

} // namespace spheretree_benchmark
