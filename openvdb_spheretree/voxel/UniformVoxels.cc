// SPDX-License-Identifier: Apache-2.0
#include "UniformVoxels.h"

#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>
#include <openvdb/Grid.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {

namespace {

/// Moves the surface of the largest ball allowed by 1/20 of a voxel.
constexpr double kTolerance = 1e-6;

/// What the voxel's three edges become in world space.
struct VoxelEdges {
    explicit VoxelEdges(const openvdb::math::Transform& transform)
    {
        const openvdb::math::MapBase::ConstPtr map = transform.baseMap();
        edge[0] = map->applyJacobian({1, 0, 0});
        edge[1] = map->applyJacobian({0, 1, 0});
        edge[2] = map->applyJacobian({0, 0, 1});
        for (int i = 0; i < 3; ++i) length[i] = edge[i].length();
    }
    bool areEquallyLong() const { return longest() - shortest() <= kTolerance * length[0]; }
    bool areOrthogonal() const { return skew() <= kTolerance; }
    double longest() const { return *std::max_element(length, length + 3); }
    double shortest() const { return *std::min_element(length, length + 3); }
    /// The largest cosine of the angle between two edges.
    double skew() const
    {
        double largest = 0;
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            largest = std::max(largest, std::abs(edge[i].dot(edge[j])) / (length[i] * length[j]));
        }
        return largest;
    }

    openvdb::Vec3d edge[3];
    double length[3];
};

/// Numbers that are no distances may be labels.
bool holdsNumbers(const openvdb::GridBase& grid)
{
    const std::string type = grid.valueType();
    const bool arePoints = type.rfind("ptdataidx", 0) == 0;
    return grid.getGridClass() != openvdb::GRID_LEVEL_SET && type != "bool" && type != "mask"
        && !arePoints;
}

} // namespace

void requireUniformVoxels(const openvdb::GridBase& grid)
{
    const openvdb::math::Transform& transform = grid.transform();
    if (!transform.isLinear()) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid)
                << " has a frustum transform, so "
                   "its voxels are not of one size: give it a linear one in the program that "
                   "made it");
    }
    const VoxelEdges voxel(transform);
    const double* length = voxel.length;
    const openvdb::Vec3d offset = transform.baseMap()->applyMap({0, 0, 0});
    if (!offset.isFinite() || !openvdb::Vec3d(length).isFinite() || !(length[0] > 0)) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid)
                << " has a transform with a zero, "
                   "an infinity or a NaN in it: set its transform, or resample it to cubic voxels");
    }
    constexpr double kFarthest = 0x1p53; // voxels; farther away doubles are more than a voxel apart
    const double far = std::max({std::abs(offset[0]), std::abs(offset[1]), std::abs(offset[2])});
    if (far > kFarthest * length[0]) {
        OPENVDB_THROW(openvdb::ValueError,
            detail::describe(grid)
                << " lies " << far << " away from the world's origin, too far for voxels of "
                << length[0] << ", which have no places of their own there: move it nearer");
    }
    if (voxel.areEquallyLong() && voxel.areOrthogonal()) return;
    OPENVDB_THROW(openvdb::ValueError,
        detail::describe(grid)
            << " has voxels of " << length[0] << " x " << length[1] << " x " << length[2]
            << (voxel.areOrthogonal() ? "" : ", and its axes are sheared")
            << "; spheres need cubic voxels: resample it to a uniform voxel size (-resample voxel="
            << voxel.shortest() << (holdsNumbers(grid) ? ", for labels with nearest=1)" : ")"));
}

bool hasCubicVoxels(const openvdb::math::Transform& transform)
{
    const VoxelEdges voxel(transform);
    return transform.isLinear() && voxel.areEquallyLong() && voxel.areOrthogonal();
}

std::string detail::describe(const openvdb::GridBase& grid)
{
    const std::string name = grid.getName();
    return name.empty() ? "the grid without a name" : "grid " + detail::inQuotes(name, 80);
}

double voxelSizeOf(const openvdb::math::Transform& transform)
{
    if (!transform.isLinear()) return transform.voxelSize()[0];
    return transform.baseMap()->applyJacobian({1, 0, 0}).length();
}

double largestStretch(const openvdb::math::Transform& transform)
{
    const VoxelEdges voxel(transform);
    // |J v|^2 = sum of length^2 v_i^2 + 2 edge_i.edge_j v_i v_j <= longest^2 (1 + 2 skew) |v|^2.
    const double skew = voxel.skew();
    return skew < 1e-15 ? voxel.longest() : voxel.longest() * (1 + skew + 1e-15);
}

double smallestStretch(const openvdb::math::Transform& transform)
{
    const VoxelEdges voxel(transform);
    // As above, |J v|^2 >= shortest^2 (1 - 2 skew) |v|^2 but for 1e-6 of the skew, and the root of
    // 1 - 2 skew is about 1 - skew.
    const double skew = voxel.skew();
    return skew < 1e-15 ? voxel.shortest() : voxel.shortest() * (1 - 2 * skew - 1e-15);
}

} // namespace openvdb_spheretree
