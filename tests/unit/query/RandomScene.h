// SPDX-License-Identifier: Apache-2.0
/// @file RandomScene.h
/// @brief A scene of bodies at random places.

#pragma once

#include "QuerySamples.h"

#include <openvdb_spheretree/query/QueryScene.h>

#include <gtest/gtest.h>

#include <vector>

namespace spheretree_test {

using openvdb::Vec3d;
using openvdb_spheretree::CollisionRequest;
using openvdb_spheretree::CollisionResult;
using openvdb_spheretree::Contact;
using openvdb_spheretree::QueryScene;
using openvdb_spheretree::QueryTree;
using openvdb_spheretree::RigidTransform;

/// Bodies of the samples thrown into a box, and all that naive loops need.
struct RandomScene {
    QueryScene scene;
    std::vector<const QuerySample*> samples;

    RandomScene(Random& random, int count, const Vec3d& box)
    {
        static const std::vector<QueryTree> trees = [] {
            std::vector<QueryTree> made;
            for (const QuerySample& sample : querySamples()) {
                made.push_back(makeQueryTree(sample.tree, Exactness::LeafUnion));
            }
            return made;
        }();
        for (int i = 0; i < count; ++i) {
            const auto which = std::size_t(uniform(random, 0, double(trees.size()) - 1e-9));
            samples.push_back(&querySamples()[which]);
            EXPECT_EQ(scene.add(trees[which]), i);
        }
        shake(random, box);
    }

    void shake(Random& random, const Vec3d& box)
    {
        for (int i = 0; i < scene.size(); ++i) {
            const Vec3d place(uniform(random, -box[0], box[0]), uniform(random, -box[1], box[1]),
                uniform(random, -box[2], box[2]));
            const auto toOrigin = RigidTransform::fromTranslation(-scene.tree(i).center());
            scene.setPose(
                i, RigidTransform::fromTranslation(place) * randomRotation(random) * toOrigin);
        }
    }

    /// The question to two bodies by themselves.
    CollisionResult alone(int a, int b, const CollisionRequest& request,
        std::vector<Contact>* contacts = nullptr) const
    {
        return collide(
            scene.tree(a), scene.pose(a), scene.tree(b), scene.pose(b), request, contacts);
    }

    double smallestGap(int a, int b) const
    {
        return spheretree_test::smallestGap(leafBalls(samples[std::size_t(a)]->tree, scene.pose(a)),
            leafBalls(samples[std::size_t(b)]->tree, scene.pose(b)));
    }
};

} // namespace spheretree_test
