// SPDX-License-Identifier: Apache-2.0
#include "PrincipalAxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::Mat3d;
using openvdb::Vec3d;

/// Turns the plane of axes p and q so that matrix(p, q) becomes 0; rows of @a axes turn with it.
void rotate(Mat3d& matrix, Mat3d& axes, int p, int q)
{
    const double theta = 0.5 * (matrix(q, q) - matrix(p, p)) / matrix(p, q);
    const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
    const double c = 1 / std::hypot(t, 1.0), s = t * c;
    const auto turn = [c, s](double& atP, double& atQ) {
        const double was = atP;
        atP = c * was - s * atQ;
        atQ = s * was + c * atQ;
    };
    for (int i = 0; i < 3; ++i) turn(matrix(i, p), matrix(i, q));
    for (int i = 0; i < 3; ++i) turn(matrix(p, i), matrix(q, i));
    for (int i = 0; i < 3; ++i) turn(axes(p, i), axes(q, i));
    matrix(p, q) = matrix(q, p) = 0;
}

/// The largest coordinate becomes positive, the first one of those that are as large but for rounding.
Vec3d withSign(const Vec3d& axis)
{
    constexpr double kAsLarge = 1 - 1e-9;
    const double largest = std::max({std::abs(axis[0]), std::abs(axis[1]), std::abs(axis[2])});
    for (int a = 0; a < 3; ++a) {
        if (std::abs(axis[a]) >= kAsLarge * largest) return axis[a] < 0 ? -axis : axis;
    }
    return axis;
}

} // namespace

PrincipalAxes principalAxes(const Mat3d& matrix)
{
    constexpr double kNoise = 1e-14;
    constexpr int kMostRounds = 32; // of which about six are needed
    constexpr std::array<std::pair<int, int>, 3> kPlanes = {{{0, 1}, {0, 2}, {1, 2}}};
    Mat3d turned = matrix, axes = Mat3d::identity();
    double size = 0; // no eigenvalue is larger
    for (int i = 0; i < 9; ++i) size += std::abs(matrix(i / 3, i % 3));
    for (int round = 0; round < kMostRounds; ++round) {
        bool done = true;
        for (const auto& [p, q] : kPlanes) {
            if (std::abs(turned(p, q)) <= kNoise * size) continue;
            rotate(turned, axes, p, q);
            done = false;
        }
        if (done) break;
    }
    std::array<int, 3> order = {0, 1, 2};
    for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)}) {
        const double lower = turned(order[j], order[j]), upper = turned(order[i], order[i]);
        if (lower < upper - kNoise * size) std::swap(order[i], order[j]);
    }
    PrincipalAxes result;
    for (int i = 0; i < 3; ++i) result.moments[i] = turned(order[i], order[i]);
    const Vec3d first = withSign(axes.row(order[0])), second = withSign(axes.row(order[1]));
    result.axes.setRows(first, second, first.cross(second));
    return result;
}

} // namespace openvdb_spheretree::detail
