// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tree/SphereTreeSettings.h>

#include "support/Messages.h"

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>

#include <cmath>
#include <limits>
#include <utility>

using namespace openvdb_spheretree;
using spheretree_test::mentions;
using spheretree_test::messageOf;

namespace {

std::string whyInvalid(const SphereTreeSettings& settings)
{
    return messageOf<openvdb::ValueError>([&] { settings.validate(); });
}

} // namespace

TEST(SphereTreeSettings, DefaultsAreValid) { EXPECT_NO_THROW(SphereTreeSettings().validate()); }

TEST(SphereTreeSettings, ModelsHaveNamesThatReadBack)
{
    SphereTreeSettings settings;
    EXPECT_EQ(modelToString(settings), "or");
    for (const int radius : {1, 2, 17, kMaxClosing}) {
        settings.closing = radius;
        EXPECT_EQ(modelToString(settings), "closing:" + std::to_string(radius));
        EXPECT_EQ(closingFromString(modelToString(settings)), radius);
    }
    EXPECT_EQ(closingFromString("or"), 0);
    settings.hadCustomModel = true;
    EXPECT_EQ(modelToString(settings), "custom");
    for (const char* text : {"", "OR", "closing", "closing:", "closing:0", "closing:-1",
             "closing:65", "closing:2x", "closing: 2", "closing:+2", "custom", "2"}) {
        EXPECT_THROW(closingFromString(text), openvdb::ValueError) << text;
    }
}

TEST(SphereTreeSettings, ClosingsHaveALimit)
{
    for (const int radius : {-1, 65}) {
        SphereTreeSettings settings;
        settings.tree = TreeType::Extended;
        settings.closing = radius;
        const std::string why = whyInvalid(settings);
        EXPECT_TRUE(mentions(why, "closing=" + std::to_string(radius) + " is out of range"));
    }
}

TEST(SphereTreeSettings, TheNamesOfValuesReadBack)
{
    EXPECT_EQ(treeTypeFromString("reversible"), TreeType::Reversible);
    EXPECT_EQ(treeTypeFromString("extended"), TreeType::Extended);
    EXPECT_EQ(parentRuleFromString("centre"), ParentRule::Centre);
    EXPECT_EQ(parentRuleFromString("dag"), ParentRule::Dag);
    EXPECT_EQ(reconstructionFromString("clip"), Reconstruction::Clip);
    EXPECT_EQ(reconstructionFromString("free"), Reconstruction::Free);
    EXPECT_EQ(reconstructionFromString("none"), Reconstruction::None);
    EXPECT_EQ(radiusScaleFromString("tight"), RadiusScale::Tight);
    EXPECT_EQ(radiusScaleFromString("paper"), RadiusScale::Paper);
    for (TreeType v : {TreeType::Reversible, TreeType::Extended, TreeType::Tight}) {
        EXPECT_EQ(treeTypeFromString(toString(v)), v);
    }
    for (ParentRule v : {ParentRule::Centre, ParentRule::Dag}) {
        EXPECT_EQ(parentRuleFromString(toString(v)), v);
    }
    for (Reconstruction v : {Reconstruction::Clip, Reconstruction::Free, Reconstruction::None}) {
        EXPECT_EQ(reconstructionFromString(toString(v)), v);
    }
    for (RadiusScale v : {RadiusScale::Tight, RadiusScale::Paper}) {
        EXPECT_EQ(radiusScaleFromString(toString(v)), v);
    }
    EXPECT_EQ(dagEdgesFromString("shared"), DagEdges::Shared);
    EXPECT_EQ(dagEdgesFromString("intersecting"), DagEdges::Intersecting);
    for (DagEdges v : {DagEdges::Shared, DagEdges::Intersecting}) {
        EXPECT_EQ(dagEdgesFromString(toString(v)), v);
    }
}

