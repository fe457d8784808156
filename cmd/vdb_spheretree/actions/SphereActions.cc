// SPDX-License-Identifier: Apache-2.0
/// @file SphereActions.cc
/// @brief -spheres2mask and -spheres2ls: the union of a level's spheres as a grid.
///
/// The mask is exact: the voxel centres that lie in the level's spheres without padding, so level 0
/// gives the object back. The level set is that of the spheres as stored, in world space.

#include "GivenSpheres.h"
#include "line/Actions.h"
#include "session/Session.h"

#include <openvdb_spheretree/sphere/SphereUnion.h>
#include <openvdb_spheretree/tree/LevelSpheres.h>
#include <openvdb_spheretree/tree/SphereLevelSet.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>

#include <optional>

namespace command {

namespace spheretree = openvdb_spheretree;
using spheretree::SphereTree;
using spheretree::SphereTreeLevel;

namespace {

/// The level of the call; without one the finest there is.
const SphereTreeLevel& levelOf(const ActionCall& call, const SphereTree& tree)
{
    if (!call.given("level")) return tree.levels.front();
    const int number = int(call.integer("level"));
    if (tree.hasLevel(number)) return tree.level(number);
    throwInput("the tree has no level " + call.text("level") + ": it has levels "
        + std::to_string(tree.levels.front().level) + " to " + std::to_string(tree.root().level));
}

openvdb::GridBase::Ptr maskOf(
    const SphereTree& tree, const SphereTreeLevel& level, Session& session)
{
    const auto covered = spheretree::levelUnion(tree, level, &session.progress);
    auto mask = openvdb::BoolGrid::create(openvdb::BoolTree::Ptr(
        new openvdb::BoolTree(*covered, false, true, openvdb::TopologyCopy())));
    mask->setTransform(tree.transform->copy());
    return mask;
}

openvdb::GridBase::Ptr levelSetOf(
    const SphereTree& tree, const SphereTreeLevel& level, const ActionCall& call, Session& session)
{
    if (!tree.settings.dist().isEuclidean()) {
        throwInput("this action draws spheres, and the balls of dist="
            + spheretree::toString(tree.settings.dist()) + " are none: use -spheres2mask");
    }
    const auto voxel =
        call.given("voxel") ? std::optional<double>(call.length("voxel")) : std::nullopt;
    const auto grid =
        spheretree::levelSetOfSpheres(tree, level, voxel, call.real("width"), &session.progress);
    throwIfStopped();
    return grid;
}

template <typename MakeGrid>
void replaceTree(const ActionCall& call, Session& session, const MakeGrid& makeGrid)
{
    StackItem& input = session.stack.selectTree(call.text("vdb"));
    placeInObject(input, session);
    StackItem result;
    result.grid = makeGrid(*input.tree, levelOf(call, *input.tree));
    result.grid->setName(call.given("name") ? call.text("name") : input.name());
    if (!call.flag("keep")) session.stack.drop(&input);
    session.stack.beginBatch(call.label());
    session.stack.push(result);
}

void runMask(const ActionCall& call, Session& session)
{
    replaceTree(call, session, [&](const SphereTree& tree, const SphereTreeLevel& level) {
        return maskOf(tree, level, session);
    });
}

void runLevelSet(const ActionCall& call, Session& session)
{
    replaceTree(call, session, [&](const SphereTree& tree, const SphereTreeLevel& level) {
        return levelSetOf(tree, level, call, session);
    });
}

OptionSpec levelOption() { return integer("level", "0", 0, 1000, "the level; 0 is the finest"); }

} // namespace

ActionSpec spheres2maskAction()
{
    ActionSpec action{"spheres2mask", "", "level",
        "the voxels whose centres lie in a level's spheres (without padding), on the source's "
        "grid"};
    action.options = {levelOption(), vdbOption("the tree"), keepOption(),
        nameOption("", "name of the result (by default that of the tree)")};
    action.run = runMask;
    return action;
}

ActionSpec spheres2lsAction()
{
    ActionSpec action{
        "spheres2ls", "", "level", "the union of a level's spheres, as stored, as a level set"};
    action.options = {levelOption(),
        length(
            "voxel", "", 1e-30, 1e30, "size of a voxel in world units (by default the source's)"),
        real("width", "3", 1, 1000, "half the width of the narrow band, in voxels"),
        vdbOption("the tree"), keepOption(),
        nameOption("", "name of the result (by default that of the tree)")};
    action.run = runLevelSet;
    return action;
}

} // namespace command
