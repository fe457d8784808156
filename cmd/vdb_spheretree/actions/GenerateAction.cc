// SPDX-License-Identifier: Apache-2.0
/// @file GenerateAction.cc
/// @brief -generate: an object made by rule, for those who have none at hand.

#include "line/Actions.h"
#include "session/Session.h"

#include <openvdb_spheretree/input/shapes/GeneratedObject.h>

#include <cmath>
#include <limits>

namespace command {

namespace {

using Settings = openvdb_spheretree::GeneratedObjectSettings;

/// 2^63; the greatest double that is an int64_t is below.
constexpr double kInt64End = 9223372036854775808.0;

int64_t voxelsOf(const ActionCall& call)
{
    const double voxels = call.real("voxels"); // not an integer, so that 1e9 is one
    if (voxels != std::floor(voxels) || voxels < -kInt64End || voxels >= kInt64End) {
        throwUsage("voxels=" + call.text("voxels") + " is no whole number below 2^63");
    }
    return int64_t(voxels);
}

Settings settingsOf(const ActionCall& call)
{
    Settings settings;
    settings.shape = openvdb_spheretree::shapeFromString(call.text("shape"));
    settings.voxels = voxelsOf(call);
    settings.seed = uint64_t(call.integer("seed"));
    settings.voxelSize = call.real("voxel");
    return settings;
}

void check(const ActionCall& call, Plan& plan)
{
    settingsOf(call).validate();
    plan.addWorldUnit(/*metres=*/false);
}

void run(const ActionCall& call, Session& session)
{
    StackItem item;
    item.grid = openvdb_spheretree::generateObject(settingsOf(call), &session.progress);
    if (call.given("name")) item.grid->setName(call.text("name"));
    session.stack.beginBatch(call.label());
    session.stack.push(item);
    session.remark(session.stack.items().back()->description());
}

} // namespace

ActionSpec generateAction()
{
    ActionSpec action{"generate", "", "shape",
        "make an object of any size: a curved wall (gyroid), a sponge with holes of every size "
        "(menger), a hilly sheet (terrain), single voxels at random (noise), or a solid ball"};
    action.options = {choice("shape", openvdb_spheretree::shapeNames(), "what it is"),
        real("voxels", "1000000", double(Settings::kFewestVoxels),
            std::numeric_limits<double>::infinity(),
            "how many voxels it has, 1000 or more, within 10%; 1e9 will do for 1000000000"),
        integer("seed", "1", 0, std::numeric_limits<int32_t>::max(),
            "another number is another terrain or noise"),
        real("voxel", "1", Settings::kSmallestVoxel, Settings::kLargestVoxel,
            "size of a voxel in world units"),
        nameOption("", "name of the grid (by default that of the shape)")};
    action.isSource = true;
    action.check = check;
    action.run = run;
    return action;
}

} // namespace command