TEST(SphereTreeSettings, AnUnknownNameIsAnErrorThatNamesItAndTheValuesThereAre)
{
    const std::string tree = messageOf<openvdb::ValueError>([] { treeTypeFromString("octree"); });
    EXPECT_TRUE(mentions(tree, "tree='octree'"));
    EXPECT_TRUE(mentions(tree, "reversible, extended or tight"));
    const std::string reconstruct =
        messageOf<openvdb::ValueError>([] { reconstructionFromString("Clip"); });
    EXPECT_TRUE(mentions(reconstruct, "reconstruct='Clip'"));
    EXPECT_TRUE(mentions(reconstruct, "clip, free or none"));
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([] { parentRuleFromString("center"); }), "centre or dag"));
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([] { radiusScaleFromString(""); }), "tight or paper"));
}

TEST(SphereTreeSettings, TheNamesOfWhatTightTreesCanBeAskedForReadBack)
{
    EXPECT_EQ(treeTypeFromString("tight"), TreeType::Tight);
    EXPECT_STREQ(toString(TreeType::Tight), "tight");
    const std::pair<const char*, Quality> qualities[] = {
        {"fast", Quality::Fast}, {"normal", Quality::Normal}, {"best", Quality::Best}};
    for (const auto& [name, value] : qualities) {
        EXPECT_EQ(qualityFromString(name), value);
        EXPECT_STREQ(toString(value), name);
    }
    const std::pair<const char*, Cover> covers[] = {
        {"voxels", Cover::Voxels}, {"balls", Cover::Balls}};
    for (const auto& [name, value] : covers) {
        EXPECT_EQ(coverFromString(name), value);
        EXPECT_STREQ(toString(value), name);
    }
    const std::pair<const char*, Center> centers[] = {
        {"medial", Center::Medial}, {"miniball", Center::Miniball}};
    for (const auto& [name, value] : centers) {
        EXPECT_EQ(centerFromString(name), value);
        EXPECT_STREQ(toString(value), name);
    }
    const std::pair<const char*, Leaves> leaves[] = {
        {"pruned", Leaves::Pruned}, {"medial", Leaves::Medial}};
    for (const auto& [name, value] : leaves) {
        EXPECT_EQ(leavesFromString(name), value);
        EXPECT_STREQ(toString(value), name);
    }
    const std::pair<const char*, Side> sides[] = {{"outer", Side::Outer}, {"inner", Side::Inner}};
    for (const auto& [name, value] : sides) {
        EXPECT_EQ(sideFromString(name), value);
        EXPECT_STREQ(toString(value), name);
    }
}

TEST(SphereTreeSettings, AnUnknownNameOfATightTreeIsAnErrorThatNamesItAndTheValuesThereAre)
{
    const auto why = [](auto parse, const char* text) {
        return messageOf<openvdb::ValueError>([&] { parse(text); });
    };
    EXPECT_TRUE(mentions(why(qualityFromString, "Best"), "quality='Best'"));
    EXPECT_TRUE(mentions(why(qualityFromString, ""), "fast, normal or best"));
    EXPECT_TRUE(mentions(why(coverFromString, "cubes"), "cover='cubes' is unknown"));
    EXPECT_TRUE(mentions(why(coverFromString, "voxel"), "voxels or balls"));
    EXPECT_TRUE(mentions(why(centerFromString, "centre"), "medial or miniball"));
    EXPECT_TRUE(mentions(why(leavesFromString, "all"), "pruned or medial"));
    EXPECT_TRUE(mentions(why(sideFromString, "both"), "outer or inner"));
}

TEST(SphereTreeSettings, ATightTreeTakesEverySettingOfItsOwn)
{
    SphereTreeSettings settings;
    settings.tree = TreeType::Tight;
    EXPECT_NO_THROW(settings.validate());
    settings.quality = Quality::Best;
    settings.budget.spheres = {512, 64, 8};
    settings.cover = Cover::Balls;
    settings.leaves = Leaves::Medial;
    EXPECT_NO_THROW(settings.validate());
    settings.quality = Quality::Normal;
    settings.cuts = true;
    EXPECT_NO_THROW(settings.validate());
    settings.side = Side::Inner;
    EXPECT_NO_THROW(settings.validate());
    settings.budget.branching = 4;
    EXPECT_TRUE(mentions(whyInvalid(settings), "contradict each other"));
}

