// SPDX-License-Identifier: Apache-2.0
/// @file TestModelledTrees.cc
/// @brief What holds for every sphere-tree, with other pyramid models than OR: ones that stay in
/// the object's box, ones that leave it, and ones that no tree can be made with.

#include "support/BuiltTrees.h"
#include "support/Messages.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/check/TreeCheck.h>
#include <openvdb_spheretree/pyramid/BlockModel.h>
#include <openvdb_spheretree/pyramid/Closing.h>
#include <openvdb_spheretree/pyramid/OrPyramid.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
using openvdb::MaskTree;

/// OR, and whatever closes a gap of one voxel along an axis; stays in the box.
bool bridges(const ChildBlock& block)
{
    return block.any() || (block.any(-1, 0, 0) && block.any(1, 0, 0))
        || (block.any(0, -1, 0) && block.any(0, 1, 0));
}

/// Adds a voxel at even x behind one whose last two children along x are on: it leaves the box, but
/// ends. (At any x it would not: of two voxels it would always make two again.)
bool grows(const ChildBlock& block)
{
    return block.any()
        || (block.parent()[0] % 2 == 0 && block.isOn(-1, 0, 0) && block.isOn(-2, 0, 0));
}

struct Model {
    const char* name;
    int closing;
    PyramidModel custom;
};

std::vector<Model> models()
{
    return {{"closing of 1", 1, {}}, {"closing of 3", 3, {}}, {"bridges", 0, blockModel(bridges)},
        {"growing", 0, blockModel(grows)}};
}

/// Checked as -check would, and once more after a way through points.
void expectSound(const SphereTree& tree, const openvdb::BoolGrid& object, const Voxels& voxels)
{
    EXPECT_TRUE(endsAtOneRoot(tree));
    EXPECT_TRUE(covers(tree, voxels));
    const auto faults = checkSphereTree(tree, object);
    EXPECT_TRUE(faults.empty()) << faults.front().sentence;
}

TEST(ModelledTrees, HoldWhatEveryTreeHolds)
{
    for (const Model& model : models()) {
        for (const RandomObject& object : someObjects(300, 2)) {
            const auto grid = gridOf(object.voxels);
            for (const TreeType type : {TreeType::Reversible, TreeType::Extended}) {
                for (SphereTreeSettings settings : allSettings(type, 3)) {
                    settings.pyramid().closing = model.closing;
                    settings.pyramid().customModel = model.custom;
                    SCOPED_TRACE(object.name + ", " + model.name + ": " + describe(settings));
                    expectSound(buildSphereTree(*grid, settings), *grid, object.voxels);
                    if (testing::Test::HasFailure()) return;
                }
            }
        }
    }
}

TEST(ModelledTrees, HoldInTwoDimensions)
{
    for (const Model& model : models()) {
        for (const RandomObject& object : someObjects(330, 1)) {
            const Voxels voxels = flattened(object.voxels);
            const auto grid = gridOf(voxels);
            for (SphereTreeSettings settings : allSettings(TreeType::Extended, 2)) {
                settings.pyramid().closing = model.closing;
                settings.pyramid().customModel = model.custom;
                SCOPED_TRACE(object.name + ", " + model.name + ": " + describe(settings));
                expectSound(buildSphereTree(*grid, settings), *grid, voxels);
                if (testing::Test::HasFailure()) return;
            }
        }
    }
}

TEST(ModelledTrees, AReversibleTreeRebuildsTheModelsLevels)
{
    for (const Model& model : models()) {
        const RandomObject object = randomObject(77);
        SphereTreeSettings settings;
        setType(settings, TreeType::Reversible);
        settings.pyramid().closing = model.closing;
        settings.pyramid().customModel = model.custom;
        const SphereTree tree = buildSphereTree(*gridOf(object.voxels), settings);
        const PyramidModel step = model.custom ? model.custom : closingModel(model.closing);
        const OrPyramid pyramid = buildOrPyramid(*gridOf(object.voxels), 2, 3, step);
        for (const SphereTreeLevel& level : tree.levels) {
            EXPECT_EQ(
                level.pyramidVoxels, int64_t(pyramid.levels.at(level.level)->activeVoxelCount()))
                << model.name << ", level " << level.level;
        }
    }
}

