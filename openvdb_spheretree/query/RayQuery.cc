// SPDX-License-Identifier: Apache-2.0
#include "RayQuery.h"

#include "QueryData.h"
#include "RayFrame.h"
#include "RayKernel.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/TextStream.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace openvdb_spheretree {
namespace {

using detail::BlockHit;
using detail::LocalRay;
using openvdb::Vec3d;

constexpr std::size_t kSingle = std::size_t(-1); ///< in place of the number of a ray among many

/// @param which  the ray's number
[[noreturn]] void refuse(const QueryRay& ray, std::size_t which, const std::string& why)
{
    detail::TextStream text;
    if (which == kSingle) text << "the ray";
    else text << "ray " << which;
    text << " from " << ray.origin << " along " << ray.direction << ' ' << why;
    OPENVDB_THROW(openvdb::ValueError, text.str());
}

/// A ray whose numbers are in order, along a direction of length 1.
struct SoundRay {
    SoundRay(const detail::QueryData& tree, const QueryRay& ray, std::size_t which)
    {
        constexpr double kShortest = 1e-150, kLongest = 1e150; // squares are doubles
        length = ray.direction.length();
        if (!(length >= kShortest && length <= kLongest)) {
            refuse(ray, which, "points nowhere: its direction must be finite, and not of length 0");
        }
        const double farthest = LocalRay::kFarthestStart * tree.spheres.extent;
        if (!((ray.origin - tree.origin).lengthSqr() <= farthest * farthest)) {
            refuse(ray, which,
                "starts too far from the tree to hit it by doubles: its origin must be finite, and "
                "nearer");
        }
        if (!std::isfinite(ray.tNear) || std::isnan(ray.tFar)) {
            refuse(ray, which,
                "is asked from tNear to tFar of which one is NaN, or the first infinite");
        }
        direction = ray.direction * (1 / length);
    }

    Vec3d direction;
    double length;
};

/// Rays that go to the kernel together, and what becomes of its answers.
class Packet {
public:
    static constexpr std::size_t kMost = 32;

    Packet(const detail::QueryData& tree, bool anyHit) : mTree(tree), mAnyHit(anyHit) {}

    /// Fills in @a hits of @a count rays.
    void run(const QueryRay* rays, std::size_t count, std::size_t first, RayHit* hits)
    {
        mSize = 0;
        for (std::size_t i = 0; i < count; ++i)
            add(rays[i], i, first == kSingle ? kSingle : first + i);
        BlockHit found[kMost];
        detail::firstLeaves(mTree.spheres, mQuestions, mSize, found);
        std::fill(hits, hits + count, RayHit());
        for (std::size_t k = 0; k < mSize; ++k) {
            const Place& place = mPlaces[k];
            RayHit& hit = hits[place.ray];
            hit.blocks = found[k].blocks;
            hit.leaf = found[k].leaf;
            if (hit.leaf < 0) continue;
            const double slack = mQuestions[k].slack;
            hit.t = std::max(rays[place.ray].tNear,
                (place.shift + (double(found[k].key) - slack)) / place.length);
            hit.t = std::min(hit.t, rays[place.ray].tFar);
        }
    }

private:
    struct Place {
        std::size_t ray;
        double shift, length;
    };

    void add(const QueryRay& ray, std::size_t place, std::size_t which)
    {
        const SoundRay sound(mTree, ray, which);
        const LocalRay local(
            mTree, ray.origin, sound.direction, ray.tNear * sound.length, ray.tFar * sound.length);
        if (local.misses) return;
        mQuestions[mSize] = local.question;
        mQuestions[mSize].leavesStart = ray.leavesStart;
        mQuestions[mSize].anyHit = mAnyHit;
        mPlaces[mSize++] = {place, local.shift, sound.length};
    }

    const detail::QueryData& mTree;
    bool mAnyHit;
    std::size_t mSize = 0;
    detail::RayQuestion mQuestions[kMost];
    Place mPlaces[kMost];
};

/// Calls store(i, hit) for all rays, packet by packet.
template <typename Store>
void forEachHit(const QueryTree& tree, const QueryRay* rays, std::size_t count, bool anyHit,
    openvdb::util::NullInterrupter* interrupter, const Store& store)
{
    const std::size_t packets = (count + Packet::kMost - 1) / Packet::kMost;
    detail::parallelFor(packets, interrupter, [&](std::size_t p) {
        const std::size_t first = p * Packet::kMost, size = std::min(Packet::kMost, count - first);
        RayHit hits[Packet::kMost];
        Packet(tree.data(), anyHit).run(rays + first, size, first, hits);
        for (std::size_t i = 0; i < size; ++i) store(first + i, hits[i]);
    });
}

} // namespace

RayHit intersect(const QueryTree& tree, const QueryRay& ray)
{
    RayHit hit;
    Packet(tree.data(), /*anyHit=*/false).run(&ray, 1, kSingle, &hit);
    return hit;
}

bool occluded(const QueryTree& tree, const QueryRay& ray)
{
    RayHit hit;
    Packet(tree.data(), /*anyHit=*/true).run(&ray, 1, kSingle, &hit);
    return bool(hit);
}

void intersect(const QueryTree& tree, const QueryRay* rays, std::size_t count, RayHit* hits,
    openvdb::util::NullInterrupter* interrupter)
{
    forEachHit(tree, rays, count, false, interrupter,
        [&](std::size_t i, const RayHit& hit) { hits[i] = hit; });
}

void occluded(const QueryTree& tree, const QueryRay* rays, std::size_t count, uint8_t* blocked,
    openvdb::util::NullInterrupter* interrupter)
{
    forEachHit(tree, rays, count, true, interrupter,
        [&](std::size_t i, const RayHit& hit) { blocked[i] = bool(hit); });
}

} // namespace openvdb_spheretree
