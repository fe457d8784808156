// SPDX-License-Identifier: Apache-2.0
#include "StoredSphere.h"

#include <openvdb_spheretree/tight/fit/FineSphere.h>

#include <openvdb/Exceptions.h>

#include <cmath>

namespace openvdb_spheretree::nearest {

namespace {

/// @return the squared radius in the middle of those that hold the same voxels.
int64_t middleSq(const ExactSphere& sphere)
{
    constexpr int64_t kApart = 32;
    int64_t rest = 0; // of |c|^2 modulo 32: that of its parts below 16
    for (const int64_t c : sphere.center) rest += (c & 15) * (c & 15);
    rest %= kApart;
    int64_t below = (sphere.radiusSq - rest) / kApart; // rounded down
    if (sphere.radiusSq < rest) below = -1;
    return rest + kApart * below + kApart / 2;
}

} // namespace

StoredSphere storedSphere(const ExactSphere& sphere, double voxelSize)
{
    const double unit = double(tight::kFine);
    const double radius = std::sqrt(double(std::max<int64_t>(middleSq(sphere), 0))) / unit;
    StoredSphere stored{sphere, float(radius * voxelSize), 0};
    if (!std::isnormal(stored.radiusWorld)) {
        OPENVDB_THROW(openvdb::ValueError,
            "a radius of " << radius << " voxels of " << voxelSize
                           << " does not fit a float: use another unit of length");
    }
    stored.radius = double(stored.radiusWorld) / voxelSize;
    constexpr double kRounding = 1 + 1e-12; // as of storedRadiusVoxels(), which reads it back
    const double reach = unit * (stored.radius * kRounding);
    stored.sphere.radiusSq = int64_t(reach * reach);
    return stored;
}

} // namespace openvdb_spheretree::nearest
