// SPDX-License-Identifier: Apache-2.0
#include "MeshHoles.h"

#include <openvdb_spheretree/base/ParallelSort.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace openvdb_spheretree {

namespace {

using openvdb::BBoxd;
using openvdb::Vec3d;
using openvdb::Vec3I;

/// Sets of points that edges join (union by the lesser number, paths halved).
class JoinedPoints {
public:
    explicit JoinedPoints(const std::vector<OpenEdge>& edges)
    {
        for (const OpenEdge& edge : edges) mPoints.insert(mPoints.end(), {edge.from, edge.to});
        std::sort(mPoints.begin(), mPoints.end());
        mPoints.erase(std::unique(mPoints.begin(), mPoints.end()), mPoints.end());
        mParent.resize(mPoints.size());
        std::iota(mParent.begin(), mParent.end(), std::size_t(0));
        for (const OpenEdge& edge : edges) {
            const std::size_t a = setOf(edge.from), b = setOf(edge.to);
            mParent[std::max(a, b)] = std::min(a, b);
        }
    }

    const std::vector<uint32_t>& points() const { return mPoints; }

    /// @return the number of the first point of its set.
    std::size_t setOf(uint32_t point)
    {
        std::size_t i =
            std::size_t(std::lower_bound(mPoints.begin(), mPoints.end(), point) - mPoints.begin());
        while (mParent[i] != i) i = mParent[i] = mParent[mParent[i]];
        return i;
    }

private:
    std::vector<uint32_t> mPoints; ///< in order
    std::vector<std::size_t> mParent;
};

struct EdgeOfTriangle {
    uint32_t low, high; ///< its points
    bool isUpward;      ///< it goes from low to high

    bool operator<(const EdgeOfTriangle& other) const
    {
        return std::tie(low, high) < std::tie(other.low, other.high);
    }
};

struct Hole {
    Vec3d sum = Vec3d(0);
    double points = 0;
    BBoxd box;

    Vec3d middle() const { return sum / points; }
    double width() const
    {
        const Vec3d sides = box.extents();
        return sides.sorted()[1];
    }
};

} // namespace

std::vector<OpenEdge> openEdgesOf(
    const TriangleMesh& mesh, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<EdgeOfTriangle> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const Vec3I& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a < b});
        }
    }
    detail::parallelSort(edges.begin(), edges.end(), interrupter);
    std::vector<OpenEdge> open;
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        const auto [low, high, isUpward] = edges[begin];
        std::ptrdiff_t upward = 0;
        for (; end < edges.size() && edges[end].low == low && edges[end].high == high; ++end) {
            upward += edges[end].isUpward ? 1 : -1;
        }
        if ((end - begin) % 2 == 0) continue;
        open.push_back(upward > 0 ? OpenEdge{low, high} : OpenEdge{high, low});
    }
    return open;
}

MeshHoles holesOf(const TriangleMesh& mesh, const std::vector<OpenEdge>& edges)
{
    JoinedPoints joined(edges);
    std::vector<Hole> holes(joined.points().size()); // at the first of their points
    for (const uint32_t point : joined.points()) {
        Hole& hole = holes[joined.setOf(point)];
        hole.sum += mesh.points[point];
        hole.points += 1;
        hole.box.expand(mesh.points[point]);
    }
    const Vec3d origin = boxOf(mesh).getCenter(); // far from it, volumes would be small differences
    const auto sixfold = [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
        return (a - origin).dot((b - origin).cross(c - origin));
    };
    MeshHoles all;
    double volume = 0;
    for (const Vec3I& t : mesh.triangles) {
        volume += sixfold(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    }
    for (const OpenEdge& edge : edges) {
        const Hole& hole = holes[joined.setOf(edge.from)];
        volume += sixfold(mesh.points[edge.to], mesh.points[edge.from], hole.middle());
    }
    for (const Hole& hole : holes) {
        if (hole.points > 0) all.widest = std::max(all.widest, hole.width());
    }
    all.volume = std::abs(volume) / 6;
    return all;
}

} // namespace openvdb_spheretree
