// SPDX-License-Identifier: Apache-2.0
// Spheres as points of NanoVDB: voxels that hold them, positions in voxels, and radii, levels, ids and parents. A voxel is a
// power of two wide, so that float positions are the same before and after, whoever computes with them.

#include "ExportWriters.h"

#include "NanoVdbWriter.h"
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/store/PointLeaves.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree::detail {

namespace {

/// @return a power of two that puts all centers within 2^10 voxels of the origin, or the smallest that OpenVDB
/// takes (its cube is not below 3e-15). PointWriter makes voxels larger where that leaves them empty.
double voxelSizeFor(const std::vector<openvdb::Vec3d>& centers)
{
    constexpr int kLargest = 10, kLeast = -16;
    double largest = 0;
    for (const openvdb::Vec3d& center : centers) {
        for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(center[axis]));
    }
    int exponent = 0; // of the power of two above
    std::frexp(largest, &exponent);
    return largest > 0 ? std::ldexp(1.0, std::max(exponent - kLargest, kLeast)) : 1;
}

struct ScenePoints {
    std::vector<openvdb::Vec3d> centers;
    std::vector<float> radii;
    std::vector<int32_t> levels, ids, parents;
};

ScenePoints pointsOf(const ExportScene& scene)
{
    ScenePoints points;
    for (const ExportLevel& level : scene.levels) {
        points.centers.insert(points.centers.end(), level.centers.begin(), level.centers.end());
        points.radii.insert(points.radii.end(), level.radii.begin(), level.radii.end());
        points.levels.insert(points.levels.end(), level.size(), level.number);
        points.ids.insert(points.ids.end(), level.ids.begin(), level.ids.end());
        points.parents.insert(points.parents.end(), level.parents.begin(), level.parents.end());
    }
    return points;
}

} // namespace

void writeNanoVdbPoints(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    constexpr std::size_t kLongestName = 200;
    const ExportScene& scene = samples.front();
    ScenePoints points = pointsOf(scene);
    const double voxelSize = voxelSizeFor(points.centers);
    for (openvdb::Vec3d& center : points.centers) center /= voxelSize; // exact
    PointWriter writer(points.centers, out.interrupter);
    const auto add = [&](const char* name, const auto& values) {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        writer.addAttribute<Value>(name, [&](uint32_t i) { return values[i]; });
    };
    add("pscale", points.radii);
    add("level", points.levels);
    add("id", points.ids);
    add("parent", points.parents);
    const auto grid = writer.finish(*openvdb::math::Transform::createLinearTransform(voxelSize));
    grid->setName(onOneLine(scene.name, kLongestName));
    writeNanoVdb({grid}, out.stream, out.interrupter);
}

} // namespace openvdb_spheretree::detail
