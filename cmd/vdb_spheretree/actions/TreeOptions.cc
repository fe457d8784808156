// SPDX-License-Identifier: Apache-2.0
#include "TreeOptions.h"

#include "line/Length.h"
#include "line/Plan.h"

#include <openvdb_spheretree/tree/SettingsTable.h>

namespace command {

namespace spheretree = openvdb_spheretree;
using spheretree::SphereTreeSettings;
using spheretree::detail::Setting;
using spheretree::detail::SettingType;

namespace {

OptionSpec optionOf(const Setting& setting)
{
    OptionSpec option{setting.name, OptionKind::Text, setting.fallback, setting.help,
        setting.lowest, setting.highest, setting.choices};
    option.isPercent = setting.name == "error";
    switch (setting.type) {
    case SettingType::Choice: option.kind = OptionKind::Choice; break;
    case SettingType::Flag: option.kind = OptionKind::Flag; break;
    case SettingType::Integer: option.kind = OptionKind::Integer; break;
    case SettingType::Real: option.kind = OptionKind::Real; break;
    case SettingType::Length: option.doc += "; or 5mm, if -read has units="; break;
    default: break;
    }
    return option;
}

/// An option that would change nothing is an error: the user expects that it does.
void refuse(const ActionCall& call, const std::string& option, const std::string& why)
{
    if (!call.given(option)) return;
    throwUsage(option + "=" + call.text(option) + " " + why);
}

/// An option of either kind of pyramid tree is accepted for both.
void refuseOptionsOfOtherTrees(const ActionCall& call)
{
    const std::string tree = call.text("tree");
    const bool tight = tree == "tight", inner = tight && call.text("side") == "inner",
               fit = tight && call.text("side") == "fit";
    for (const Setting& setting : spheretree::detail::settingsTable()) {
        const bool isForTight = setting.tight || setting.inner || setting.fit;
        if (tight && !isForTight) {
            refuse(
                call, setting.name, "is for tree=extended and tree=reversible, not for tree=tight");
        } else if (!tight && !setting.isForPyramids()) {
            refuse(call, setting.name, "is for tree=tight, not for tree=" + tree);
        } else if (inner && (!setting.inner || setting.isBound)) {
            refuse(call, setting.name, "is for spheres that cover the object, not for side=inner");
        } else if (fit && !setting.fit) {
            const bool isForInner = setting.inner && !setting.isBound;
            const std::string other = !setting.tight ? "side=inner"
                : isForInner ? "spheres that cover the object or lie inside it"
                             : "spheres that cover the object";
            refuse(call, setting.name, "is for " + other + ", not for side=fit");
        } else if (tight && !inner && !fit && !setting.tight) {
            refuse(call, setting.name, "is for side=inner, not for spheres that cover the object");
        }
    }
    if (fit) {
        refuse(call, "padding",
            "would make spheres larger, and those of side=fit are the nearest ones as they are: "
            "leave "
            "it out");
    }
    if (!inner) return;
    refuse(call, "padding",
        "would make spheres stick out of the object, and those of side=inner lie inside: leave it "
        "out");
}

} // namespace

std::vector<OptionSpec> spheretreeOptions()
{
    std::vector<OptionSpec> options;
    for (const Setting& setting : spheretree::detail::settingsTable()) {
        if (setting.name == "name") {
            options.push_back(
                flag("errors", true, "count the exact error of every level, and store it"));
            options.push_back(choice("empty", {"fail", "skip", "write"},
                "where there is no voxel to make a tree of: an error; or what follows is not done; "
                "or it "
                "writes files without spheres"));
            options.push_back(flag("samevoxels", true,
                "of a sequence of files: a frame whose voxels are larger or smaller than those of "
                "the frames "
                "before is an error"));
            options.push_back(text("like", "",
                "a tree of the frame before, where spheres start and whose tracks (numbers) they "
                "keep: "
                "previous is the last one of the same name that this line has built; or its age on "
                "the stack or name"));
            options.push_back(vdbOption("the grid"));
            options.push_back(keepOption());
        }
        options.push_back(optionOf(setting));
    }
    return options;
}

SphereTreeSettings settingsOf(const ActionCall& call)
{
    SphereTreeSettings settings =
        spheretree::detail::settingsOfKind(call.text("tree"), call.text("side"));
    for (const Setting& setting : spheretree::detail::settingsTable()) {
        if (setting.name == "tree" || setting.name == "side" || !call.given(setting.name)) continue;
        std::string value = call.text(setting.name);
        if (setting.type == SettingType::Flag) value = call.flag(setting.name) ? "1" : "0";
        if (setting.type == SettingType::Length) {
            const auto length = parseLength(value);
            if (length) value = spheretree::detail::textOf(length->metres);
        }
        setting.set(settings, value);
    }
    return settings;
}

LongWork longWorkOf(const ActionCall& call)
{
    if (call.text("tree") != "tight" || call.text("side") == "inner") return {};
    if (call.text("side") == "fit") return {"nearest spheres", 1, ""};
    LongWork work{"levels", 1, ""};
    if (call.text("quality") != "fast") {
        work.advice = "faster than quality=" + call.text("quality")
            + ": quality=fast, and an object of fewer voxels (for up to a hundred spheres some 64 "
              "along its longest side are enough)";
    }
    return work;
}

void checkTreeOptions(const ActionCall& call, Plan& plan)
{
    refuseOptionsOfOtherTrees(call);
    plan.requireKnownUnit("distance", call.text("distance"));
    if (call.given("edges") && !call.flag("dag")) {
        throwUsage("edges=" + call.text("edges")
            + " says which edges of the Sphere-DAG to store, and none are: add dag=1");
    }
    if (call.given("bounds") && !call.given("error") && !call.given("distance")) {
        throwUsage("-spheretree bounds=" + call.text("bounds")
            + " says what a bound is of, and there is none: add error= or distance=");
    }
    settingsOf(call).validate();
}

} // namespace command
