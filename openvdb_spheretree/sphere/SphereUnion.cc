// SPDX-License-Identifier: Apache-2.0
#include "SphereUnion.h"

#include "ClippedSphere.h"
#include "SphereRaster.h"
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/math/Math.h>

#include <algorithm>
#include <limits>

namespace openvdb_spheretree {

openvdb::MaskTree::Ptr sphereUnion(const std::vector<ExactSphere>& spheres,
    const openvdb::CoordBBox& clip, const SphereMetric& metric,
    openvdb::util::NullInterrupter* interrupter)
{
    return detail::rasterSpheres(spheres, metric, clip, nullptr, interrupter);
}

openvdb::CoordBBox boundingBox(const std::vector<ExactSphere>& spheres, const SphereMetric& metric)
{
    const int shift = detail::shiftOf(metric);
    constexpr int64_t kFirst = std::numeric_limits<int32_t>::min() + 1;
    constexpr int64_t kLast = std::numeric_limits<int32_t>::max() - 1;
    openvdb::CoordBBox box;
    for (const ExactSphere& sphere : spheres) {
        openvdb::Coord lo, hi;
        bool empty = false;
        for (int a = 0; a < 3; ++a) {
            const detail::Interval range = detail::extent(sphere, a, metric.distance, shift);
            empty = empty || range.lo > range.hi;
            lo[a] = int32_t(std::max(kFirst, std::min(range.lo, kLast)));
            hi[a] = int32_t(std::max(kFirst, std::min(range.hi, kLast)));
        }
        if (!empty) box.expand(openvdb::CoordBBox(lo, hi));
    }
    return box;
}

double crossedRows(const std::vector<ExactSphere>& spheres, const openvdb::CoordBBox& box,
    const SphereMetric& metric)
{
    if (box.empty()) return 0;
    double discs = 0; // of a norm: squares, at least as large
    const double unit = double(metric.subdivision) * metric.distance.unit();
    const double area =
        (metric.distance.isEuclidean() ? openvdb::math::pi<double>() : 4) / (unit * unit);
    for (const ExactSphere& s : spheres) discs += s.radiusSq < 0 ? 0 : area * double(s.radiusSq);
    const auto side = [&box](int a) { return double(box.max()[a]) - box.min()[a] + 1; };
    return std::min(discs, side(0) * side(1));
}

} // namespace openvdb_spheretree
