// SPDX-License-Identifier: Apache-2.0
#include "ChosenObjects.h"

namespace spheretree_test {

std::vector<RandomObject> objectsOfAtMost(
    std::size_t voxels, uint32_t first, uint32_t last, std::size_t least)
{
    return chosenObjects(first, last, least,
        [&](uint32_t, const RandomObject& object) { return object.voxels.size() <= voxels; });
}

std::vector<RandomObject> objectsNoWiderThan(
    int diagonal, uint32_t first, uint32_t last, std::size_t least)
{
    return chosenObjects(first, last, least, [&](uint32_t, const RandomObject& object) {
        return boxOf(object.voxels).extents().asVec3i().lengthSqr() <= diagonal * diagonal;
    });
}

} // namespace spheretree_test
