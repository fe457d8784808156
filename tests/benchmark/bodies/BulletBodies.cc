// SPDX-License-Identifier: Apache-2.0
#include "BulletBodies.h"

#include <btBulletCollisionCommon.h>

#include <vector>

namespace spheretree_benchmark {
namespace {

using openvdb::Vec3d;
using openvdb_spheretree::QueryTree;
using openvdb_spheretree::RigidTransform;

struct Counter : btCollisionWorld::ContactResultCallback {
    std::size_t pairs = 0;
    btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
        const btCollisionObjectWrapper*, int, int) override
    {
        pairs += point.getDistance() <= 0;
        return 0;
    }
};

/// A body's leaf spheres about its center, for Bullet's floats.
struct Compound {
    std::vector<std::unique_ptr<btSphereShape>> spheres;
    btCompoundShape shape;
    btCollisionObject object;
    Vec3d center;

    explicit Compound(const QueryTree& tree) : center(tree.center())
    {
        for (int32_t leaf = 0; leaf < tree.leafCount(); ++leaf) {
            const Vec3d at = tree.leafCenter(leaf) - center;
            spheres.push_back(std::make_unique<btSphereShape>(btScalar(tree.leafRadius(leaf))));
            shape.addChildShape(btTransform(btQuaternion::getIdentity(),
                                    btVector3(btScalar(at[0]), btScalar(at[1]), btScalar(at[2]))),
                spheres.back().get());
        }
        object.setCollisionShape(&shape);
    }
};

} // namespace

struct BulletBodies::Data {
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btCollisionWorld world{&dispatcher, &broadphase, &configuration};
    Compound a, b;

    Data(const QueryTree& treeA, const QueryTree& treeB) : a(treeA), b(treeB) {}
};

BulletBodies::BulletBodies(const QueryTree& a, const QueryTree& b) : mData(new Data(a, b)) {}
BulletBodies::~BulletBodies() = default;

std::size_t BulletBodies::pairs(const RigidTransform& pose) const
{
    const auto& m = pose.rotation();
    const Vec3d at = pose * mData->b.center - mData->a.center;
    btMatrix3x3 rotation;
    for (int i = 0; i < 3; ++i)
        rotation[i].setValue(btScalar(m(i, 0)), btScalar(m(i, 1)), btScalar(m(i, 2)));
    mData->a.object.setWorldTransform(btTransform::getIdentity());
    mData->b.object.setWorldTransform(
        btTransform(rotation, btVector3(btScalar(at[0]), btScalar(at[1]), btScalar(at[2]))));
    Counter counter;
    mData->world.contactPairTest(&mData->a.object, &mData->b.object, counter);
    return counter.pairs;
}

} // namespace spheretree_benchmark
