// SPDX-License-Identifier: Apache-2.0
#include "DigitalLeaves.h"

#include "LeafIdentity.h"
#include "PointFrame.h"
#include "PointKernel.h"
#include "QueryData.h"

#include <openvdb/Exceptions.h>
#include <openvdb/math/Transform.h>

#include <cmath>
#include <limits>
#include <string>

namespace openvdb_spheretree {
namespace {

using openvdb::Coord;
using openvdb::Vec3d;

[[noreturn]] void refuse(const std::string& why)
{
    OPENVDB_THROW(
        openvdb::ValueError, "the leaves of this tree are not the voxels of its object: " << why);
}

/// Level 0 of medial balls records as many voxels as the object has (TightLevels.cc,
/// TreeLevels.cc).
void requireObject(const SphereTree& tree, const QueryTreeSettings& settings)
{
    tree.validate();
    if (settings.level > 0 || !tree.hasLevel(0))
        refuse("they are of a coarser level. Take the finest one");
    if (tree.settings.isInner() || tree.settings.isFit()) {
        refuse("its spheres do not cover the object. Build it with side=outer");
    }
    if (tree.settings.isGiven()) refuse("its spheres were given, and have no object");
    if (!tree.settings.dist().isEuclidean()) refuse("its balls are those of a norm");
    if (tree.level(0).pyramidVoxels == 0 || tree.level(0).pyramidVoxels != tree.object.voxels) {
        refuse(
            "level 0 is not made of medial balls. Build it without spheres=, error= and distance=");
    }
}

} // namespace

DigitalLeaves::DigitalLeaves(const SphereTree& tree, const QueryTreeSettings& settings)
    : mTransform(tree.transform), mScale(settings.scale)
{
    requireObject(tree, settings);
    const SphereTreeLevel& leaves = tree.level(0);
    mIdentity = detail::identityOf(tree, leaves, settings.scale);
    mBalls.reserve(std::size_t(leaves.size()));
    for (int32_t id = leaves.begin; id < leaves.end; ++id) {
        if (tree.radiusSq[id] <= 0) refuse("a sphere of level 0 is no ball of voxels");
        mBalls.push_back(
            {tree.ijk[id], tree.radiusSq[id]}); // voxels of level 0 are those of the grid
    }
    if (tree.settings.dim == 2) mFlatAxis = tree.flatAxis;
}

Coord DigitalLeaves::voxelOf(const Vec3d& point) const
{
    if (!point.isFinite()) {
        OPENVDB_THROW(openvdb::ValueError,
            "no voxel can be found of the point " << point << ": its coordinates must be finite");
    }
    constexpr double kLowest = std::numeric_limits<int32_t>::min(),
                     kHighest = std::numeric_limits<int32_t>::max();
    const Vec3d index = mTransform->worldToIndex(point / mScale);
    Coord voxel;
    for (int axis = 0; axis < 3; ++axis) { // those beyond all voxels stay beyond them
        const double below =
            std::floor(index[axis]); // the difference to it is exact, a sum with 0.5 is not
        const double nearest = index[axis] - below < 0.5 ? below : below + 1;
        voxel[axis] = int32_t(std::min(std::max(nearest, kLowest), kHighest));
    }
    return voxel;
}

Vec3d DigitalLeaves::center(const Coord& voxel) const
{
    return mScale * mTransform->indexToWorld(voxel);
}

bool DigitalLeaves::isInPlane(const Coord& voxel) const
{
    return mFlatAxis < 0 || voxel[mFlatAxis] == mBalls.front().center[mFlatAxis];
}

bool contains(const QueryTree& tree, const DigitalLeaves& leaves, const Vec3d& point)
{
    const detail::QueryData& data = tree.data();
    if (leaves.identity() != data.identity) {
        OPENVDB_THROW(openvdb::ValueError,
            "these digital leaves are not those of the tree of queries: make both of the same "
            "sphere-tree, with the same settings");
    }
    const Coord voxel = leaves.voxelOf(point);
    if (!leaves.isInPlane(voxel)) return false;
    const detail::LocalPoint local(data, leaves.center(voxel));
    const detail::FloatSphere ball{local.x, local.y, local.z, local.limit(0)};
    return detail::isInDigitalBall(data.spheres, ball, leaves.balls().data(), voxel);
}

} // namespace openvdb_spheretree
