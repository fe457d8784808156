// SPDX-License-Identifier: Apache-2.0
#include "GivenSpheres.h"

#include "ObjectChoice.h"

#include <openvdb_spheretree/tree/GivenTree.h>

namespace command {

void placeInObject(StackItem& item, Session& session, const std::string& ageOrName)
{
    if (!item.given || (item.object && ageOrName.empty())) return;
    StackItem* const grid =
        ageOrName.empty() ? onlyObjectGrid(session) : &selectObjectGrid(session, ageOrName);
    if (!grid) return;
    const Stopwatch watch;
    const openvdb::BoolGrid::ConstPtr object = objectOf(*grid, {}, session);
    session.seconds.mask += watch.seconds();
    const std::string name = item.tree->settings.name; // -level may have given it another
    try {
        item.tree = std::make_shared<openvdb_spheretree::SphereTree>(
            openvdb_spheretree::givenTree(*item.given, *object));
    } catch (...) {
        rethrowNamed(item.description(), kInput);
    }
    item.tree->settings.name = name;
    item.object = object;
}

} // namespace command
