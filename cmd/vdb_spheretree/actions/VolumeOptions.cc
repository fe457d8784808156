// SPDX-License-Identifier: Apache-2.0
#include "VolumeOptions.h"

#include "line/Plan.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/TextStream.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace command {

using openvdb_spheretree::NumberType;
using openvdb_spheretree::VolumeSettings;
using openvdb_spheretree::detail::parseNumber;

namespace {

template <typename Number>
std::vector<Number> numbersOf(const ActionCall& call, const std::string& option)
{
    std::vector<Number> numbers;
    openvdb_spheretree::detail::TextStream words(call.text(option));
    for (std::string word; std::getline(words, word, ',');) {
        const auto number = parseNumber<Number>(word);
        if (!number) return {};
        numbers.push_back(*number);
    }
    return numbers;
}

void checkSpacing(const ActionCall& call)
{
    const auto sides = numbersOf<double>(call, "spacing");
    const bool isEach = std::all_of(
        sides.begin(), sides.end(), [](double side) { return side >= 1e-30 && side <= 1e30; });
    if (isEach && (sides.size() == 1 || sides.size() == 3)) return;
    throwUsage("spacing=" + call.text("spacing")
        + ": the sides of a voxel along x, y, z are wanted, such as 0.5,0.5,1, or one number");
}

void checkShape(const ActionCall& call)
{
    const auto sides = numbersOf<uint64_t>(call, "shape");
    const bool isEach = std::all_of(
        sides.begin(), sides.end(), [](uint64_t side) { return side >= 1 && side <= 1 << 20; });
    if (isEach && (sides.size() == 2 || sides.size() == 3)) return;
    throwUsage("shape=" + call.text("shape")
        + ": how many numbers there are along x, y, z is wanted, such as 512,512,300");
}

OptionSpec withoutDefault(OptionSpec option)
{
    option.fallback.clear();
    return option;
}

} // namespace

void addVolumeOptions(ActionSpec& action)
{
    std::vector<std::string> types;
    for (int type = int(NumberType::Bool); type <= int(NumberType::Float64); ++type) {
        types.push_back(toString(NumberType(type)));
    }
    const std::vector<OptionSpec> options = {
        text("spacing", "",
            "volumes and pictures: the sides of a voxel along x, y, z, such as 0.5,0.5,1, or one "
            "number; in place of what the file says"),
        real("background", "0", -1e300, 1e300,
            "volumes and pictures, but for .vol: the value of empty voxels, and of all beyond the "
            "file; -1024 for most CT"),
        choice("axes", {"xyz", "zyx"},
            ".npy: whether the first index is x, as in OpenVDB's arrays, or z, as in stacks of "
            "slices"),
        text("shape", "",
            ".raw: how many numbers are along x, y, z, such as 512,512,300; x fastest"),
        withoutDefault(choice("type", types, ".raw: what numbers these are")),
        choice("endian", {"little", "big"}, ".raw: which byte of a number comes first"),
        integer(
            "header", "0", 0, int64_t(1) << 40, ".raw: how many bytes come before the numbers")};
    action.options.insert(action.options.end(), options.begin(), options.end());
}

void checkVolumeOptions(const ActionCall& call)
{
    const std::vector<std::string> files = call.list("files");
    const auto any = [&](const auto& isMeant) {
        return std::any_of(files.begin(), files.end(), isMeant);
    };
    const auto endsWith = [](const char* extension) {
        return [extension](const std::string& path) {
            return openvdb_spheretree::volumeExtension(path) == extension;
        };
    };
    const bool hasVolume = any(openvdb_spheretree::isVolumeFileName);
    const bool hasVol =
        any([](const std::string& path) { return fileKind(path) == FileKind::Vol; });
    if (call.given("spacing") && !hasVolume && !hasVol) {
        throwUsage("spacing is for volumes and pictures, and none is read; scale= is for all else");
    }
    if (call.given("background") && !hasVolume) {
        throwUsage("background is for volumes and pictures other than .vol, and none is read");
    }
    if (call.given("axes") && !any(endsWith(".npy"))) {
        throwUsage("axes is for arrays of a .npy, and none is read");
    }
    const bool hasRaw = any(endsWith(".raw"));
    for (const char* option : {"shape", "type", "endian", "header"}) {
        if (call.given(option) && !hasRaw) {
            throwUsage(std::string(option) + " is for numbers of a .raw, and none is read");
        }
    }
    if (hasRaw && !(call.given("shape") && call.given("type"))) {
        throwUsage("a .raw does not say what it holds: give its shape=X,Y,Z and its type, such as "
                   "type=uint8 or type=float32");
    }
    if (call.given("spacing")) checkSpacing(call);
    if (call.given("shape")) checkShape(call);
}

VolumeSettings volumeSettings(const ActionCall& call)
{
    VolumeSettings settings;
    if (call.given("spacing")) {
        const auto sides = numbersOf<double>(call, "spacing");
        settings.spacing = openvdb::Vec3d(sides.front());
        if (sides.size() == 3) settings.spacing = openvdb::Vec3d(sides.data());
    }
    settings.background = call.real("background");
    settings.zyx = call.text("axes") == "zyx";
    if (call.given("shape")) {
        auto sides = numbersOf<uint64_t>(call, "shape");
        sides.resize(3, 1);
        settings.shape = {sides[0], sides[1], sides[2]};
    }
    if (call.given("type")) {
        settings.type = openvdb_spheretree::numberTypeFromString(call.text("type"));
    }
    settings.bigEndian = call.text("endian") == "big";
    settings.headerBytes = uint64_t(call.integer("header"));
    return settings;
}

} // namespace command
