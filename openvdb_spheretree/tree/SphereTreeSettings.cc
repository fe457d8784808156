// SPDX-License-Identifier: Apache-2.0
#include "SphereTreeSettings.h"

#include <openvdb_spheretree/base/Memory.h>

#include <openvdb_spheretree/base/EnumNames.h>
#include <openvdb_spheretree/base/Memory.h>

#include <openvdb/Exceptions.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <system_error>

namespace openvdb_spheretree {

namespace {

using detail::fromName;
using detail::inQuotes;
using detail::Named;
using detail::nameOf;

constexpr std::array<Named<TreeType>, 3> kTreeTypes{{{TreeType::Reversible, "reversible"},
    {TreeType::Extended, "extended"}, {TreeType::Tight, "tight"}}};
constexpr std::array<Named<Quality>, 3> kQualities{
    {{Quality::Fast, "fast"}, {Quality::Normal, "normal"}, {Quality::Best, "best"}}};
constexpr std::array<Named<Cover>, 2> kCovers{{{Cover::Voxels, "voxels"}, {Cover::Balls, "balls"}}};
constexpr std::array<Named<Center>, 2> kCenters{
    {{Center::Medial, "medial"}, {Center::Miniball, "miniball"}}};
constexpr std::array<Named<Leaves>, 2> kLeaves{
    {{Leaves::Pruned, "pruned"}, {Leaves::Medial, "medial"}}};
constexpr std::array<Named<Side>, 2> kSides{{{Side::Outer, "outer"}, {Side::Inner, "inner"}}};
constexpr std::array<Named<ParentRule>, 2> kParentRules{
    {{ParentRule::Centre, "centre"}, {ParentRule::Dag, "dag"}}};
constexpr std::array<Named<Reconstruction>, 3> kReconstructions{{{Reconstruction::Clip, "clip"},
    {Reconstruction::Free, "free"}, {Reconstruction::None, "none"}}};
constexpr std::array<Named<RadiusScale>, 2> kRadiusScales{
    {{RadiusScale::Tight, "tight"}, {RadiusScale::Paper, "paper"}}};
constexpr std::array<Named<DagEdges>, 2> kDagEdges{
    {{DagEdges::Shared, "shared"}, {DagEdges::Intersecting, "intersecting"}}};

const std::string kClosing = "closing:";

/// A unit of memory, as small letters, and its bytes.
struct MemoryUnit {
    const char* name;
    double bytes;
};
constexpr double kKiB = 1024, kMiB = 1024 * kKiB, kGiB = 1024 * kMiB, kTiB = 1024 * kGiB;
constexpr std::array<MemoryUnit, 14> kMemoryUnits{{{"", 1}, {"b", 1}, {"kb", 1e3}, {"mb", 1e6},
    {"gb", 1e9}, {"tb", 1e12}, {"kib", kKiB}, {"mib", kMiB}, {"gib", kGiB}, {"tib", kTiB},
    {"k", kKiB}, {"m", kMiB}, {"g", kGiB}, {"t", kTiB}}};

/// @return the bytes of so many units; NaN if there is no such unit, or no such share.
double bytesOf(double value, std::string unit)
{
    if (unit == "%") return value > 100 ? std::nan("") : value / 100 * detail::physicalMemory();
    for (char& c : unit) c = char(std::tolower(static_cast<unsigned char>(c)));
    for (const MemoryUnit& entry : kMemoryUnits) {
        if (unit == entry.name) return value * entry.bytes;
    }
    return std::nan("");
}

/// A setting that would change nothing is a mistake: whoever made it expects something of it.
void refusePyramidSetting(bool given, const std::string& what)
{
    if (!given) return;
    OPENVDB_THROW(openvdb::ValueError,
        what << " is for tree=extended and tree=reversible, not for tree=tight, which has no "
                "pyramid: leave it out, or choose one of these");
}

/// What only the trees of the pyramid know.
void refusePyramidSettings(const SphereTreeSettings& settings)
{
    const SphereTreeSettings usual;
    refusePyramidSetting(
        settings.factor != usual.factor, "factor=" + std::to_string(settings.factor));
    refusePyramidSetting(
        settings.closing != 0 || settings.customModel, "model=" + modelToString(settings));
    refusePyramidSetting(
        settings.parent != usual.parent, std::string("parent=") + toString(settings.parent));
    refusePyramidSetting(settings.finalFit != usual.finalFit, "final_fit=0");
    refusePyramidSetting(settings.reconstruct != usual.reconstruct,
        std::string("reconstruct=") + toString(settings.reconstruct));
    refusePyramidSetting(
        settings.scale != usual.scale, std::string("scale=") + toString(settings.scale));
    refusePyramidSetting(
        settings.edges != usual.edges, std::string("edges=") + toString(settings.edges));
}

void requireTightSettings(const SphereTreeSettings& settings)
{
    refusePyramidSettings(settings);
    if (!settings.dist.isEuclidean()) {
        OPENVDB_THROW(openvdb::ValueError,
            "tree=tight is for dist=l2, not for dist=" << toString(settings.dist)
                                                       << ": use tree=extended or tree=reversible");
    }
    if (settings.center == Center::Miniball) {
        OPENVDB_THROW(openvdb::ValueError,
            "center=miniball is for reversible and extended trees: the centres of tree=tight are "
            "better than that already");
    }
    if (settings.dag) {
        OPENVDB_THROW(openvdb::ValueError,
            "tree=tight has no Sphere-DAG: use tree=extended or tree=reversible with dag=1");
    }
    if (settings.quality == Quality::Best && settings.cuts) {
        OPENVDB_THROW(openvdb::ValueError,
            "quality=best and cuts=1 contradict each other: best searches the levels that are "
            "named, and cuts keep every number of spheres; use quality=normal");
    }
}

void requireMiniballSettings(const SphereTreeSettings& settings)
{
    if (settings.center != Center::Miniball) return;
    if (!settings.dist.isEuclidean()) {
        OPENVDB_THROW(openvdb::ValueError,
            "center=miniball is for dist=l2, not for dist=" << toString(settings.dist)
                                                            << ": use center=medial");
    }
    if (settings.tree == TreeType::Extended && !settings.finalFit) {
        OPENVDB_THROW(openvdb::ValueError,
            "center=miniball and final_fit=0 contradict each other: the first stores the smallest "
            "spheres there are, the second larger ones than need be");
    }
}

void requireInnerSettings(const SphereTreeSettings& settings)
{
    if (settings.side != Side::Inner || !settings.budget.hasBound()) return;
    OPENVDB_THROW(openvdb::ValueError,
        "side=inner and a bound on the error or the distance contradict each other: inner spheres "
        "reach nowhere outside, and cover what their number allows; use spheres or branching");
}

} // namespace

double SphereTreeSettings::paddingVoxels() const
{
    return padding == kPadCubes ? dist.length(0.5, 0.5, dim == 3 ? 0.5 : 0) / dist.unit() : padding;
}

void SphereTreeSettings::validate() const
{
    requireFactor(factor);
    requireDim(dim);
    if (flatAxis < 0 || flatAxis > 2) {
        OPENVDB_THROW(openvdb::ValueError,
            "the flat axis " << flatAxis << " is out of range: it must be 0, 1 or 2");
    }
    requireClosing(closing);
    if (customModel && closing > 0) {
        OPENVDB_THROW(openvdb::ValueError,
            "closing and customModel are both set: choose one of these pyramid models");
    }
    budget.validate();
    if (tree == TreeType::Tight) {
        requireTightSettings(*this);
    } else if (!budget.empty() || cuts || side == Side::Inner) {
        OPENVDB_THROW(openvdb::ValueError,
            "spheres, branching, error, distance, cuts and side=inner are for tree=tight, not for "
            "tree="
                << toString(tree));
    }
    requireMiniballSettings(*this);
    requireInnerSettings(*this);
    if (memory < 0) {
        OPENVDB_THROW(openvdb::ValueError,
            "memory=" << memory << " is out of range: it must be a number of bytes, or 0 for "
                      << memoryToString(0) << " of the machine's memory");
    }
    if (padding != kPadCubes && !(padding >= 0 && padding <= kMaxPadding)) {
        OPENVDB_THROW(openvdb::ValueError,
            "padding=" << padding
                       << " is out of range: it must be cubes, voxels, or a number of voxels from "
                          "0 to "
                       << kMaxPadding);
    }
}

const char* toString(TreeType value) { return nameOf(kTreeTypes, value); }
const char* toString(ParentRule value) { return nameOf(kParentRules, value); }
const char* toString(Reconstruction value) { return nameOf(kReconstructions, value); }
const char* toString(RadiusScale value) { return nameOf(kRadiusScales, value); }
const char* toString(DagEdges value) { return nameOf(kDagEdges, value); }
const char* toString(Quality value) { return nameOf(kQualities, value); }
const char* toString(Cover value) { return nameOf(kCovers, value); }
const char* toString(Center value) { return nameOf(kCenters, value); }
const char* toString(Leaves value) { return nameOf(kLeaves, value); }
const char* toString(Side value) { return nameOf(kSides, value); }

std::string paddingToString(double padding)
{
    if (padding == SphereTreeSettings::kPadCubes) return "cubes";
    if (padding == 0) return "voxels";
    std::array<char, 32> text; // the shortest text of a double is at most 24 characters
    const auto end = std::to_chars(text.data(), text.data() + text.size(), padding).ptr;
    return std::string(text.data(), end);
}

std::string memoryToString(int64_t memory)
{
    if (memory == 0) return std::to_string(int(100 * detail::kMemoryShare)) + '%';
    constexpr std::array<Named<int64_t>, 4> kUnits{{{int64_t(1) << 40, "TiB"},
        {int64_t(1) << 30, "GiB"}, {int64_t(1) << 20, "MiB"}, {int64_t(1) << 10, "KiB"}}};
    for (const auto& unit : kUnits) {
        if (memory % unit.value == 0) return std::to_string(memory / unit.value) + unit.name;
    }
    return std::to_string(memory);
}

std::string modelToString(const SphereTreeSettings& settings)
{
    if (settings.customModel || settings.hadCustomModel) return "custom";
    return settings.closing == 0 ? "or" : kClosing + std::to_string(settings.closing);
}

TreeType treeTypeFromString(const std::string& text) { return fromName(kTreeTypes, "tree", text); }

ParentRule parentRuleFromString(const std::string& text)
{
    return fromName(kParentRules, "parent", text);
}

Reconstruction reconstructionFromString(const std::string& text)
{
    return fromName(kReconstructions, "reconstruct", text);
}

RadiusScale radiusScaleFromString(const std::string& text)
{
    return fromName(kRadiusScales, "scale", text);
}

DagEdges dagEdgesFromString(const std::string& text) { return fromName(kDagEdges, "edges", text); }

Quality qualityFromString(const std::string& text) { return fromName(kQualities, "quality", text); }

Cover coverFromString(const std::string& text) { return fromName(kCovers, "cover", text); }

Center centerFromString(const std::string& text) { return fromName(kCenters, "center", text); }

Leaves leavesFromString(const std::string& text) { return fromName(kLeaves, "leaves", text); }

Side sideFromString(const std::string& text) { return fromName(kSides, "side", text); }

double paddingFromString(const std::string& text)
{
    if (text == "cubes") return SphereTreeSettings::kPadCubes;
    if (text == "voxels") return 0;
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    // A negative number is refused even where it happens to be the code for cubes.
    if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value) || value < 0) {
        OPENVDB_THROW(openvdb::ValueError,
            "padding=" << inQuotes(text)
                       << " is unknown: choose cubes, voxels, or a number of voxels of 0 or more");
    }
    return std::abs(value); // -0 is 0
}

