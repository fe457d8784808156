// SPDX-License-Identifier: Apache-2.0
#include "LevelErrors.h"

#include "LevelMeter.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>

#include <string>
#include <utility>

namespace openvdb_spheretree {

void computeLevelErrors(
    SphereTree& tree, const openvdb::BoolGrid& object, openvdb::util::NullInterrupter* interrupter)
{
    const detail::LevelMeter meter(object, tree.settings.dist());
    std::vector<SphereTreeLevel> levels = tree.levels; // the tree changes at the end, or not at all
    for (SphereTreeLevel& level : levels) {
        detail::checkInterrupt(interrupter);
        const std::string name = "errors of level " + std::to_string(level.level);
        const detail::Stage stage(name.c_str(), interrupter, nullptr);
        meter.measure(tree, level, interrupter);
    }
    tree.levels = std::move(levels);
}

} // namespace openvdb_spheretree