TEST(SphereTreeSettings, ATightTreeRefusesWhatOnlyTreesOfThePyramidHave)
{
    SphereTreeSettings norm, miniball, dag;
    norm.tree = miniball.tree = dag.tree = TreeType::Tight;
    norm.dist = Distance::chamfer(3, 4, 5);
    miniball.center = Center::Miniball;
    dag.dag = true;
    EXPECT_TRUE(mentions(whyInvalid(norm), "not for dist=chamfer:3,4,5"));
    EXPECT_TRUE(mentions(whyInvalid(miniball), "center=miniball"));
    EXPECT_TRUE(mentions(whyInvalid(dag), "no Sphere-DAG"));

    SphereTreeSettings factor, closing, custom, parent, fit, reconstruct, scale, edges;
    factor.factor = 3;
    closing.closing = 2;
    custom.customModel = [](const openvdb::MaskTree&, const PyramidStep&) {
        return openvdb::MaskTree::Ptr();
    };
    parent.parent = ParentRule::Dag;
    fit.finalFit = false;
    reconstruct.reconstruct = Reconstruction::None;
    scale.scale = RadiusScale::Paper;
    edges.edges = DagEdges::Intersecting;
    const std::vector<std::pair<SphereTreeSettings, std::string>> others{{factor, "factor=3"},
        {closing, "model=closing:2"}, {custom, "model=custom"}, {parent, "parent=dag"},
        {fit, "final_fit=0"}, {reconstruct, "reconstruct=none"}, {scale, "scale=paper"},
        {edges, "edges=intersecting"}};
    for (auto [settings, what] : others) {
        EXPECT_TRUE(mentions(whyInvalid(settings), what + " is for tree=extended"));
        settings.tree = TreeType::Extended;
        EXPECT_NO_THROW(settings.validate()) << what;
    }
}

TEST(SphereTreeSettings, ATightTreeIsWhatThereIsUnlessAskedOtherwise)
{
    EXPECT_EQ(SphereTreeSettings().tree, TreeType::Tight);
}

TEST(SphereTreeSettings, TheBestLevelsAndAllCutsContradictEachOther)
{
    SphereTreeSettings settings;
    settings.quality = Quality::Best;
    EXPECT_NO_THROW(settings.validate());
    settings.cuts = true;
    EXPECT_TRUE(mentions(whyInvalid(settings), "quality=best and cuts=1 contradict"));
    EXPECT_TRUE(mentions(whyInvalid(settings), "use quality=normal"));
}

TEST(SphereTreeSettings, OtherTreesRefuseWhatOnlyTightTreesHave)
{
    for (const TreeType type : {TreeType::Reversible, TreeType::Extended}) {
        SphereTreeSettings spheres, branching, error, distance, cuts, inner;
        spheres.budget.spheres = {8};
        branching.budget.branching = 4;
        error.budget.error = 1;
        distance.budget.distance = 1;
        cuts.cuts = true;
        inner.side = Side::Inner;
        for (SphereTreeSettings settings : {spheres, branching, error, distance, cuts, inner}) {
            settings.tree = type;
            const std::string why = whyInvalid(settings);
            EXPECT_TRUE(mentions(why, "for tree=tight"));
            EXPECT_TRUE(mentions(why, toString(type)));
        }
    }
}

TEST(SphereTreeSettings, ALongValueIsClippedInTheMessage)
{
    const std::string value(100000, 'x');
    EXPECT_LT(messageOf<openvdb::ValueError>([&] { treeTypeFromString(value); }).size(), 200u);
    EXPECT_LT(messageOf<openvdb::ValueError>([&] { paddingFromString(value); }).size(), 200u);
}

