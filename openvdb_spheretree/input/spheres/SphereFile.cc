// SPDX-License-Identifier: Apache-2.0
#include "SphereFile.h"

#include "SphereFormats.h"
#include <openvdb_spheretree/base/RegularFile.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

namespace openvdb_spheretree {

namespace detail {

namespace {

constexpr const char* kFieldNames[kSphereFields] = {"x", "y", "z", "radius", "diameter", "level"};

} // namespace

SphereField sphereFieldOf(std::string_view name)
{
    constexpr std::size_t kLongest = 8; // whatever is longer needs no copy
    if (name.size() > kLongest) return SphereField::None;
    const std::string lower = lowerCase(name);
    if (lower == "r") return SphereField::Radius;
    if (lower == "d") return SphereField::Diameter;
    for (int field = 0; field < kSphereFields; ++field) {
        if (lower == kFieldNames[field]) return SphereField(field);
    }
    return SphereField::None;
}

bool SphereEntry::any() const
{
    const auto isThere = [](const auto& value) { return value.has_value(); };
    return std::any_of(values.begin(), values.begin() + int(SphereField::Level), isThere);
}

void SphereList::add(SphereEntry& entry)
{
    const auto fail = [](const std::string& what) { throw openvdb::IoError(what); };
    auto& radius = entry[SphereField::Radius];
    const auto diameter = entry[SphereField::Diameter];
    if (radius && diameter) fail("there is a radius and a diameter: leave one out");
    if (diameter) radius = *diameter / 2;
    for (const SphereField field :
        {SphereField::X, SphereField::Y, SphereField::Z, SphereField::Radius}) {
        const char* const name = kFieldNames[int(field)];
        if (!entry[field]) fail(std::string("there is no ") + name);
        if (!std::isfinite(*entry[field])) fail(std::string(name) + " is not finite");
    }
    if (!(*radius > 0)) {
        fail("the radius " + shortNumber(*radius)
            + " is not above 0: spheres of trees without padding may be points, of which the "
              ".vdb is read alone");
    }
    if (mSpheres.size() >= std::size_t(std::numeric_limits<int32_t>::max())) {
        fail("there are more than the 2^31 - 1 spheres that can be numbered");
    }
    const auto level = entry[SphereField::Level];
    if (level.has_value() != !mLevels.empty() && mSpheres.size() > 0) {
        fail("some spheres have a level, and some have none");
    }
    if (level) {
        constexpr double kMost = 1000; // as many as -level takes
        if (!(*level >= 0 && *level <= kMost && *level == std::floor(*level))) {
            fail("the level is no whole number from 0 to 1000");
        }
        mLevels.push_back(int32_t(*level));
    }
    mSpheres.center.emplace_back(
        *entry[SphereField::X], *entry[SphereField::Y], *entry[SphereField::Z]);
    mSpheres.radius.push_back(*radius);
}

WorldSpheres SphereList::take(std::optional<int> level)
{
    if (mSpheres.size() == 0) throw openvdb::IoError("the file holds no sphere");
    if (mLevels.empty()) {
        if (level) throw openvdb::IoError("level: the file's spheres have no levels");
        return std::move(mSpheres);
    }
    const auto [lowest, highest] = std::minmax_element(mLevels.begin(), mLevels.end());
    const int32_t taken = level.value_or(*lowest);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mLevels.size(); ++i) {
        if (mLevels[i] != taken) continue;
        mSpheres.center[kept] = mSpheres.center[i];
        mSpheres.radius[kept++] = mSpheres.radius[i];
    }
    if (kept == 0) {
        throw openvdb::IoError("level=" + std::to_string(taken)
            + ": no sphere of the file has this level; the file has levels from "
            + std::to_string(*lowest) + " to " + std::to_string(*highest));
    }
    mSpheres.center.resize(kept);
    mSpheres.radius.resize(kept);
    if (!level && *lowest != *highest) {
        mSpheres.assumption = "of the levels " + std::to_string(*lowest) + " to "
            + std::to_string(*highest) + " that its spheres have, level " + std::to_string(taken)
            + " is taken (level= takes another)";
    }
    return std::move(mSpheres);
}

} // namespace detail

bool isSphereFileName(const std::string& path)
{
    const std::string extension = detail::lowerExtension(path);
    return extension == ".csv" || extension == ".json";
}

WorldSpheres readSphereFile(
    const std::string& path, std::optional<int> level, const std::string& shownAs)
{
    const std::string& name = shownAs.empty() ? path : shownAs;
    std::ifstream file = detail::openRegularFile(path, name, "a file of spheres");
    try {
        detail::SphereList list;
        std::string assumption;
        if (detail::lowerExtension(name) == ".json") detail::parseSphereJson(file, list);
        else assumption = detail::parseSphereCsv(file, list);
        WorldSpheres spheres = list.take(level);
        spheres.name = std::filesystem::path(name).stem().string();
        if (!assumption.empty()) spheres.assumption = assumption;
        if (!spheres.assumption.empty()) spheres.assumption = name + ": " + spheres.assumption;
        return spheres;
    } catch (const openvdb::IoError& error) {
        throw openvdb::IoError(name + ": " + detail::messageOf(error));
    } catch (const std::ios_base::failure& error) {
        throw openvdb::IoError(name + ": cannot be read: " + error.code().message());
    }
}

} // namespace openvdb_spheretree
