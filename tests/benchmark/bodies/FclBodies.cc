// SPDX-License-Identifier: Apache-2.0
#include "FclBodies.h"

#include <fcl/fcl.h>

namespace spheretree_benchmark {
namespace {

using openvdb_spheretree::RigidMotion;
using openvdb_spheretree::RigidTransform;
using Model = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<Model> modelOf(const BodyMesh& mesh)
{
    auto model = std::make_shared<Model>();
    std::vector<fcl::Vector3d> points;
    std::vector<fcl::Triangle> triangles;
    for (const auto& p : mesh.points) points.emplace_back(p[0], p[1], p[2]);
    for (const auto& t : mesh.triangles) {
        triangles.emplace_back(std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2]));
    }
    model->beginModel();
    model->addSubModel(points, triangles);
    model->endModel();
    return model;
}

fcl::Transform3d transformOf(const RigidTransform& pose)
{
    fcl::Transform3d result = fcl::Transform3d::Identity();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) result.linear()(i, j) = pose.rotation()(i, j);
        result.translation()[i] = pose.translation()[i];
    }
    return result;
}

} // namespace

struct FclBodies::Data {
    std::shared_ptr<Model> a, b;
    fcl::Transform3d here = fcl::Transform3d::Identity();
    std::vector<fcl::Transform3d> poses, starts, ends;
};

FclBodies::FclBodies(const BodyMesh& a, const BodyMesh& b) : mData(new Data)
{
    mData->a = modelOf(a);
    mData->b = modelOf(b);
}

FclBodies::~FclBodies() = default;

void FclBodies::setPoses(const std::vector<RigidTransform>& poses)
{
    mData->poses.clear();
    for (const RigidTransform& pose : poses) mData->poses.push_back(transformOf(pose));
}

void FclBodies::setMotions(const std::vector<RigidMotion>& motions)
{
    mData->starts.clear();
    mData->ends.clear();
    for (const RigidMotion& motion : motions) {
        mData->starts.push_back(transformOf(motion.at(0)));
        mData->ends.push_back(transformOf(motion.at(1)));
    }
}

bool FclBodies::collide(int pose) const
{
    const fcl::CollisionRequestd request;
    fcl::CollisionResultd result;
    fcl::collide(mData->a.get(), mData->here, mData->b.get(), mData->poses[std::size_t(pose)],
        request, result);
    return result.isCollision();
}

std::size_t FclBodies::allContacts(int pose) const
{
    const fcl::CollisionRequestd request(std::size_t(1) << 40);
    fcl::CollisionResultd result;
    fcl::collide(mData->a.get(), mData->here, mData->b.get(), mData->poses[std::size_t(pose)],
        request, result);
    return result.numContacts();
}

double FclBodies::distance(int pose) const
{
    const fcl::DistanceRequestd request(true);
    fcl::DistanceResultd result;
    return fcl::distance(mData->a.get(), mData->here, mData->b.get(),
        mData->poses[std::size_t(pose)], request, result);
}

double FclBodies::timeOfContact(int motion) const
{
    fcl::ContinuousCollisionRequestd request;
    request.num_max_iterations = 100;
    request.ccd_motion_type = fcl::CCDM_SCREW;
    request.ccd_solver_type = fcl::CCDC_NAIVE;
    fcl::ContinuousCollisionResultd result;
    const std::size_t i = std::size_t(motion);
    return fcl::continuousCollide(mData->a.get(), mData->here, mData->here, mData->b.get(),
        mData->starts[i], mData->ends[i], request, result);
}

} // namespace spheretree_benchmark
