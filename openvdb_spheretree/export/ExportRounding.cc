// SPDX-License-Identifier: Apache-2.0
#include "ExportRounding.h"

#include <openvdb_spheretree/base/Rounding.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace openvdb_spheretree::detail {

namespace {

constexpr int kMostDecimals = 22; ///< 10^22 is the largest power of ten that is a double
constexpr double kExact =
    0x1p52; ///< whole numbers up to here are doubles, and so are their neighbours

double powerOfTen(int exponent)
{
    double power = 1;
    for (int i = 0; i < exponent; ++i) power *= 10;
    return power;
}

float requireFloat(float value)
{
    if (std::isfinite(value)) return value;
    OPENVDB_THROW(openvdb::ValueError,
        "a sphere is too far away or too large for the floats of this format: use another scale or "
        "frame");
}

} // namespace

SphereRounding::SphereRounding(ExportNumbers numbers, int decimals, KeepSphere keep)
    : mNumbers(numbers), mKeep(keep), mUnits(powerOfTen(decimals))
{}

/// A quotient of two whole doubles is what a reader of its decimals gets: both are the double nearest to it.
double SphereRounding::roundCoordinate(double value) const
{
    switch (mNumbers) {
    case ExportNumbers::Float: return double(requireFloat(float(value)));
    case ExportNumbers::Double: return value;
    default: return std::nearbyint(value * mUnits) / mUnits + 0.0; // no -0
    }
}

double SphereRounding::roundUp(double radius) const
{
    switch (mNumbers) {
    case ExportNumbers::Float: return double(requireFloat(toFloatUp(radius)));
    case ExportNumbers::Double: return radius;
    default: break;
    }
    double units = std::ceil(radius * mUnits);
    while (units / mUnits < radius) units += 1;
    return units / mUnits;
}

double SphereRounding::roundDown(double radius) const
{
    switch (mNumbers) {
    case ExportNumbers::Float: return double(toFloatDown(radius));
    case ExportNumbers::Double: return radius;
    default: break;
    }
    double units = std::floor(radius * mUnits);
    while (units > 0 && units / mUnits > radius) units -= 1;
    return units / mUnits;
}

RoundedSphere SphereRounding::operator()(
    const openvdb::Vec3d& center, double radius, double slack) const
{
    RoundedSphere rounded;
    double movedSq = 0;
    for (int axis = 0; axis < 3; ++axis) {
        rounded.center[axis] = roundCoordinate(center[axis]);
        const double moved = rounded.center[axis] - center[axis];
        movedSq = addUp(movedSq, multiplyUp(moved, moved));
    }
    if (!std::isfinite(movedSq) || !std::isfinite(radius)) {
        OPENVDB_THROW(openvdb::ValueError, "a sphere has a number that is not finite");
    }
    // The difference of two numbers that are near each other is exact.
    const double moved = addUp(sqrtUp(movedSq), slack);
    switch (mKeep) {
    case KeepSphere::Covered: rounded.radius = roundUp(addUp(radius, moved)); break;
    case KeepSphere::Inside:
        rounded.radius = std::max(0.0, roundDown(-addUp(-radius, moved)));
        break;
    case KeepSphere::Nearest: rounded.radius = roundCoordinate(radius); break;
    }
    return rounded;
}

int decimalsFor(double smallestRadius, double largestNumber)
{
    int decimals = 0;
    while (decimals < kMostDecimals) {
        const double finer = powerOfTen(decimals + 1);
        if (largestNumber * finer > kExact) break;
        if (smallestRadius * powerOfTen(decimals) >= 1e6) break;
        ++decimals;
    }
    return decimals;
}

void requireDecimals(double largestNumber)
{
    if (largestNumber <= kExact) return;
    OPENVDB_THROW(openvdb::ValueError,
        "the largest coordinate or radius would be "
            << largestNumber << " in the file, where numbers are at most " << kExact
            << ": choose another scale= or units=");
}

} // namespace openvdb_spheretree::detail
