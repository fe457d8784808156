// SPDX-License-Identifier: Apache-2.0
#include "RigidTransform.h"

#include <openvdb_spheretree/base/TextStream.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>

namespace openvdb_spheretree {
namespace {

using openvdb::Mat3d;
using openvdb::Vec3d;

Vec3d multiply(const Mat3d& m, const Vec3d& v)
{
    Vec3d product;
    for (int i = 0; i < 3; ++i) product[i] = m(i, 0) * v[0] + m(i, 1) * v[1] + m(i, 2) * v[2];
    return product;
}

void requireFinite(const double* numbers, int count, const char* what)
{
    for (int i = 0; i < count; ++i) {
        if (std::isfinite(numbers[i])) continue;
        detail::TextStream text;
        text << what << " has " << numbers[i] << " in it: every number must be finite";
        OPENVDB_THROW(openvdb::ValueError, text.str());
    }
}

/// @return how far rotation^T rotation is from the identity, at its worst entry.
double distanceFromRotation(const Mat3d& m)
{
    double worst = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            double dot = 0;
            for (int k = 0; k < 3; ++k) dot += m(k, i) * m(k, j);
            worst = std::max(worst, std::abs(dot - (i == j)));
        }
    }
    return worst;
}

[[noreturn]] void throwNoRotation(const Mat3d& m, double off)
{
    detail::TextStream text;
    text << "the transform is not rigid: its matrix times its transpose is off the identity by "
         << off << ", and at most " << RigidTransform::kRotationTolerance
         << " is taken for rounding";
    const double scale = std::cbrt(std::abs(m.det()));
    if (scale > 0 && distanceFromRotation(m * (1 / scale)) <= RigidTransform::kRotationTolerance) {
        text << ". It scales by " << scale
             << ": give the tree the scale when it is made ready (scale=), and take the rotation "
                "alone here";
    }
    OPENVDB_THROW(openvdb::ValueError, text.str());
}

/// @return the rotation nearest to a matrix that is almost one. Newton's iteration for the polar
///         decomposition, which squares the error at each step: from 1e-5 two steps end at rounding.
Mat3d nearestRotation(Mat3d m)
{
    for (int step = 0; step < 3; ++step) m = (m + m.inverse().transpose()) * 0.5;
    return m;
}

} // namespace

RigidTransform::RigidTransform(const Mat3d& rotation, const Vec3d& translation)
    : mTranslation(translation)
{
    requireFinite(rotation.asPointer(), 9, "the rotation");
    requireFinite(translation.asPointer(), 3, "the translation");
    const double off = distanceFromRotation(rotation);
    if (!(off <= kRotationTolerance)) throwNoRotation(rotation, off);
    if (rotation.det() < 0) {
        OPENVDB_THROW(openvdb::ValueError,
            "the transform mirrors (its determinant is -1): a rigid body only turns and moves");
    }
    mRotation = nearestRotation(rotation);
}

RigidTransform RigidTransform::fromMatrix(const std::array<double, 16>& m)
{
    requireFinite(m.data(), 16, "the matrix");
    if (m[12] != 0 || m[13] != 0 || m[14] != 0 || m[15] != 1) {
        detail::TextStream text;
        text
            << "the last row of the matrix is " << m[12] << ' ' << m[13] << ' ' << m[14] << ' '
            << m[15]
            << ", and not 0 0 0 1: points are columns here, and the translation is the last column";
        OPENVDB_THROW(openvdb::ValueError, text.str());
    }
    return {Mat3d(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10]), Vec3d(m[3], m[7], m[11])};
}

RigidTransform RigidTransform::fromTranslation(const Vec3d& translation)
{
    requireFinite(translation.asPointer(), 3, "the translation");
    RigidTransform result;
    result.mTranslation = translation;
    return result;
}

RigidTransform RigidTransform::fromRotation(const Vec3d& axis, double radians)
{
    requireFinite(axis.asPointer(), 3, "the axis");
    requireFinite(&radians, 1, "the angle");
    const double largest = std::max({std::abs(axis[0]), std::abs(axis[1]), std::abs(axis[2])});
    if (largest == 0) OPENVDB_THROW(openvdb::ValueError, "the axis of a rotation has no length");
    Vec3d u = axis / largest; // so that squares of tiny numbers do not vanish
    u /= u.length();
    const double c = std::cos(radians), s = std::sin(radians), d = 1 - c;
    return {Mat3d(c + d * u[0] * u[0], d * u[0] * u[1] - s * u[2], d * u[0] * u[2] + s * u[1], //
                d * u[0] * u[1] + s * u[2], c + d * u[1] * u[1], d * u[1] * u[2] - s * u[0],   //
                d * u[0] * u[2] - s * u[1], d * u[1] * u[2] + s * u[0], c + d * u[2] * u[2]),
        Vec3d(0, 0, 0)};
}

Vec3d RigidTransform::rotate(const Vec3d& direction) const
{
    return multiply(mRotation, direction);
}

RigidTransform RigidTransform::operator*(const RigidTransform& first) const
{
    RigidTransform both; // a product of rotations needs no check
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            both.mRotation(i, j) = mRotation(i, 0) * first.mRotation(0, j)
                + mRotation(i, 1) * first.mRotation(1, j) + mRotation(i, 2) * first.mRotation(2, j);
        }
    }
    both.mTranslation = *this * first.mTranslation;
    return both;
}

RigidTransform RigidTransform::inverse() const
{
    RigidTransform back;
    back.mRotation = mRotation.transpose();
    back.mTranslation = -multiply(back.mRotation, mTranslation);
    return back;
}

RigidTransform RigidTransform::seenFrom(const RigidTransform& body) const
{
    RigidTransform relative;
    const Mat3d &a = body.mRotation, &b = mRotation;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            relative.mRotation(i, j) = a(0, i) * b(0, j) + a(1, i) * b(1, j) + a(2, i) * b(2, j);
        }
    }
    const Vec3d t = mTranslation - body.mTranslation;
    for (int i = 0; i < 3; ++i)
        relative.mTranslation[i] = a(0, i) * t[0] + a(1, i) * t[1] + a(2, i) * t[2];
    return relative;
}

} // namespace openvdb_spheretree
