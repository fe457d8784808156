// SPDX-License-Identifier: Apache-2.0
#include "DenseField.h"

#include <openvdb_spheretree/query/PointQuery.h>

#include <cmath>

namespace spheretree_benchmark {

using openvdb::Vec3d;

DenseField::DenseField(
    const openvdb_spheretree::QueryTree& tree, const Vec3d& low, const Vec3d& high, double voxel)
    : mLow(low), mPerWorld(float(1 / voxel))
{
    std::size_t count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        mSize[axis] = std::size_t(std::ceil((high[axis] - low[axis]) / voxel)) + 2;
        count *= mSize[axis];
    }
    if (count > kMostValues) return;
    mValues.reserve(count);
    for (std::size_t x = 0; x < mSize[0]; ++x) {
        for (std::size_t y = 0; y < mSize[1]; ++y) {
            for (std::size_t z = 0; z < mSize[2]; ++z) {
                const Vec3d place = Vec3d(mLow) + voxel * Vec3d(double(x), double(y), double(z));
                mValues.push_back(float(nearest(tree, place).distance));
            }
        }
    }
}

} // namespace spheretree_benchmark