TEST(SphereTreeSettings, ThePaddingReadsBackToTheSameDouble)
{
    EXPECT_EQ(paddingToString(SphereTreeSettings::kPadCubes), "cubes");
    EXPECT_EQ(paddingToString(0), "voxels");
    EXPECT_EQ(paddingToString(0.5), "0.5");
    EXPECT_EQ(paddingFromString("cubes"), SphereTreeSettings::kPadCubes);
    EXPECT_EQ(paddingFromString("voxels"), 0);
    EXPECT_EQ(paddingFromString("2"), 2);
    for (double value : {0.1, 1.0 / 3, 1e-300, 1e300, std::nextafter(1.0, 2.0),
             std::numeric_limits<double>::denorm_min()}) {
        EXPECT_EQ(paddingFromString(paddingToString(value)), value);
    }
    EXPECT_FALSE(std::signbit(paddingFromString("-0")));
}

TEST(SphereTreeSettings, APaddingThatIsNotWhollyANumberIsAnError)
{
    for (const char* text : {"", " ", "1 ", " 1", "1x", "x", "0,5", "1e", "-", "--1", "cube", "nan",
             "inf", "-inf", "1e999", "-1", "-0.5"}) {
        const std::string why = messageOf<openvdb::ValueError>([&] { paddingFromString(text); });
        EXPECT_TRUE(mentions(why, "cubes, voxels")) << "for '" << text << "'";
    }
}

TEST(SphereTreeSettings, MemoryIsBytesOrAShare)
{
    EXPECT_EQ(memoryFromString("4000000000"), 4000000000);
    EXPECT_EQ(memoryFromString("4e9"), 4000000000);
    EXPECT_EQ(memoryFromString("1B"), 1);
    EXPECT_EQ(memoryFromString("4GiB"), int64_t(4) << 30);
    EXPECT_EQ(memoryFromString("4G"), int64_t(4) << 30);
    EXPECT_EQ(memoryFromString("0.5gib"), int64_t(1) << 29);
    EXPECT_EQ(memoryFromString("4GB"), 4000000000);
    EXPECT_EQ(memoryFromString("500MiB"), int64_t(500) << 20);
    EXPECT_EQ(memoryFromString("1TB"), 1000000000000);
    EXPECT_EQ(memoryFromString("75%"), 0);
    EXPECT_NEAR(double(memoryFromString("50%")), double(memoryFromString("100%")) / 2, 1);
    EXPECT_GT(memoryFromString("0.1%"), 1 << 20);
}

TEST(SphereTreeSettings, MemoryReadsBack)
{
    EXPECT_EQ(memoryToString(0), "75%");
    EXPECT_EQ(memoryToString(int64_t(4) << 30), "4GiB");
    EXPECT_EQ(memoryToString(1536 << 20), "1536MiB");
    EXPECT_EQ(memoryToString(4000000001), "4000000001");
    for (const int64_t bytes : {int64_t(0), int64_t(1), int64_t(1024), int64_t(3) << 20,
             int64_t(5) << 40, int64_t(1) << 52}) {
        EXPECT_EQ(memoryFromString(memoryToString(bytes)), bytes);
    }
}

TEST(SphereTreeSettings, AMemoryThatIsNoneIsAnError)
{
    const auto whyNot = [](const char* text) {
        const std::string why = messageOf<openvdb::ValueError>([&] { memoryFromString(text); });
        EXPECT_TRUE(mentions(why, "memory='" + std::string(text) + "' is "));
        EXPECT_TRUE(
            mentions(why, "choose a number of bytes such as 4GiB, 500MB or 4e9, or a share"));
        return why;
    };
    for (const char* text : {"", "abc", "GiB", "4 GiB", "4GiBs", "4,5GiB", "nan", "%", "101%",
             "75%%", "0x10", "1e999", "--1"}) {
        EXPECT_TRUE(mentions(whyNot(text), "' is unknown: "));
    }
    for (const char* text : {"0", "-0", "-1", "0%", "-5%", "0GiB", "0.9", "1e-300%", "-inf"}) {
        EXPECT_TRUE(mentions(whyNot(text), "' is too little: "));
    }
    for (const char* text : {"1e19", "9223372036854775808", "1e8TiB", "inf"}) {
        EXPECT_TRUE(mentions(whyNot(text), "' is too much: "));
    }
    EXPECT_LT(
        messageOf<openvdb::ValueError>([] { memoryFromString(std::string(100000, '9')); }).size(),
        300u);
}

