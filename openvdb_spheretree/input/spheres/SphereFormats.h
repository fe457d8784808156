// SPDX-License-Identifier: Apache-2.0
/// @file SphereFormats.h
/// @brief Strict readers of single formats, and the list that they fill.

#pragma once

#include "WorldSpheres.h"

#include <array>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace openvdb_spheretree::detail {

/// What a column or a member is.
enum class SphereField { X, Y, Z, Radius, Diameter, Level, None };
constexpr int kSphereFields = 6;

/// @return what is named so, in any case.
SphereField sphereFieldOf(std::string_view name);

/// The numbers of one sphere as a file has them.
struct SphereEntry {
    std::array<std::optional<double>, kSphereFields> values;

    std::optional<double>& operator[](SphereField field) { return values[std::size_t(field)]; }
    /// @return whether it has anything of a sphere.
    bool any() const;
};

/// Spheres as they are read.
class SphereList {
public:
    /// @throw openvdb::IoError without the place, if a number is missing, not finite, or no radius
    void add(SphereEntry& entry);
    std::size_t size() const { return mSpheres.size(); }
    /// @return the spheres of the level; of the finest, if none is given.
    /// @throw openvdb::IoError if there are none
    WorldSpheres take(std::optional<int> level);

private:
    WorldSpheres mSpheres;
    std::vector<int32_t> mLevels; ///< empty, or one a sphere
};

/// @name Formats
/// @throw openvdb::IoError without the name of the file
/// @{
/// @return what was taken for granted.
std::string parseSphereCsv(std::istream& in, SphereList& spheres);
void parseSphereJson(std::istream& in, SphereList& spheres);
/// @}

} // namespace openvdb_spheretree::detail
