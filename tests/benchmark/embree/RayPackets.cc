// SPDX-License-Identifier: Apache-2.0
#include "RayPackets.h"

namespace spheretree_benchmark {
namespace {

RTCIntersectContext contextOf(RTCIntersectContextFlags flags)
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags;
    return context;
}

void intersect(const int* valid, RTCScene scene, RTCIntersectContext& context, RTCRayHit8& packet)
{
    rtcIntersect8(valid, scene, &context, &packet);
}

void intersect(const int* valid, RTCScene scene, RTCIntersectContext& context, RTCRayHit16& packet)
{
    rtcIntersect16(valid, scene, &context, &packet);
}

} // namespace

template <typename Packet>
RayPackets<Packet>::RayPackets(const std::vector<FloatRay>& rays)
    : mPackets((rays.size() + kLanes - 1) / kLanes, Lanes{})
{
    for (std::size_t i = 0; i < rays.size(); ++i) {
        auto& [valid, packet] = mPackets[i / kLanes];
        const std::size_t lane = i % kLanes;
        valid[lane] = -1;
        const RTCRay ray = rayOf(rays[i].origin.asPointer(), rays[i].direction.asPointer());
        packet.ray.org_x[lane] = ray.org_x;
        packet.ray.org_y[lane] = ray.org_y;
        packet.ray.org_z[lane] = ray.org_z;
        packet.ray.dir_x[lane] = ray.dir_x;
        packet.ray.dir_y[lane] = ray.dir_y;
        packet.ray.dir_z[lane] = ray.dir_z;
        packet.ray.tfar[lane] = ray.tfar;
        packet.ray.mask[lane] = ray.mask;
        packet.hit.geomID[lane] = packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
}

template <typename Packet>
double RayPackets<Packet>::sumOfHits(const EmbreeScene& scene, RTCIntersectContextFlags flags) const
{
    RTCIntersectContext context = contextOf(flags);
    double sum = 0;
    for (Lanes lanes : mPackets) {
        intersect(lanes.valid.data(), scene.handle(), context, lanes.packet);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            const bool isHit =
                lanes.valid[lane] && lanes.packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
            if (isHit) sum += lanes.packet.ray.tfar[lane];
        }
    }
    return sum;
}

template class RayPackets<RTCRayHit8>;
template class RayPackets<RTCRayHit16>;

RayStream::RayStream(const std::vector<FloatRay>& rays)
{
    for (const FloatRay& ray : rays) {
        RTCRayHit hit = {};
        hit.ray = rayOf(ray.origin.asPointer(), ray.direction.asPointer());
        hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        mRays.push_back(hit);
    }
}

double RayStream::sumOfHits(const EmbreeScene& scene, RTCIntersectContextFlags flags) const
{
    RTCIntersectContext context = contextOf(flags);
    std::vector<RTCRayHit> rays = mRays;
    rtcIntersect1M(scene.handle(), &context, rays.data(), unsigned(rays.size()), sizeof(RTCRayHit));
    double sum = 0;
    for (const RTCRayHit& hit : rays) {
        if (hit.hit.geomID != RTC_INVALID_GEOMETRY_ID) sum += hit.ray.tfar;
    }
    return sum;
}

} // namespace spheretree_benchmark
