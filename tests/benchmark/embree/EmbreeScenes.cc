// SPDX-License-Identifier: Apache-2.0
#include "EmbreeScenes.h"

#include <openvdb_spheretree/tree/LevelSpheres.h>

#include <openvdb/openvdb.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace spheretree_benchmark {

using namespace openvdb_spheretree;

namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

RTCDevice device()
{
    static const RTCDevice one = rtcNewDevice("threads=1");
    return one;
}

template <typename T>
void setBuffer(
    RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<T>& values)
{
    void* const buffer =
        rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size());
    std::memcpy(buffer, values.data(), values.size() * sizeof(T));
}

/// What a point query has found so far.
struct NearestBall {
    const std::vector<SceneBall>* balls;
    float distance;
};

void boundsOfBall(const RTCBoundsFunctionArguments* arguments)
{
    const auto& balls = *static_cast<const std::vector<SceneBall>*>(arguments->geometryUserPtr);
    const SceneBall& ball = balls[arguments->primID];
    RTCBounds& box = *arguments->bounds_o;
    box.lower_x = ball.x - ball.r, box.upper_x = ball.x + ball.r;
    box.lower_y = ball.y - ball.r, box.upper_y = ball.y + ball.r;
    box.lower_z = ball.z - ball.r, box.upper_z = ball.z + ball.r;
}

/// Shrinks the query to the distance found, which cannot be below 0: Embree then knows of no depth.
bool lookAtBall(RTCPointQueryFunctionArguments* arguments)
{
    auto& found = *static_cast<NearestBall*>(arguments->userPtr);
    const SceneBall& ball = (*found.balls)[arguments->primID];
    const RTCPointQuery& at = *arguments->query;
    const float dx = ball.x - at.x, dy = ball.y - at.y, dz = ball.z - at.z;
    const float distance = std::sqrt(dx * dx + dy * dy + dz * dz) - ball.r;
    if (!(distance < found.distance)) return false;
    found.distance = distance;
    if (!(distance < at.radius)) return false;
    arguments->query->radius = std::max(distance, 0.0f);
    return true;
}

} // namespace

RTCRay rayOf(const float* o, const float* d)
{
    RTCRay ray = {};
    ray.org_x = o[0], ray.org_y = o[1], ray.org_z = o[2];
    ray.dir_x = d[0], ray.dir_y = d[1], ray.dir_z = d[2];
    ray.tfar = kInfinity;
    ray.mask = ~0u;
    return ray;
}

TriangleList meshOfObject(const SphereTree& tree)
{
    const openvdb::MaskTree::Ptr voxels = levelUnion(tree, tree.level(0));
    const openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(0.0f);
    for (auto it = voxels->cbeginValueOn(); it; ++it) {
        openvdb::CoordBBox box;
        it.getBoundingBox(box);
        grid->fill(box, 1.0f);
    }
    grid->setTransform(tree.transform);
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    std::vector<openvdb::Vec4I> quads;
    openvdb::tools::volumeToMesh(*grid, points, triangles, quads, 0.5);
    TriangleList mesh;
    for (const auto& p : points) mesh.points.push_back({p[0], p[1], p[2]});
    for (const auto& t : triangles) mesh.triangles.push_back({t[0], t[1], t[2]});
    for (const auto& q : quads) {
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
    }
    return mesh;
}

std::vector<SceneBall> leafBalls(const QueryTree& tree)
{
    std::vector<SceneBall> balls;
    for (int32_t i = 0; i < tree.leafCount(); ++i) {
        const openvdb::Vec3s c(tree.leafCenter(i));
        balls.push_back({c[0], c[1], c[2], float(tree.leafRadius(i))});
    }
    return balls;
}

EmbreeScene::EmbreeScene(RTCGeometry geometry) : mScene(rtcNewScene(device()), rtcReleaseScene)
{
    rtcSetSceneBuildQuality(mScene.get(), RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(mScene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(mScene.get());
}

EmbreeScene EmbreeScene::ofSpheres(const std::vector<SceneBall>& balls)
{
    const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
    setBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, balls);
    return EmbreeScene(geometry);
}

EmbreeScene EmbreeScene::ofMesh(const TriangleList& mesh)
{
    const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    setBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.points);
    setBuffer(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
    return EmbreeScene(geometry);
}

EmbreeScene EmbreeScene::forPoints(const std::vector<SceneBall>& balls)
{
    const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(balls.size()));
    rtcSetGeometryUserData(geometry, const_cast<std::vector<SceneBall>*>(&balls)); // read alone
    rtcSetGeometryBoundsFunction(geometry, boundsOfBall, nullptr);
    rtcSetGeometryPointQueryFunction(geometry, lookAtBall);
    EmbreeScene scene(geometry);
    scene.mBalls = &balls;
    return scene;
}

float EmbreeScene::intersect(const float* origin, const float* direction) const
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit hit;
    hit.ray = rayOf(origin, direction);
    hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(mScene.get(), &context, &hit);
    return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? kInfinity : hit.ray.tfar;
}

bool EmbreeScene::occluded(const float* origin, const float* direction) const
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = rayOf(origin, direction);
    rtcOccluded1(mScene.get(), &context, &ray);
    return ray.tfar < 0;
}

float EmbreeScene::distance(const float* point, float cutoff) const
{
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    RTCPointQuery query = {};
    query.x = point[0], query.y = point[1], query.z = point[2];
    query.radius = cutoff;
    NearestBall nearest{mBalls, cutoff};
    rtcPointQuery(mScene.get(), &query, &context, nullptr, &nearest);
    return nearest.distance;
}

} // namespace spheretree_benchmark
