// SPDX-License-Identifier: Apache-2.0
#include <openvdb_spheretree/tree/SettingsTable.h>

#include "support/Messages.h"

#include <gtest/gtest.h>
#include <openvdb/Exceptions.h>
#include <openvdb/math/Transform.h>

#include <set>

using namespace openvdb_spheretree;
using namespace openvdb_spheretree::detail;
using spheretree_test::mentions;
using spheretree_test::messageOf;

namespace {

std::vector<SphereTreeSettings> allKinds()
{
    return {TightOptions(), InnerOptions(), FitOptions(), ExtendedOptions(), ReversibleOptions(),
        GivenOptions()};
}

/// A value that no setting has by default.
std::string otherValue(const Setting& setting)
{
    if (setting.type == SettingType::Choice) return setting.choices.back();
    if (setting.type == SettingType::Flag) return setting.fallback == "1" ? "0" : "1";
    if (setting.type == SettingType::Counts) return "64,8";
    if (setting.type == SettingType::Real) return "0.1";
    if (setting.type == SettingType::Length) return "0.1vox";
    if (setting.type == SettingType::Integer) return setting.name == "dim" ? "2" : "5";
    if (setting.name == "dist") return "chamfer:3,4,5";
    if (setting.name == "padding") return "0.1";
    if (setting.name == "model") return "closing:3";
    if (setting.name == "origin") return "0,-8,16";
    return setting.name == "memory" ? "4GiB" : "another";
}

bool choosesKind(const Setting& setting)
{
    return setting.name == "tree" || setting.name == "side";
}

/// Whether the kind has a value of its own there: of dist and padding some kinds have only one.
bool isFree(const Setting& setting, const SphereTreeSettings& settings)
{
    if (setting.name == "dist" && !settings.find<PyramidOptions>()) return false;
    const bool padded = !settings.isInner() && !settings.isFit() && !settings.isGiven();
    return setting.isFor(settings) && (padded || setting.name != "padding");
}

} // namespace

/// A field more or less in one of these structs does not compile here: it needs a row. (The structs of
/// one kind have bases, which no binding takes: their own fields are counted by hand.)
TEST(SettingsTable, HasARowForEveryField)
{
    const auto& [budget, cuts] = BudgetOptions();
    const auto& [spheres, branching, error, distance, inVoxels, bounds] = budget;
    const auto& [factor, closing, model, origin, dist, center, parent, scale, dag, edges] =
        PyramidOptions();
    const SphereTreeSettings settings;
    const auto& [kind, dim, padding, topology, name, memory] = settings;
    const auto count = [](const auto&... fields) { return sizeof...(fields); };
    const std::size_t budgets = count(spheres, branching, error, distance, bounds, cuts);
    const std::size_t pyramids =
        count(factor, model, origin, dist, center, parent, scale, dag, edges);
    const std::size_t shared = count(dim, padding, topology, name, memory);
    // Beside these: quality, cover and leaves; strict; finalFit and reconstruct; the kind has two rows.
    EXPECT_EQ(settingsTable().size(), budgets + pyramids + shared + 3 + 1 + 2 + 2);
    EXPECT_EQ(settingsInJson().size(), settingsTable().size() - 1) << "all but memory";
    static_cast<void>(closing), static_cast<void>(kind),
        static_cast<void>(inVoxels); // rows "model"; "tree" and "side"; "distance"
}

TEST(SettingsTable, EveryRowReadsBackInEveryKindThatHasIt)
{
    for (const SphereTreeSettings& kind : allKinds()) {
        for (const Setting& setting : settingsTable()) {
            if (choosesKind(setting) || !isFree(setting, kind)) continue;
            SphereTreeSettings settings = kind;
            const std::string value = otherValue(setting);
            ASSERT_NE(setting.get(settings), value) << setting.name;
            setting.set(settings, value);
            EXPECT_EQ(setting.get(settings), value) << setting.name;
            for (const Setting& other : settingsTable()) {
                if (&other == &setting) continue;
                EXPECT_EQ(other.get(settings), other.get(kind)) << setting.name << other.name;
            }
        }
    }
}