TEST(ModelledTrees, ACustomTreeReadBackIsKnownAsOneAndChecked)
{
    const RandomObject object = randomObject(12);
    const auto grid = gridOf(object.voxels);
    SphereTreeSettings settings = extendedTree();
    settings.pyramid().dag = true;
    settings.pyramid().customModel = blockModel(bridges);
    const SphereTree tree = buildSphereTree(*grid, settings);
    EXPECT_FALSE(isUnknown(tree.settings.pyramid().customModel));
    SphereTree copy = tree;
    copy.settings.pyramid().customModel = unknownModel(); // as files give it
    EXPECT_EQ(modelToString(copy.settings.pyramid()), "custom");
    EXPECT_TRUE(checkSphereTree(copy, *grid).empty());
    const std::string why =
        messageOf<openvdb::ValueError>([&] { buildSphereTree(*grid, copy.settings); });
    EXPECT_TRUE(mentions(why, "set customModel"));
}

TEST(ModelledTrees, ATreeKnowsWhetherItsModelIsCustom)
{
    const auto grid = gridOf(randomObject(12).voxels);
    SphereTreeSettings settings = extendedTree();
    EXPECT_EQ(modelToString(buildSphereTree(*grid, settings).settings.pyramid()), "or");
    settings.pyramid().closing = 1;
    EXPECT_EQ(modelToString(buildSphereTree(*grid, settings).settings.pyramid()), "closing:1");
}

std::string whyNoTree(const PyramidModel& model)
{
    std::string all;
    for (SphereTreeSettings settings : bothTypes()) {
        settings.pyramid().customModel = model;
        if (settings.type() == TreeType::Extended) {
            settings.extended().reconstruct = Reconstruction::None;
        }
        all += messageOf<openvdb::ValueError>([&] {
            buildSphereTree(*gridOf(shapes::ball(60)), settings);
        }) + "\n";
    }
    return all;
}

/// The same part of a message, for both types of tree.
testing::AssertionResult mentionsTwice(const std::string& text, const std::string& part)
{
    const auto first = text.find(part);
    if (first != std::string::npos && text.find(part, first + 1) != std::string::npos) {
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << "'" << part << "' is not there twice: " << text;
}

TEST(ModelledTrees, AModelThatLosesVoxelsIsRefused)
{
    const auto most = [](const ChildBlock& block) { return block.count() > 1; };
    EXPECT_TRUE(mentionsTwice(whyNoTree(blockModel(most)), "not including: it leaves out"));
    const auto nothing = [](const MaskTree&, const PyramidStep&) { return MaskTree::Ptr(); };
    EXPECT_TRUE(mentionsTwice(whyNoTree(nothing), "the pyramid model gave no voxels"));
}

TEST(ModelledTrees, AModelThatNeverEndsIsRefused)
{
    const auto swells = [](const MaskTree& level, const PyramidStep& step) {
        const auto next = coarsen(level, step);
        next->setValueOn(Coord(0, 0, 0));
        next->setValueOn(Coord(6, 0, 0));
        next->setValueOn(Coord(12, 0, 0));
        return next;
    };
    SphereTreeSettings settings;
    setType(settings, TreeType::Reversible); // the extended one may drop what the model adds
    settings.pyramid().customModel = swells;
    const std::string why = messageOf<openvdb::ValueError>(
        [&] { buildSphereTree(*gridOf(shapes::ball(60)), settings); });
    EXPECT_TRUE(mentions(why, "grows level"));
    const auto far = [](const MaskTree& level, const PyramidStep& step) {
        const auto next = coarsen(level, step);
        next->setValueOn(Coord(1 << 20, 0, 0));
        return next;
    };
    EXPECT_TRUE(mentionsTwice(whyNoTree(far), "grows level 1 to 10485"));
}

} // namespace
