// SPDX-License-Identifier: Apache-2.0
#include "WindingNumber.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/index/BoundingTree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace openvdb_spheretree {

namespace {

using openvdb::Vec3d;

/// Twice the area of the triangle from @a p to the edge from @a a to @a b, in the plane across a ray;
/// nothing where rounding may decide on its sign.
std::optional<double> sideOf(const Vec3d& p, const Vec3d& a, const Vec3d& b, int u, int v)
{
    const double ax = a[u] - p[u], ay = a[v] - p[v], bx = b[u] - p[u], by = b[v] - p[v];
    const double side = ax * by - ay * bx;
    const double doubt = 0x1p-40 * (1 + std::abs(ax * by) + std::abs(ay * bx));
    if (std::abs(side) <= doubt) return std::nullopt;
    return side;
}

/// @return 1 or -1 if the ray from @a p along an axis leaves or enters through the triangle, 0 if it misses
///         it; nothing where that is in doubt.
std::optional<int> crossing(
    const Vec3d& p, const std::array<Vec3d, 3>& corner, int axis, int u, int v)
{
    bool misses = false, isAbove = false;
    for (const int w : {u, v}) {
        const auto [low, high] = std::minmax({corner[0][w], corner[1][w], corner[2][w]});
        misses = misses || p[w] < low - 0.5 || p[w] > high + 0.5;
    }
    for (const Vec3d& c : corner) isAbove = isAbove || c[axis] > p[axis];
    if (misses || !isAbove) return 0;
    std::array<double, 3> sides{};
    bool doubtful = false;
    for (int i = 0; i < 3; ++i) {
        const auto side = sideOf(p, corner[i], corner[(i + 1) % 3], u, v);
        doubtful = doubtful || !side;
        sides[i] = side.value_or(0);
    }
    const auto [least, most] = std::minmax({sides[0], sides[1], sides[2]});
    if (least < 0 && most > 0) return 0; // beyond one of the edges, whatever is in doubt
    if (doubtful) return std::nullopt;
    // The side of an edge weighs the corner that is not on it. The triangle misses the voxel's cube, so it
    // is not near the place itself.
    const double height =
        (sides[1] * corner[0][axis] + sides[2] * corner[1][axis] + sides[0] * corner[2][axis])
        / (sides[0] + sides[1] + sides[2]);
    if (height < p[axis]) return 0;
    return sides[0] > 0 ? 1 : -1;
}

/// Triangles, and a tree of their boxes.
class RayMesh {
public:
    RayMesh(const IndexMesh& mesh, openvdb::util::NullInterrupter* interrupter)
        : mMesh(mesh), mTree(boundsOf(mesh), interrupter)
    {}

    /// @return the sum of what the ray from @a place along an axis crosses, or nothing where one is in doubt.
    std::optional<int> sumAlong(int axis, const Vec3d& place) const
    {
        Vec3d direction(0);
        direction[axis] = 1;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::optional<int> sum = 0;
        mTree.visitAlong(detail::Ray(place, direction), kFar, [&](int32_t leaf, double far) {
            const openvdb::Vec3I& t = mMesh.triangles[mTree.order()[leaf]];
            const auto one = crossing(
                place, {mMesh.points[t[0]], mMesh.points[t[1]], mMesh.points[t[2]]}, axis, u, v);
            if (one) *sum += *one;
            else sum.reset();
            return one ? far : -1; // the end, where one is in doubt
        });
        return sum;
    }

private:
    static constexpr double kFar = 1e30;

    static std::vector<detail::Bound> boundsOf(const IndexMesh& mesh)
    {
        std::vector<detail::Bound> bounds;
        bounds.reserve(mesh.triangles.size());
        for (const openvdb::Vec3I& t : mesh.triangles) {
            detail::Box box;
            for (int i = 0; i < 3; ++i) box.expand(mesh.points[t[i]]);
            bounds.push_back(detail::Bound::ofBox(box));
        }
        return bounds;
    }

    const IndexMesh& mMesh;
    detail::BoundingTree mTree;
};

int windingAlong(int axis, const openvdb::Coord& voxel, const RayMesh& mesh)
{
    constexpr int kPlaces = 16;
    // Multiples of the golden ratio and the like are spread evenly, and seldom in line with a mesh.
    const Vec3d steps(0.7548776662466927, 0.5698402909980532, 0.4180339887498949);
    for (int i = 1; i <= kPlaces; ++i) {
        Vec3d place = voxel.asVec3d();
        for (int a = 0; a < 3; ++a) {
            const double turn = i * steps[a];
            place[a] += 0.8 * (turn - std::floor(turn) - 0.5); // well within the cube
        }
        if (const auto sum = mesh.sumAlong(axis, place)) return *sum;
    }
    return 0;
}

} // namespace

std::vector<int> windingNumbers(const IndexMesh& mesh, const std::vector<openvdb::Coord>& voxels,
    openvdb::util::NullInterrupter* interrupter)
{
    std::vector<int> numbers(voxels.size());
    if (voxels.empty()) return numbers;
    const RayMesh rays(mesh, interrupter);
    detail::parallelFor(voxels.size(), interrupter, [&](std::size_t i) {
        std::array<int, 3> along{};
        for (int axis = 0; axis < 3; ++axis) {
            along[axis] = windingAlong(axis, voxels[i], rays);
        }
        std::sort(along.begin(), along.end());
        numbers[i] = along[1];
    });
    return numbers;
}

} // namespace openvdb_spheretree
