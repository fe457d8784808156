// SPDX-License-Identifier: Apache-2.0
/// @file ExportRounding.h
/// @brief Spheres rounded to the numbers of a file, so that what they promise still holds.

#pragma once

#include "ExportFormat.h"

#include <openvdb/Types.h>

namespace openvdb_spheretree::detail {

/// What a sphere that is written must do to the one that it stands for.
enum class KeepSphere {
    Covered, ///< contain it: spheres around an object
    Inside,  ///< lie in it: spheres inside an object
    Nearest  ///< neither: radii are rounded to nearest
};

struct RoundedSphere {
    openvdb::Vec3d center;
    double radius = 0;
};

class SphereRounding {
public:
    /// @param decimals  of ExportNumbers::Decimal
    SphereRounding(ExportNumbers numbers, int decimals, KeepSphere keep);

    /// @param slack  how far the center may be off already; it adds to what the radius gives way by
    /// @throw openvdb::ValueError if a number is not finite, or fits no float where it has to
    RoundedSphere operator()(const openvdb::Vec3d& center, double radius, double slack) const;

private:
    double roundCoordinate(double value) const;
    double roundUp(double radius) const;
    double roundDown(double radius) const;

    ExportNumbers mNumbers;
    KeepSphere mKeep;
    double mUnits; ///< 10^decimals
};

/// @brief Decimals with which rounding moves a sphere by less than a millionth of the smallest radius; fewer
/// where the largest coordinate would not fit a double any more.
/// @param smallestRadius  of those that are not 0
/// @param largestNumber   of all coordinates and radii
/// @return 0 to 22
int decimalsFor(double smallestRadius, double largestNumber);

/// @throw openvdb::ValueError if a number is too large to be written without an exponent, digit by digit: 2^52
void requireDecimals(double largestNumber);

} // namespace openvdb_spheretree::detail
