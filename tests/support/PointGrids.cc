// SPDX-License-Identifier: Apache-2.0
#include "PointGrids.h"

#include <openvdb/openvdb.h>
#include <openvdb/points/PointConversion.h>

namespace spheretree_test {

using openvdb::Vec3d;
using openvdb::math::Transform;
using openvdb::points::PointDataGrid;

namespace {

template <typename Codec>
PointDataGrid::Ptr storedBy(const std::vector<Vec3d>& places, double voxelSize)
{
    openvdb::initialize();
    return openvdb::points::createPointDataGrid<Codec, PointDataGrid>(
        places, *Transform::createLinearTransform(voxelSize));
}

} // namespace

PointDataGrid::Ptr pointsAt(const std::vector<Vec3d>& places, double voxelSize)
{
    return storedBy<openvdb::points::NullCodec>(places, voxelSize);
}

PointDataGrid::Ptr packedPointsAt(const std::vector<Vec3d>& places, double voxelSize)
{
    return storedBy<openvdb::points::FixedPointCodec<false>>(places, voxelSize);
}

openvdb::tools::PointIndexGrid::Ptr pointIndicesOf(
    const std::vector<Vec3d>& places, double voxelSize)
{
    return openvdb::tools::createPointIndexGrid<openvdb::tools::PointIndexGrid>(
        openvdb::points::PointAttributeVector<Vec3d>(places),
        *Transform::createLinearTransform(voxelSize));
}

} // namespace spheretree_test
