// SPDX-License-Identifier: Apache-2.0
#include "RayQuery.h"

#include "QueryData.h"
#include "RayFrame.h"
#include "RayKernel.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/TextStream.h>

#include <openvdb/Exceptions.h>

#include <cmath>
#include <string>

namespace openvdb_spheretree {
namespace {

using detail::LocalRay;

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

void requireSound(const detail::QueryData& tree, const QueryRay& ray, std::size_t which)
{
    const double farthest = LocalRay::kFarthestStart * tree.spheres.extent;
    const double lengthSq = ray.direction.lengthSqr();
    if (!(lengthSq >= LocalRay::kLeastSq && lengthSq <= LocalRay::kMostSq)) {
        const openvdb::Vec3d& direction = ray.direction;
        const double largest = LocalRay::largestOf(direction);
        if (!direction.isFinite() || largest == 0)
            refuse(ray, which, "points nowhere: its direction must be finite, and not of length 0");
        if (!std::isfinite(4 * farthest / largest)) {
            refuse(ray, which,
                "has so short a direction that t, which counts by its length, is beyond doubles: "
                "give a longer one");
        }
    }
    if (!((ray.origin - tree.origin).lengthSqr() <= farthest * farthest)) {
        refuse(ray, which,
            "starts too far from the tree to hit it by doubles: its origin must be finite, and "
            "nearer");
    }
    if (!std::isfinite(ray.tNear) || std::isnan(ray.tFar)) {
        refuse(
            ray, which, "is asked from tNear to tFar of which one is NaN, or the first infinite");
    }
}

/// @param ray  sound
RayHit hitOfSound(const detail::QueryData& tree, const QueryRay& ray, bool anyHit)
{
    RayHit hit;
    LocalRay local(tree, ray);
    if (local.misses) return hit;
    local.question.anyHit = anyHit;
    const detail::BlockHit found = detail::firstLeaf(tree.spheres, local.question);
    hit.blocks = found.blocks;
    hit.leaf = found.leaf;
    if (found.leaf >= 0) hit.t = local.entry(found.key, ray);
    return hit;
}

/// Calls store(i, hit) for all rays.
template <typename Store>
void forEachHit(const QueryTree& tree, const QueryRay* rays, std::size_t count, bool anyHit,
    openvdb::util::NullInterrupter* interrupter, const Store& store)
{
    const detail::QueryData& data = tree.data();
    detail::parallelFor(count, interrupter, [&](std::size_t i) {
        requireSound(data, rays[i], i);
        store(i, hitOfSound(data, rays[i], anyHit));
    });
}

} // namespace

RayHit intersect(const QueryTree& tree, const QueryRay& ray)
{
    requireSound(tree.data(), ray, kSingle);
    return hitOfSound(tree.data(), ray, /*anyHit=*/false);
}

bool occluded(const QueryTree& tree, const QueryRay& ray)
{
    requireSound(tree.data(), ray, kSingle);
    return bool(hitOfSound(tree.data(), ray, /*anyHit=*/true));
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
