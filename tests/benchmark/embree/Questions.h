// SPDX-License-Identifier: Apache-2.0
/// @file Questions.h
/// @brief What is asked of one tree: rays, points and robots, the same in every run.

#pragma once

#include "EmbreeScenes.h"

#include <openvdb_spheretree/query/QueryTree.h>
#include <openvdb_spheretree/query/RayQuery.h>

#include <openvdb/math/BBox.h>
#include <openvdb/math/Vec3.h>

#include <random>
#include <vector>

namespace spheretree_benchmark {

constexpr int kQuestions = 20000, kRobots = 500, kSpheres = 64;

/// With numbers that floats have, which Embree takes.
struct FloatRay {
    openvdb::Vec3s origin, direction;
    openvdb_spheretree::QueryRay query() const
    {
        return {openvdb::Vec3d(origin), openvdb::Vec3d(direction)};
    }
};

class Questions {
public:
    explicit Questions(const openvdb_spheretree::QueryTree& tree);

    /// From all around, each aimed at a random place of the tree's box.
    std::vector<FloatRay> raysFromAround();
    /// From one place through a grid.
    std::vector<FloatRay> raysOfCamera() const;
    /// The same by squares of 4 x 4, as packets want them; what is left over at two sides is left out.
    std::vector<FloatRay> raysOfCameraInTiles() const;
    /// In the box made 1.3 times as large.
    std::vector<openvdb::Vec3s> pointsInBox();
    /// @param mesh   of the surface
    /// @param voxel  points are some three voxels off
    std::vector<openvdb::Vec3s> pointsNearSurface(const TriangleList& mesh, double voxel);
    /// kRobots times kSpheres spheres of 2 to 6 voxels along a walk, as flat floats.
    std::vector<float> robots(double voxel);

private:
    double unit();
    openvdb::Vec3d normal();
    openvdb::Vec3d placeIn(double times);

    openvdb::math::BBox<openvdb::Vec3d> mBox;
    double mRadius;
    std::mt19937 mRandom{5};
};

} // namespace spheretree_benchmark