TEST(SettingsTable, ARowOfAnotherKindHasItsDefaultAndCannotBeChanged)
{
    for (const SphereTreeSettings& kind : allKinds()) {
        for (const Setting& setting : settingsTable()) {
            if (choosesKind(setting) || setting.isFor(kind)) continue;
            SphereTreeSettings settings = kind;
            setting.set(settings, otherValue(setting));
            const bool unset = setting.name == "branching"; // 0, which stands for the default
            EXPECT_EQ(setting.get(settings), unset ? "0" : setting.fallback) << setting.name;
        }
    }
}

TEST(SettingsTable, TreeAndSideChooseTheKind)
{
    EXPECT_TRUE(settingsOfKind("tight", "outer").find<TightOptions>());
    EXPECT_TRUE(settingsOfKind("tight", "inner").find<InnerOptions>());
    EXPECT_TRUE(settingsOfKind("tight", "fit").find<FitOptions>());
    EXPECT_TRUE(settingsOfKind("extended", "outer").find<ExtendedOptions>());
    EXPECT_TRUE(settingsOfKind("reversible", "outer").find<ReversibleOptions>());
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([] { settingsOfKind("extended", "inner"); }), "tree=tight"));
    for (const SphereTreeSettings& kind : allKinds()) {
        const auto& same =
            settingsOfKind(settingNamed("tree").get(kind), settingNamed("side").get(kind));
        EXPECT_EQ(same.kind.index(), kind.kind.index());
    }
}

TEST(SettingsTable, NamesAndKeysAndPlacesAreUnique)
{
    std::set<std::string> names, keys;
    std::set<int> places;
    int keyed = 0, placed = 0;
    for (const Setting& setting : settingsTable()) {
        names.insert(setting.name);
        if (!setting.key.empty()) keys.insert(setting.key), ++keyed;
        if (setting.jsonPlace >= 0) places.insert(setting.jsonPlace), ++placed;
    }
    EXPECT_EQ(names.size(), settingsTable().size());
    EXPECT_EQ(int(keys.size()), keyed);
    EXPECT_EQ(int(places.size()), placed);
    EXPECT_THROW(settingNamed("none"), openvdb::LookupError);
}

TEST(SettingsTable, AnUnknownValueIsAnErrorThatNamesItAndTheValuesThereAre)
{
    for (const Setting& setting : settingsTable()) {
        if (setting.name == "name") continue;
        SphereTreeSettings settings = ExtendedOptions();
        const std::string why = messageOf<openvdb::ValueError>(
            [&] { setting.set(settings, "x" + std::string(100000, 'x')); });
        EXPECT_TRUE(mentions(why, "x")) << setting.name;
        EXPECT_LT(why.size(), 400u) << setting.name;
        for (const std::string& choice : setting.choices) EXPECT_TRUE(mentions(why, choice));
    }
}

TEST(SettingsTable, WhatATreeHasIsRecordedAndNotWhatWasAskedFor)
{
    SphereTree tree;
    ExtendedOptions options;
    options.dag = true;
    tree.settings = options;
    EXPECT_EQ(settingNamed("dag").get(recordedSettings(tree)), "0");
    tree.hasDag = true;
    EXPECT_EQ(settingNamed("dag").get(recordedSettings(tree)), "1");
    tree.settings = TightOptions();
    tree.hasCuts = true;
    EXPECT_EQ(settingNamed("cuts").get(recordedSettings(tree)), "1");
    settingNamed("distance").set(tree.settings, "2vox");
    tree.transform = openvdb::math::Transform::createLinearTransform(0.25);
    EXPECT_EQ(settingNamed("distance").get(recordedSettings(tree)), "0.5") << "world units";
}
