// SPDX-License-Identifier: Apache-2.0
#include "UnitSphere.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace openvdb_spheretree::detail {

namespace {

UnitSphere icosahedron()
{
    const double golden = (1 + std::sqrt(5.0)) / 2;
    UnitSphere sphere;
    // Corners of three golden rectangles, one across each axis.
    for (int axis = 0; axis < 3; ++axis) {
        for (const double u : {-1.0, 1.0}) {
            for (const double v : {-golden, golden}) {
                openvdb::Vec3d point(0, 0, 0);
                point[(axis + 1) % 3] = u;
                point[(axis + 2) % 3] = v;
                sphere.points.push_back(point.unit());
            }
        }
    }
    // Edges join the nearest corners; three that are joined to each other are a face.
    const double edgeSq = (sphere.points[0] - sphere.points[2]).lengthSqr() * 1.01;
    const auto near = [&](uint32_t a, uint32_t b) {
        return (sphere.points[a] - sphere.points[b]).lengthSqr() < edgeSq;
    };
    for (uint32_t a = 0; a < 12; ++a) {
        for (uint32_t b = a + 1; b < 12; ++b) {
            for (uint32_t c = b + 1; c < 12; ++c) {
                if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
                const auto& p = sphere.points;
                const bool outward = p[a].dot((p[b] - p[a]).cross(p[c] - p[a])) > 0;
                sphere.triangles.push_back(
                    outward ? std::array<uint32_t, 3>{a, b, c} : std::array<uint32_t, 3>{a, c, b});
            }
        }
    }
    return sphere;
}

UnitSphere splitInFour(const UnitSphere& coarse)
{
    UnitSphere fine;
    fine.points = coarse.points;
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [entry, isNew] =
            middles.insert({std::minmax(a, b), uint32_t(fine.points.size())});
        if (isNew) fine.points.push_back((fine.points[a] + fine.points[b]).unit());
        return entry->second;
    };
    for (const auto& [a, b, c] : coarse.triangles) {
        const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const auto& triangle :
            {std::array<uint32_t, 3>{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
            fine.triangles.push_back(triangle);
        }
    }
    return fine;
}

} // namespace

UnitSphere unitSphere(int splits)
{
    UnitSphere sphere = icosahedron();
    for (int i = 0; i < splits; ++i) sphere = splitInFour(sphere);
    return sphere;
}

UnitSphere meshShapeFor(std::size_t spheres)
{
    constexpr std::size_t kMany = 1000;
    return unitSphere(spheres > kMany ? 1 : 2);
}

} // namespace openvdb_spheretree::detail