TEST(SphereTreeSettings, CubesPadByHalfADiagonalOfTheDimension)
{
    SphereTreeSettings settings;
    EXPECT_DOUBLE_EQ(settings.paddingVoxels(), std::sqrt(3.0) / 2);
    settings.dim = 2;
    EXPECT_DOUBLE_EQ(settings.paddingVoxels(), std::sqrt(2.0) / 2);
    settings.padding = 0;
    EXPECT_EQ(settings.paddingVoxels(), 0);
    settings.padding = 0.25;
    EXPECT_EQ(settings.paddingVoxels(), 0.25);
}

TEST(SphereTreeSettings, AFactorOutOfRangeIsAnErrorThatNamesTheRange)
{
    SphereTreeSettings settings;
    settings.tree = TreeType::Extended;
    for (int factor : {2, 3, 64}) {
        settings.factor = factor;
        EXPECT_NO_THROW(settings.validate());
    }
    for (int factor : {1, 0, -2, 32769, std::numeric_limits<int>::min()}) {
        settings.factor = factor;
        EXPECT_TRUE(mentions(whyInvalid(settings), "factor=" + std::to_string(factor)));
        EXPECT_TRUE(mentions(whyInvalid(settings), "2 to 32768"));
    }
}

TEST(SphereTreeSettings, ADimensionOtherThan2Or3IsAnError)
{
    SphereTreeSettings settings;
    for (int dim : {1, 4, 0, -3}) {
        settings.dim = dim;
        EXPECT_TRUE(mentions(whyInvalid(settings), "dim=" + std::to_string(dim)));
    }
    settings.dim = 2;
    EXPECT_NO_THROW(settings.validate());
}

TEST(SphereTreeSettings, APaddingThatIsNegativeOrNoNumberIsAnError)
{
    SphereTreeSettings settings;
    for (double padding : {-0.5, -2.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
        settings.padding = padding;
        EXPECT_TRUE(mentions(whyInvalid(settings), "padding="));
    }
    for (double padding : {0.0, 1e6, SphereTreeSettings::kPadCubes}) {
        settings.padding = padding;
        EXPECT_NO_THROW(settings.validate());
    }
}

TEST(SphereTreeSettings, MiniballsAreEuclideanAndFitted)
{
    for (const TreeType type : {TreeType::Reversible, TreeType::Extended}) {
        SphereTreeSettings settings;
        settings.tree = type;
        settings.center = Center::Miniball;
        EXPECT_NO_THROW(settings.validate());
        settings.dist = Distance::l1();
        EXPECT_TRUE(mentions(whyInvalid(settings), "center=miniball is for dist=l2"));
        settings.dist = Distance();
        settings.finalFit = false;
        if (type == TreeType::Reversible) {
            EXPECT_NO_THROW(settings.validate()) << "which knows no final fit";
        } else {
            EXPECT_TRUE(mentions(whyInvalid(settings), "center=miniball and final_fit=0"));
        }
    }
}

TEST(SphereTreeSettings, InnerTreesHaveNoBoundOnWhatTheyReachOutside)
{
    SphereTreeSettings settings;
    settings.tree = TreeType::Tight;
    settings.side = Side::Inner;
    settings.budget.spheres = {64};
    EXPECT_NO_THROW(settings.validate());
    settings.budget.error = 1;
    EXPECT_TRUE(mentions(whyInvalid(settings), "side=inner and a bound"));
    settings.budget.error.reset();
    settings.budget.distance = 1;
    EXPECT_TRUE(mentions(whyInvalid(settings), "side=inner and a bound"));
}
