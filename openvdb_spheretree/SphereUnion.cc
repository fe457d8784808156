// SPDX-License-Identifier: Apache-2.0
/// @file SphereUnion.cc
/// @brief The public face of the rasteriser, and the spheres of a level.

#include "SphereUnion.h"

#include "detail/ExactBall.h"
#include "detail/SphereRaster.h"

#include <cmath>
#include <limits>

namespace openvdb_spheretree {

openvdb::MaskTree::Ptr sphereUnion(const std::vector<ExactSphere>& spheres,
    const openvdb::CoordBBox& clip, openvdb::util::NullInterrupter* interrupter,
    const Distance& distance)
{
    return detail::rasterSpheres(spheres, distance, clip, nullptr, interrupter);
}

std::vector<ExactSphere> levelSpheres(const SphereTree& tree, const SphereTreeLevel& level)
{
    std::vector<ExactSphere> spheres;
    spheres.reserve(level.size());
    for (int32_t id = level.begin; id < level.end; ++id) {
        const openvdb::Vec3d& c = tree.center[id]; // multiples of 1/2: twice them is exact
        spheres.push_back({{std::llround(2 * c[0]), std::llround(2 * c[1]), std::llround(2 * c[2])},
            tree.coverSq[id]});
    }
    return spheres;
}

openvdb::CoordBBox boundingBox(const std::vector<ExactSphere>& spheres, const Distance& distance)
{
    constexpr int64_t kFirst = std::numeric_limits<int32_t>::min() + 1;
    constexpr int64_t kLast = std::numeric_limits<int32_t>::max() - 1;
    openvdb::CoordBBox box;
    for (const ExactSphere& sphere : spheres) {
        openvdb::Coord lo, hi;
        bool empty = false;
        for (int a = 0; a < 3; ++a) {
            const detail::Interval range = detail::extent(sphere, a, distance);
            empty = empty || range.lo > range.hi;
            lo[a] = int32_t(std::max(kFirst, std::min(range.lo, kLast)));
            hi[a] = int32_t(std::max(kFirst, std::min(range.hi, kLast)));
        }
        if (!empty) box.expand(openvdb::CoordBBox(lo, hi));
    }
    return box;
}

openvdb::CoordBBox levelBox(const SphereTree& tree, const std::vector<ExactSphere>& spheres)
{
    openvdb::CoordBBox box = boundingBox(spheres, tree.settings.dist);
    const int flat = tree.settings.flatAxis;
    if (tree.settings.dim == 2) box.min()[flat] = box.max()[flat] = tree.object.bbox.min()[flat];
    return box;
}

double crossedRows(const std::vector<ExactSphere>& spheres, const openvdb::CoordBBox& box,
    const Distance& distance)
{
    if (box.empty()) return 0;
    double discs = 0; // of a norm: squares, at least as large
    const double area =
        distance.isEuclidean() ? M_PI / 4 : 1.0 / (distance.unit() * distance.unit());
    for (const ExactSphere& s : spheres) discs += s.coverSq < 0 ? 0 : area * double(s.coverSq);
    const auto side = [&box](int a) { return double(box.max()[a]) - box.min()[a] + 1; };
    return std::min(discs, side(0) * side(1));
}

openvdb::MaskTree::Ptr levelUnion(const SphereTree& tree, const SphereTreeLevel& level,
    openvdb::util::NullInterrupter* interrupter)
{
    const std::vector<ExactSphere> spheres = levelSpheres(tree, level);
    const openvdb::CoordBBox box = levelBox(tree, spheres);
    if (crossedRows(spheres, box, tree.settings.dist) > double(kMaxUnionRows)) {
        OPENVDB_THROW(openvdb::ValueError,
            "the spheres of level " << level.level << " reach over " << box.extents()
                                    << " voxels, more than are drawn: choose a finer level");
    }
    return sphereUnion(spheres, box, interrupter, tree.settings.dist);
}

} // namespace openvdb_spheretree
