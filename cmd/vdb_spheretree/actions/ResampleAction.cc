// SPDX-License-Identifier: Apache-2.0
/// @file ResampleAction.cc
/// @brief -resample: grids whose voxels are no cubes, or of the wrong size.

#include "line/Actions.h"
#include "ObjectChoice.h"

#include <openvdb_spheretree/input/Resample.h>

namespace command {

namespace spheretree = openvdb_spheretree;

namespace {

void runResample(const ActionCall& call, Session& session)
{
    StackItem& item = selectObjectGrid(session, call.text("vdb"));
    StackItem result;
    try {
        const double voxel =
            call.given("voxel") ? call.length("voxel") : spheretree::shortestVoxelEdge(*item.grid);
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
