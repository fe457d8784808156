// SPDX-License-Identifier: Apache-2.0
#include "StoredRadii.h"

#include <openvdb_spheretree/base/LargeArray.h>
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Rounding.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/Exceptions.h>

#include <cmath>
#include <utility>

namespace openvdb_spheretree::detail {

float toStoredRadius(double radius)
{
    const float stored = toFloatUp(radius);
    if (std::isfinite(stored)) return stored;
    OPENVDB_THROW(openvdb::ValueError,
        "a radius of " << radius
                       << " world units does not fit a float: use another unit of length, or less "
                          "padding");
}

void storeRadii(SphereTree& tree, openvdb::util::NullInterrupter* interrupter)
{
    const double padding = tree.settings.paddingVoxels();
    const double voxel = largestStretch(*tree.transform);
    for (Spheres* spheres : {&tree.spheres, &tree.cuts.spheres}) {
        std::vector<float> stored;
        resizeLarge(stored, spheres->radius.size());
        parallelFor(stored.size(), interrupter, [&](std::size_t i) {
            const double padded = addUp(spheres->radius[i], padding);
            stored[i] = toStoredRadius(multiplyUp(padded, voxel));
        });
        spheres->radiusWorld = std::move(stored);
    }
}

} // namespace openvdb_spheretree::detail