int64_t memoryFromString(const std::string& text)
{
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    const std::string unit(parsed.ptr, end);
    if (parsed.ec == std::errc() && unit == "%" && value == 100 * detail::kMemoryShare) return 0;
    const double bytes = parsed.ec == std::errc() ? bytesOf(value, unit) : std::nan("");
    if (bytes >= 1 && bytes < double(INT64_MAX)) return int64_t(bytes);
    const char* what = std::isnan(bytes) ? "unknown" : bytes < 1 ? "too little" : "too much";
    OPENVDB_THROW(openvdb::ValueError,
        "memory=" << inQuotes(text) << " is " << what
                  << ": choose a number of bytes such as 4GiB, 500MB or 4e9, or a share of the "
                     "machine's memory, above 0% and up to 100%, such as 75%");
}

int closingFromString(const std::string& text)
{
    if (text == "or") return 0;
    int radius = 0;
    const char* const end = text.data() + text.size();
    const bool named = text.compare(0, kClosing.size(), kClosing) == 0;
    const auto parsed = std::from_chars(text.data() + (named ? kClosing.size() : 0), end, radius);
    if (!named || parsed.ec != std::errc() || parsed.ptr != end || radius < 1
        || radius > kMaxClosing) {
        OPENVDB_THROW(openvdb::ValueError,
            "model=" << inQuotes(text)
                     << " is unknown: choose or, or closing:R with a radius R of 1 to "
                     << kMaxClosing << " voxels");
    }
    return radius;
}

} // namespace openvdb_spheretree
