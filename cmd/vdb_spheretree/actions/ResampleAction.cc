// SPDX-License-Identifier: Apache-2.0
/// @file ResampleAction.cc
/// @brief -resample: grids whose voxels are no cubes, or of the wrong size.

#include "line/Actions.h"
#include "ObjectChoice.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/input/Resample.h>
#include <openvdb_spheretree/voxel/BoxSides.h>

#include <algorithm>

namespace command {

namespace spheretree = openvdb_spheretree;

namespace {

/// Of volumes in micrometres a voxel of metres is none.
void warnOfSize(const StackItem& item, double voxel, Session& session)
{
    using openvdb_spheretree::detail::shortNumber;
    const auto side = openvdb_spheretree::detail::sidesOf(item.grid->evalActiveVoxelBoundingBox());
    double across = 0; // of an empty grid
    for (std::size_t axis = 0; axis < 3; ++axis) {
        across = std::max(across, double(side[axis]) * item.grid->voxelSize()[int(axis)]);
    }
    if (across == 0 || across >= voxel) return;
    session.warn("-resample voxel=" + shortNumber(voxel) + " is larger than all of "
        + item.description() + ", which is " + shortNumber(across)
        + " across: is it in another unit (voxel=0.1mm)?");
}

void runResample(const ActionCall& call, Session& session)
{
    StackItem& item = selectObjectGrid(session, call.text("vdb"));
    StackItem result;
    try {
        const double voxel =
            call.given("voxel") ? call.length("voxel") : spheretree::shortestVoxelEdge(*item.grid);
        warnOfSize(item, voxel, session);
        result.grid = spheretree::resampled(*item.grid, voxel,
            call.flag("nearest") ? spheretree::Sampling::Nearest : spheretree::Sampling::Linear,
            &session.progress);
    } catch (const openvdb::ValueError&) { // these name the grid
        rethrowNamed("", kInput);
    } catch (const openvdb::TypeError&) {
        rethrowNamed("", kInput);
    } catch (...) {
        rethrowNamed(item.description(), kInput);
    }
    result.interpolated = item.interpolated || !call.flag("nearest");
    if (call.given("name")) result.grid->setName(call.text("name"));
    if (!call.flag("keep")) session.stack.drop(&item);
    session.stack.beginBatch(call.label());
    session.stack.push(result);
}

} // namespace

ActionSpec resampleAction()
{
    ActionSpec action{"resample", "", "voxel",
        "give a grid cubic voxels along the axes of the world: level sets are made anew around "
        "their "
        "surface, other grids interpolated, masks take the nearest voxel"};
    action.options = {
        length("voxel", "", 1e-30, 1e30,
            "size of a voxel in world units (by default the shortest edge of those there "
            "are)"),
        flag("nearest", false, "take the value of the nearest voxel, as for labels"),
        vdbOption("the grid"), keepOption(),
        nameOption("", "name of the result (by default that of the grid)")};
    action.run = runResample;
    return action;
}

} // namespace command
