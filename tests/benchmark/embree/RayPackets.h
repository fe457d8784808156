// SPDX-License-Identifier: Apache-2.0
/// @file RayPackets.h
/// @brief Many rays as Embree takes them at once: packets of 8 or 16, or a stream of single rays. All are laid out before the
/// clock runs; what runs is a copy of them, since hits are written over rays, and the question.

#pragma once

#include "Questions.h"

#include <embree3/rtcore.h>

#include <array>
#include <cstddef>
#include <vector>

namespace spheretree_benchmark {

/// Of RTCRayHit8 and RTCRayHit16.
template <typename Packet>
class RayPackets {
public:
    explicit RayPackets(const std::vector<FloatRay>& rays);

    /// @param flags  what Embree is told of the rays: coherent or not
    /// @return the sum of where the rays enter; a miss adds nothing.
    double sumOfHits(const EmbreeScene& scene, RTCIntersectContextFlags flags) const;

private:
    static constexpr std::size_t kLanes = sizeof(Packet::ray.org_x) / sizeof(float);
    struct Lanes {
        alignas(64) std::array<int, kLanes> valid; ///< -1, or 0 of lanes without a ray
        Packet packet;
    };
    std::vector<Lanes> mPackets;
};

/// Of rtcIntersect1M().
class RayStream {
public:
    explicit RayStream(const std::vector<FloatRay>& rays);

    double sumOfHits(const EmbreeScene& scene, RTCIntersectContextFlags flags) const;

private:
    std::vector<RTCRayHit> mRays;
};

} // namespace spheretree_benchmark
