// SPDX-License-Identifier: Apache-2.0
/// @file BodyQueries.cc
/// @brief Questions to two bodies, beside FCL on meshes of the same voxels.

#include "QueryBodies.h"
#include "QueryTimes.h"

#include <openvdb_spheretree/query/BodyDistance.h>
#include <openvdb_spheretree/query/Collide.h>

#include <fcl/fcl.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace spheretree_benchmark {
namespace {

using namespace openvdb_spheretree;
using FclMesh = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<FclMesh> fclMesh(const BodyMesh& mesh)
{
    auto model = std::make_shared<FclMesh>();
    std::vector<fcl::Vector3d> points;
    std::vector<fcl::Triangle> triangles;
    for (const auto& p : mesh.points) points.emplace_back(p[0], p[1], p[2]);
    for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
    model->beginModel();
    model->addSubModel(points, triangles);
    model->endModel();
    return model;
}

fcl::Transform3d fclPose(const RigidTransform& pose)
{
    fcl::Transform3d result = fcl::Transform3d::Identity();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) result.linear()(i, j) = pose.rotation()(i, j);
        result.translation()[i] = pose.translation()[i];
    }
    return result;
}

volatile double sink;

void run(
    const std::string& fileA, const std::string& fileB, Quality quality, bool withFcl, int rounds)
{
    const QueryBody a = queryBody(fileA, quality), b = queryBody(fileB, quality);
    for (const QueryBody* body : {&a, &b}) {
        std::printf("%s: %d leaves, %zu triangles, %.1f bytes a leaf, %.1f of the plain tree\n",
            body->name.c_str(), body->query.leafCount(), body->mesh.triangles.size(),
            double(body->query.bytes()) / body->query.leafCount(),
            double(body->plain.bytes()) / body->plain.leafCount());
    }
    const auto meshA = withFcl ? fclMesh(a.mesh) : nullptr,
               meshB = withFcl ? fclMesh(b.mesh) : nullptr;
    const fcl::Transform3d identity = fcl::Transform3d::Identity();
    constexpr int kPoses = 250;
    for (int s = 0; s < 4; ++s) {
        const auto poses = posesOf(a, b, Stratum(s), kPoses);
        std::vector<fcl::Transform3d> fclPoses;
        for (const auto& pose : poses) fclPoses.push_back(fclPose(pose));
        double blocks[2][3] = {};
        DistanceRequest isSigned;
        isSigned.enableSignedDistance = true;
        for (const auto& pose : poses) {
            int of = 0;
            for (const auto tree : {&QueryBody::query, &QueryBody::plain}) {
                blocks[of][0] += double(collide(a.*tree, {}, b.*tree, pose).blocks) / kPoses;
                blocks[of][1] += double(distance(a.*tree, {}, b.*tree, pose).blocks) / kPoses;
                blocks[of++][2] +=
                    double(distance(a.*tree, {}, b.*tree, pose, isSigned).blocks) / kPoses;
            }
        }
        std::printf(
            "%s: blocks: collide %.1f (plain %.1f), distance %.1f (%.1f), signed %.1f (%.1f)\n",
            kStrata[s], blocks[0][0], blocks[1][0], blocks[0][1], blocks[1][1], blocks[0][2],
            blocks[1][2]);
        std::vector<Contender> overlap = {
            {"ours", [&](int i) { sink = double(collide(a.query, {}, b.query, poses[i]).blocks); }},
            {"plain",
                [&](int i) { sink = double(collide(a.plain, {}, b.plain, poses[i]).blocks); }}};
        std::vector<Contender> distances = {
            {"ours", [&](int i) { sink = distance(a.query, {}, b.query, poses[i]).distance; }},
            {"plain", [&](int i) { sink = distance(a.plain, {}, b.plain, poses[i]).distance; }}};
        if (withFcl) {
            overlap.push_back({"FCL", [&](int i) {
                                   fcl::CollisionRequestd request;
                                   fcl::CollisionResultd result;
                                   sink = double(fcl::collide(meshA.get(), identity, meshB.get(),
                                       fclPoses[i], request, result));
                               }});
            distances.push_back({"FCL",
                [&](int i) {
                    fcl::DistanceRequestd request(true);
                    fcl::DistanceResultd result;
                    sink = fcl::distance(
                        meshA.get(), identity, meshB.get(), fclPoses[i], request, result);
                },
                10});
        }
        printTimes(
            std::string("collide, ") + kStrata[s], overlap, timesOf(overlap, kPoses, rounds));
        printTimes(
            std::string("distance, ") + kStrata[s], distances, timesOf(distances, kPoses, rounds));
    }
}

} // namespace
} // namespace spheretree_benchmark

int main(int argc, char** argv)
{
    using namespace spheretree_benchmark;
    const std::string data = std::getenv("SPHERETREE_DATA");
    const std::string size = argc > 1 ? argv[1] : "128";
    const bool withFcl = argc > 2 && std::string(argv[2]) == "fcl";
    const auto quality = argc > 3 && std::string(argv[3]) == "normal"
        ? openvdb_spheretree::Quality::Normal
        : openvdb_spheretree::Quality::Fast;
    run(data + "/vol/dragon-" + size + ".vol",
        data + "/vol/" + (argc > 4 ? argv[4] : "dragon") + "-" + size + ".vol", quality, withFcl,
        5);
}
