// SPDX-License-Identifier: Apache-2.0
#include "BoundedErrors.h"

#include <openvdb_spheretree/tree/StoredRadii.h>

namespace openvdb_spheretree::tight {

BoundedError errorOf(const TightLevel& level, SphereTree tree, const detail::LevelMeter& meter,
    openvdb::util::NullInterrupter* interrupter)
{
    appendLevels({level}, tree);
    SphereTreeLevel& only = tree.levels.front();
    const SphereBudget& budget = tree.settings.tight().budget;
    if (budget.bounds == BoundOf::Unpadded) {
        meter.measureExact(tree, only, interrupter);
        if (!only.error) return {0, 0, only.errorUnknown};
        return {only.error->hammingPercent, only.error->hausdorff * tree.voxelSize(), ""};
    }
    detail::storeRadii(tree, interrupter);
    meter.measureStored(
        tree, only, {budget.error.has_value(), budget.distance.has_value()}, interrupter);
    if (!only.stored) return {0, 0, only.storedUnknown};
    return {only.stored->hammingPercent, only.stored->reachWorld, ""};
}

bool keepsBounds(const TightLevel& level, const SphereTree& tree, const openvdb::BoolGrid& object,
    openvdb::util::NullInterrupter* interrupter)
{
    const SphereBudget& budget = tree.settings.tight().budget;
    if (!budget.hasBound()) return true;
    const detail::LevelMeter meter(object, tree.settings.dist());
    const TightLevel alone{level.balls, {}, level.digital};
    return isWithin(budget, tree.voxelSize(), errorOf(alone, tree, meter, interrupter));
}

} // namespace openvdb_spheretree::tight
