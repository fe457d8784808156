// SPDX-License-Identifier: Apache-2.0
#include "MassProperties.h"

#include "PrincipalAxes.h"
#include "VoxelMoments.h"
#include <openvdb_spheretree/tree/LevelSpheres.h>

#include <openvdb/Exceptions.h>
#include <openvdb/Grid.h>
#include <openvdb/math/Transform.h>

#include <array>
#include <cmath>
#include <vector>

namespace openvdb_spheretree {
namespace {

using detail::VoxelMoments;
using openvdb::Mat3d;
using openvdb::Vec3d;
using Integer = VoxelMoments::Integer;

/// @return the integer nearest to a / b, for b > 0.
Integer nearestQuotient(Integer a, Integer b)
{
    const Integer doubled = 2 * a + b;
    const Integer quotient = doubled / (2 * b);
    return doubled % (2 * b) < 0 ? quotient - 1 : quotient;
}

/// Steps 1 and 2: a body in index space.
struct IndexBody {
    double voxels;
    Vec3d center;
    Mat3d spread; ///< integral of (p - center)(p - center)^T
};

IndexBody bodyOf(const VoxelMoments& moments)
{
    const Integer count = moments.count;
    std::array<Integer, 3> middle, back;
    for (int a = 0; a < 3; ++a) {
        middle[a] = nearestQuotient(moments.first[a], count);
        back[a] = -middle[a];
    }
    const VoxelMoments near = moments.movedBy(back); // first moments: half the count at most
    IndexBody body;
    body.voxels = double(count);
    for (int a = 0; a < 3; ++a) {
        body.center[a] = double(middle[a]) + double(near.first[a]) / body.voxels;
        for (int b = a; b < 3; ++b) {
            const Integer products = near.first[a] * near.first[b];
            const Integer whole = near.second[VoxelMoments::product(a, b)] - products / count;
            const double sum = double(whole) - double(products % count) / body.voxels;
            body.spread(a, b) = body.spread(b, a) = sum + (a == b ? body.voxels / 12 : 0);
        }
    }
    return body;
}

/// @return the matrix whose columns are the steps along the axes of index space, in world space.
Mat3d stepsOf(const openvdb::math::Transform& transform)
{
    if (!transform.isLinear()) {
        OPENVDB_THROW(openvdb::ValueError,
            "mass properties need a linear transform, and this one is a frustum: resample the "
            "grid");
    }
    Mat3d steps;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d step(0);
        step[axis] = 1;
        steps.setCol(axis, transform.baseMap()->applyJacobian(step));
    }
    return steps;
}

/// Steps 3 and 4.
std::optional<MassProperties> propertiesOf(
    const VoxelMoments& moments, const openvdb::math::Transform& transform)
{
    const Mat3d steps = stepsOf(transform);
    if (moments.count == 0) return std::nullopt;
    const IndexBody body = bodyOf(moments);
    const double voxelVolume = std::abs(steps.det());
    const Mat3d spread = voxelVolume * (steps * body.spread * steps.transpose());
    MassProperties result;
    result.volume = voxelVolume * body.voxels;
    result.center = transform.indexToWorld(body.center);
    for (int a = 0; a < 3; ++a) {
        for (int b = a + 1; b < 3; ++b) {
            const double both = spread(a, b) + spread(b, a);
            result.inertia(a, b) = result.inertia(b, a) = 0 - 0.5 * both; // never -0
        }
        result.inertia(a, a) = spread((a + 1) % 3, (a + 1) % 3) + spread((a + 2) % 3, (a + 2) % 3);
    }
    const detail::PrincipalAxes principal = detail::principalAxes(result.inertia);
    result.principalMoments = principal.moments;
    result.principalAxes = principal.axes;
    return result;
}

} // namespace

std::optional<MassProperties> massProperties(
    const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter)
{
    return propertiesOf(detail::momentsOf(object.tree(), interrupter), object.transform());
}

std::optional<MassProperties> massProperties(const openvdb::MaskTree& voxels,
    const openvdb::math::Transform& transform, openvdb::util::NullInterrupter* interrupter)
{
    return propertiesOf(detail::momentsOf(voxels, interrupter), transform);
}

std::optional<MassProperties> massProperties(const SphereTree& tree, const SphereTreeLevel& level,
    openvdb::util::NullInterrupter* interrupter)
{
    const std::vector<ExactSphere> spheres = storedSpheres(tree, level);
    const openvdb::CoordBBox box = levelBox(tree, spheres);
    if (box.empty()) return std::nullopt;
    if (crossedRows(spheres, box, metricOf(tree)) > double(kMaxUnionRows)) {
        OPENVDB_THROW(openvdb::ValueError,
            "the spheres of level " << level.level << " cross more than the " << kMaxUnionRows
                                    << " rows of voxels that are counted: choose a finer level");
    }
    const auto voxels = sphereUnion(spheres, box, metricOf(tree), interrupter);
    return massProperties(*voxels, *tree.transform, interrupter);
}

} // namespace openvdb_spheretree
