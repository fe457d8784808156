// SPDX-License-Identifier: Apache-2.0
#include "SphereBudget.h"

#include "SettingsTable.h"
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <system_error>

namespace openvdb_spheretree {

namespace {

const char kVoxels[] = "vox";

void requireBound(const char* name, const std::optional<double>& bound, const char* unit)
{
    if (!bound || (std::isfinite(*bound) && *bound >= 0)) return;
    OPENVDB_THROW(openvdb::ValueError,
        name << "=" << *bound << " is out of range: it must be a number of " << unit
             << ", 0 or more");
}

void requireCount(int64_t count)
{
    if (count >= 1 && count <= SphereBudget::kMaxSpheres) return;
    OPENVDB_THROW(openvdb::ValueError,
        "spheres=" << count << " is out of range: a level has 1 to " << SphereBudget::kMaxSpheres
                   << " spheres");
}

} // namespace

std::vector<int64_t> SphereBudget::counts(int64_t leaves) const
{
    std::vector<int64_t> result;
    if (!spheres.empty()) {
        for (const int64_t count : spheres) result.push_back(std::min(count, leaves));
    } else {
        const int64_t factor = branching ? branching : kDefaultBranching;
        for (int64_t count = 1; count < leaves; count *= factor) result.push_back(count);
        result.push_back(leaves);
    }
    std::sort(result.begin(), result.end(), std::greater<>());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

void SphereBudget::validate() const
{
    for (const int64_t count : spheres) requireCount(count);
    if (branching != 0 && (branching < 2 || branching > kMaxBranching)) {
        OPENVDB_THROW(openvdb::ValueError,
            "branching=" << branching << " is out of range: it must be 2 to " << kMaxBranching);
    }
    requireBound("error", error, "percent");
    requireBound("distance", distance, "world units");
    if (!spheres.empty() && branching != 0) {
        OPENVDB_THROW(openvdb::ValueError,
            "spheres=" << countsToString(spheres) << " and branching=" << branching
                       << " contradict each other: both say how many spheres levels have");
    }
    if (spheres.size() > 1 && hasBound()) {
        OPENVDB_THROW(openvdb::ValueError,
            "spheres=" << countsToString(spheres)
                       << " with a bound on the error: give one count, the most spheres allowed");
    }
}

std::string distanceBoundToString(const SphereBudget& budget)
{
    if (!budget.distance) return "";
    return detail::textOf(*budget.distance) + (budget.distanceInVoxels ? kVoxels : "");
}

void setDistanceBound(SphereBudget& budget, const std::string& text)
{
    budget.distance.reset();
    budget.distanceInVoxels = false;
    if (text.empty()) return;
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, value);
    const std::string unit(parsed.ptr, end);
    if (parsed.ec == std::errc() && (unit.empty() || unit == kVoxels)) {
        budget.distance = value;
        budget.distanceInVoxels = !unit.empty();
        return;
    }
    const bool isLength =
        unit == "m" || unit == "cm" || unit == "mm" || unit == "um" || unit == "in";
    if (parsed.ec == std::errc() && isLength) {
        OPENVDB_THROW(openvdb::ValueError,
            "distance=" << text << ": a grid does not say what its unit of length is, so " << unit
                        << " is not understood: write the number in the units of the file alone ("
                        << detail::textOf(value) << " if these are " << unit
                        << "), or voxels, such as 2vox");
    }
    OPENVDB_THROW(openvdb::ValueError,
        "distance=" << detail::inQuotes(text)
                    << " is no number: write world units, such as 5, or voxels, such as 2vox");
}

std::string countsToString(const std::vector<int64_t>& counts)
{
    std::string text;
    for (const int64_t count : counts) text += (text.empty() ? "" : ",") + std::to_string(count);
    return text;
}

std::vector<int64_t> countsFromString(const std::string& text)
{
    std::vector<int64_t> counts;
    const char *at = text.data(), *const end = at + text.size();
    while (true) {
        int64_t count = 0;
        const auto parsed = std::from_chars(at, end, count);
        const bool last = parsed.ptr == end;
        if (parsed.ec == std::errc::result_out_of_range) {
            OPENVDB_THROW(openvdb::ValueError,
                "spheres=" << detail::inQuotes(text) << " is out of range: a level has 1 to "
                           << SphereBudget::kMaxSpheres << " spheres, such as 8,64,512");
        }
        if (parsed.ec != std::errc() || (!last && *parsed.ptr != ',')) {
            OPENVDB_THROW(openvdb::ValueError,
                "spheres=" << detail::inQuotes(text)
                           << " is no list of counts: write numbers of 1 or more in digits, with "
                              "commas between them, such as 8,64,512");
        }
        requireCount(count);
        counts.push_back(count);
        if (last) return counts;
        at = parsed.ptr + 1;
    }
}

} // namespace openvdb_spheretree
