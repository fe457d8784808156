// SPDX-License-Identifier: Apache-2.0
#include "CountErrors.h"

#include "GivenSpheres.h"
#include "ObjectChoice.h"

#include <algorithm>

namespace command {

bool lacksErrors(const openvdb_spheretree::SphereTree& tree)
{
    const auto lacks = [](const openvdb_spheretree::SphereTreeLevel& level) {
        if (!level.error) return level.errorUnknown.empty();
        return !level.stored && level.storedUnknown.empty();
    };
    return std::any_of(tree.levels.begin(), tree.levels.end(), lacks);
}

void findObject(StackItem& item, Session& session)
{
    if (item.object) return;
    StackItem* grid = nullptr;
    for (const auto& other : session.stack.items()) {
        if (!other->grid || !openvdb_spheretree::isObjectGrid(*other->grid)) continue;
        if (grid) return;
        grid = other.get();
    }
    if (grid) item.object = objectOfTree(*grid, *item.tree, session);
}

void countErrors(StackItem& item, Session& session)
{
    placeInObject(item, session);
    if (!lacksErrors(*item.tree)) return;
    findObject(item, session);
    if (item.object) computeErrors(item, session);
}

} // namespace command
