// SPDX-License-Identifier: Apache-2.0
#include "SphereTreeSettings.h"

#include "SettingsTable.h"
#include <openvdb_spheretree/base/EnumNames.h>
#include <openvdb_spheretree/base/Memory.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

namespace openvdb_spheretree {

namespace {

using detail::inQuotes;
using detail::Named;

const std::string kClosing = "closing:";

/// Units of memory in small letters, and their bytes.
constexpr double kKiB = 1024, kMiB = 1024 * kKiB, kGiB = 1024 * kMiB, kTiB = 1024 * kGiB;
constexpr std::pair<const char*, double> kMemoryUnits[] = {{"", 1}, {"b", 1}, {"kb", 1e3},
    {"mb", 1e6}, {"gb", 1e9}, {"tb", 1e12}, {"kib", kKiB}, {"mib", kMiB}, {"gib", kGiB},
    {"tib", kTiB}, {"k", kKiB}, {"m", kMiB}, {"g", kGiB}, {"t", kTiB}};

/// @return the bytes of so many units; NaN if there is no such unit, or no such share.
double bytesOf(double value, std::string unit)
{
    if (unit == "%") return value > 100 ? std::nan("") : value / 100 * detail::physicalMemory();
    for (char& c : unit) c = char(std::tolower(static_cast<unsigned char>(c)));
    for (const auto& [name, bytes] : kMemoryUnits) {
        if (unit == name) return value * bytes;
    }
    return std::nan("");
}

void requireValid(const PyramidOptions& options, bool fitted)
{
    requireFactor(options.factor);
    requireClosing(options.closing);
    if (options.customModel && options.closing > 0) {
        OPENVDB_THROW(openvdb::ValueError,
            "closing and customModel are both set: choose one of these pyramid models");
    }
    if (options.origin && ((*options.origin & 7) != openvdb::Coord(0))) {
        OPENVDB_THROW(openvdb::ValueError,
            "origin=" << originToString(options.origin)
                      << " is out of range: its coordinates must be multiples of 8");
    }
    if (options.center != Center::Miniball) return;
    if (!options.dist.isEuclidean()) {
        OPENVDB_THROW(openvdb::ValueError,
            "center=miniball is for dist=l2, not for dist=" << toString(options.dist)
                                                            << ": use center=medial");
    }
    if (!fitted) {
        OPENVDB_THROW(openvdb::ValueError,
            "center=miniball and final_fit=0 contradict each other: the first stores the smallest "
            "spheres there are, the second larger ones than need be");
    }
}

/// What spheres with side=fit cannot be asked for.
void requireFit(const SphereBudget& budget, bool cuts, double padding)
{
    if (padding > 0) {
        OPENVDB_THROW(openvdb::ValueError,
            "side=fit and padding="
                << paddingToString(padding)
                << " contradict each other: its spheres are the nearest ones as "
                   "they are stored, and larger ones are not; leave padding out");
    }
    if (budget.distance) {
        OPENVDB_THROW(openvdb::ValueError,
            "side=fit and distance="
                << distanceBoundToString(budget)
                << " contradict each other: its spheres are sought by the voxels that are wrong, "
                   "not "
                   "by how far they reach; use error=, spheres= or branching=");
    }
    if (cuts) {
        OPENVDB_THROW(openvdb::ValueError,
            "side=fit and cuts=1 contradict each other: every number of spheres is searched by "
            "itself; name those wanted with spheres=");
    }
}

/// Stands for the custom model of a tree that was read from a file.
struct UnknownModel {
    openvdb::MaskTree::Ptr operator()(const openvdb::MaskTree&, const PyramidStep&) const
    {
        OPENVDB_THROW(openvdb::ValueError,
            "the tree was built with a custom pyramid model, which no file holds: set customModel");
    }
};

} // namespace

bool isUnknown(const PyramidModel& model) { return model.target<UnknownModel>() != nullptr; }

PyramidModel unknownModel() { return UnknownModel(); }

TreeType SphereTreeSettings::type() const
{
    if (isGiven()) return TreeType::Given;
    if (find<ExtendedOptions>()) return TreeType::Extended;
    return find<ReversibleOptions>() ? TreeType::Reversible : TreeType::Tight;
}

void SphereTreeSettings::throwOtherKind(const char* wanted)
{
    OPENVDB_THROW(
        openvdb::ValueError, "these are not the settings of the kind of tree wanted: " << wanted);
}

const Distance& SphereTreeSettings::dist() const
{
    static const Distance kEuclidean;
    const auto* options = find<PyramidOptions>();
    return options ? options->dist : kEuclidean;
}

double SphereTreeSettings::paddingVoxels() const
{
    if (isInner() || isFit() || isGiven()) return 0;
    if (padding != kPadCubes) return padding;
    return dist().length(0.5, 0.5, dim == 3 ? 0.5 : 0) / dist().unit();
}

void SphereTreeSettings::validate() const
{
    requireDim(dim);
    if (dist().isFlat() && dim != 2) {
        OPENVDB_THROW(openvdb::ValueError,
            "dist=" << toString(dist())
                    << " is for a plane (dim=2): in space it lacks the cost of a step across a "
                       "corner, as of chamfer:3,4,5");
    }
    const auto* extended = find<ExtendedOptions>();
    if (const auto* pyramid = find<PyramidOptions>()) {
        requireValid(*pyramid, /*fitted=*/!extended || extended->finalFit);
    }
    const auto* levels = find<BudgetOptions>();
    if (levels) levels->budget.validate();
    const auto* tight = find<TightOptions>();
    if (tight && tight->quality == Quality::Best && tight->cuts) {
        OPENVDB_THROW(openvdb::ValueError,
            "quality=best and cuts=1 contradict each other: best searches the levels that are "
            "named, and cuts keep every number of spheres; use quality=normal");
    }
    if (isInner() && levels->budget.hasBound()) {
        OPENVDB_THROW(openvdb::ValueError,
            "side=inner and a bound on the error or the distance contradict each other: inner "
            "spheres reach nowhere outside, and cover what their number allows; use spheres or "
            "branching");
    }
    if (isFit()) requireFit(levels->budget, levels->cuts, padding);
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

std::string paddingToString(double padding)
{
    if (padding == SphereTreeSettings::kPadCubes) return "cubes";
    return padding == 0 ? "voxels" : detail::textOf(padding);
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

std::string modelToString(const PyramidOptions& options)
{
    if (options.customModel) return "custom";
    return options.closing == 0 ? "or" : kClosing + std::to_string(options.closing);
}

double paddingFromString(const std::string& text)
{
    if (text == "cubes") return SphereTreeSettings::kPadCubes;
    if (text == "voxels") return 0;
    const auto value = detail::parseNumber<double>(text);
    // A negative number is refused even where it happens to be the code for cubes.
    if (!value || !std::isfinite(*value) || *value < 0) {
        OPENVDB_THROW(openvdb::ValueError,
            "padding=" << inQuotes(text)
                       << " is unknown: choose cubes, voxels, or a number of voxels of 0 or more");
    }
    return std::abs(*value); // -0 is 0
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

std::optional<openvdb::Coord> originFromString(const std::string& text)
{
    if (text.empty()) return {};
    openvdb::Coord origin;
    std::string_view rest = text;
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t end = axis < 2 ? rest.find(',') : rest.size();
        const auto number =
            end == rest.npos ? std::nullopt : detail::parseNumber<int32_t>(rest.substr(0, end));
        if (!number || *number % 8 != 0) {
            OPENVDB_THROW(openvdb::ValueError,
                "origin=" << inQuotes(text)
                          << " is unknown: it takes a voxel's three coordinates, multiples of 8, "
                             "such as 0,0,0");
        }
        origin[axis] = *number;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return origin;
}

std::string originToString(const std::optional<openvdb::Coord>& origin)
{
    if (!origin) return {};
    return std::to_string((*origin)[0]) + ',' + std::to_string((*origin)[1]) + ','
        + std::to_string((*origin)[2]);
}

int closingFromString(const std::string& text)
{
    if (text == "or") return 0;
    std::optional<int> radius;
    if (text.compare(0, kClosing.size(), kClosing) == 0) {
        radius = detail::parseNumber<int>(text.substr(kClosing.size()));
    }
    if (!radius || *radius < 1 || *radius > kMaxClosing) {
        OPENVDB_THROW(openvdb::ValueError,
            "model=" << inQuotes(text)
                     << " is unknown: choose or, or closing:R with a radius R of 1 to "
                     << kMaxClosing << " voxels");
    }
    return *radius;
}

} // namespace openvdb_spheretree
