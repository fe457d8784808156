// SPDX-License-Identifier: Apache-2.0
#include "TriangleVoxels.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/BoxSides.h>
#include <openvdb_spheretree/voxel/Masks.h>

#include <openvdb/math/Transform.h>
#include <openvdb/tools/Prune.h>

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace openvdb_spheretree {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskTree;
using openvdb::Vec3d;

constexpr int kLeafLog2 = 3, kNodeLog2 = 7;

/// c0 + c . p, at the corner of least coordinates of a box.
struct Linear {
    double constant = 0;
    Vec3d slope;
    double at(const Vec3d& p) const { return constant + slope.dot(p); }
};

/// Of one triangle and boxes of one size.
struct BoxFunctions {
    /// None may be negative where the box and the triangle meet: the plane from both sides, and the three
    /// edges of each projection.
    std::array<Linear, 11> atLeastZero;
};

class TriangleBoxTest {
public:
    void set(const IndexMesh& mesh, std::size_t triangle)
    {
        const openvdb::Vec3I& corners = mesh.triangles[triangle];
        set(mesh.points[corners[0]], mesh.points[corners[1]], mesh.points[corners[2]],
            mesh.pointError);
    }
    void set(const Vec3d& a, const Vec3d& b, const Vec3d& c, double pointError)
    {
        for (int axis = 0; axis < 3; ++axis) {
            const auto [low, high] = std::minmax({a[axis], b[axis], c[axis]});
            // The cube of voxel i is from i - 1/2 to i + 1/2.
            mBox.min()[axis] = int32_t(std::ceil(low - 0.5 - pointError));
            mBox.max()[axis] = int32_t(std::floor(high + 0.5 + pointError));
        }
        mBase = mBox.min();
        // Near the triangle coordinates are small, and the difference is exact but for tiny ones.
        const Vec3d corner = mBase.asVec3d() - Vec3d(0.5);
        mCorner = {a - corner, b - corner, c - corner};
        mPointError = pointError + 0x1p-50 * (1 + largestCorner());
        const int64_t side = detail::longestSideOf(mBox);
        mFunctions.clear();
        for (int log2 = 0; mFunctions.empty() || (int64_t(1) << (log2 - 1)) < side; ++log2) {
            mFunctions.push_back(functionsOf(log2));
        }
    }

    /// Those whose cubes meet the box around the triangle.
    const CoordBBox& box() const { return mBox; }
    /// Boxes of so many voxels a side, as a power of two, are at least as large as box().
    int top() const { return int(mFunctions.size()) - 1; }

    /// @return whether the closed box of 2^log2 voxels a side, from the cube of @a first on, meets the
    ///         triangle; log2 is top() at most.
    bool meets(const Coord& first, int log2) const
    {
        const Vec3d p(
            double(first[0]) - mBase[0], double(first[1]) - mBase[1], double(first[2]) - mBase[2]);
        const int64_t last = (int64_t(1) << log2) - 1;
        for (int axis = 0; axis < 3; ++axis) {
            if (first[axis] > mBox.max()[axis] || first[axis] + last < mBox.min()[axis])
                return false;
        }
        for (const Linear& function : mFunctions[std::size_t(log2)].atLeastZero) {
            if (function.at(p) < 0) return false;
        }
        return true;
    }

private:
    double largestCorner() const
    {
        double largest = 0;
        for (const Vec3d& corner : mCorner) {
            for (int axis = 0; axis < 3; ++axis)
                largest = std::max(largest, std::abs(corner[axis]));
        }
        return largest;
    }

    /// A function that is off by rounding is as one of corners that are off by mPointError: its constant is
    /// raised by what that can change. Products of two lengths are in the edges, of three in the plane; the
    /// factor is more than the number of terms.
    BoxFunctions functionsOf(int log2) const
    {
        constexpr double kTerms = 32;
        const double size = double(int64_t(1) << log2);
        const double reach = 2 * largestCorner() + 2 * size; // of all points that are looked at
        BoxFunctions result;
        const std::array<Vec3d, 3> edges{
            mCorner[1] - mCorner[0], mCorner[2] - mCorner[1], mCorner[0] - mCorner[2]};
        const Vec3d normal = edges[0].cross(edges[1]);
        double longest = 0;
        for (const Vec3d& edge : edges) longest = std::max(longest, edge.length());

        // n . (q - corner) is not negative for the furthest point q of the box along n, and not positive
        // for the nearest one.
        const double planeError =
            kTerms * mPointError * longest * reach + kTerms * 0x1p-50 * longest * longest * reach;
        Vec3d far(0), near(0);
        for (int axis = 0; axis < 3; ++axis) (normal[axis] > 0 ? far : near)[axis] = size;
        result.atLeastZero[0] = {normal.dot(far - mCorner[0]) + planeError, normal};
        result.atLeastZero[1] = {-normal.dot(near - mCorner[0]) + planeError, -normal};

        const double edgeError = kTerms * mPointError * reach;
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            // Turned so that the projection is to the left of its edges. Where its area is so small that
            // rounding decides on the turn, either one is right: by less than the error.
            const double turn = normal[axis] < 0 ? -1 : 1;
            for (int i = 0; i < 3; ++i) {
                Linear& function = result.atLeastZero[std::size_t(2 + 3 * axis + i)];
                function.slope = Vec3d(0);
                function.slope[u] = -turn * edges[std::size_t(i)][v];
                function.slope[v] = turn * edges[std::size_t(i)][u];
                function.constant = -function.slope.dot(mCorner[std::size_t(i)])
                    + std::max(0.0, size * function.slope[u])
                    + std::max(0.0, size * function.slope[v]) + edgeError;
            }
        }
        return result;
    }

    CoordBBox mBox;
    Coord mBase;                          ///< its cube's corner is where corners are counted from
    std::array<Vec3d, 3> mCorner;         ///< of the triangle
    double mPointError = 0;               ///< of these
    std::vector<BoxFunctions> mFunctions; ///< by log2
};

/// Calls visit(first) for the boxes of 2^to voxels a side, aligned, that a triangle meets within the
/// aligned box of 2^from from @a first on. Recursion: at most 31 deep.
template <typename Visit>
void visitMet(const TriangleBoxTest& test, const Coord& first, int from, int to, const Visit& visit)
{
    if (!test.meets(first, from)) return;
    if (from == to) return visit(first);
    const int half = 1 << (from - 1);
    for (int i = 0; i < 8; ++i) {
        const Coord child = first.offsetBy(i & 4 ? half : 0, i & 2 ? half : 0, i & 1 ? half : 0);
        visitMet(test, child, from - 1, to, visit);
    }
}

/// The same within box(): it lies in at most eight aligned boxes of 2^top().
template <typename Visit>
void visitAllMet(const TriangleBoxTest& test, int to, const Visit& visit)
{
    const int from = std::max(test.top(), to);
    const int64_t size = int64_t(1) << from;
    const CoordBBox& box = test.box();
    const auto aligned = [&](int32_t coordinate) { return int64_t(coordinate) & ~(size - 1); };
    for (int64_t x = aligned(box.min()[0]); x <= box.max()[0]; x += size) {
        for (int64_t y = aligned(box.min()[1]); y <= box.max()[1]; y += size) {
            for (int64_t z = aligned(box.min()[2]); z <= box.max()[2]; z += size) {
                visitMet(test, Coord(int32_t(x), int32_t(y), int32_t(z)), from, to, visit);
            }
        }
    }
}

/// The voxels that one thread has found.
struct FoundVoxels {
    MaskTree::Ptr tree = std::make_shared<MaskTree>(false);
    openvdb::tree::ValueAccessor<MaskTree> accessor{*tree};
    TriangleBoxTest test;

    void addVoxel(const Coord& voxel) { accessor.setValueOn(voxel); }
    void addLeaf(const Coord& origin)
    {
        auto* const leaf = accessor.touchLeaf(origin);
        visitMet(test, origin, kLeafLog2, 0, [&](const Coord& voxel) { leaf->setValueOn(voxel); });
    }
    void addAll()
    {
        if (test.top() <= kLeafLog2) {
            visitAllMet(test, 0, [&](const Coord& voxel) { addVoxel(voxel); });
        } else {
            visitAllMet(test, kLeafLog2, [&](const Coord& origin) { addLeaf(origin); });
        }
    }
    void addNode(const Coord& origin)
    {
        visitMet(test, origin, kNodeLog2, kLeafLog2, [&](const Coord& leaf) { addLeaf(leaf); });
    }
};

/// A part of a large triangle: what is in a node of 128^3 voxels.
struct Piece {
    std::size_t triangle;
    Coord node;
};

bool isLarge(const CoordBBox& box) { return detail::longestSideOf(box) > 2 << kNodeLog2; }

std::vector<Piece> piecesOfLarge(const IndexMesh& mesh, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<Piece> pieces;
    TriangleBoxTest test;
    for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
        if (triangle % 4096 == 0) detail::checkInterrupt(interrupter);
        test.set(mesh, triangle);
        if (!isLarge(test.box())) continue;
        visitAllMet(test, kNodeLog2, [&](const Coord& node) {
            pieces.push_back({triangle, node});
        });
    }
    return pieces;
}

} // namespace

IndexMesh toIndexSpace(const TriangleMesh& mesh, const openvdb::math::Transform& transform)
{
    // A coordinate is a sum of four terms of the point and the transform, each rounded, and may be much
    // smaller than they are.
    IndexMesh result;
    result.triangles = mesh.triangles;
    result.points.reserve(mesh.points.size());
    const Vec3d shift = transform.worldToIndex(Vec3d(0));
    double largest = 0;
    for (const Vec3d& world : mesh.points) {
        const Vec3d point = transform.worldToIndex(world);
        result.points.push_back(point);
        for (int axis = 0; axis < 3; ++axis) {
            largest = std::max({largest, std::abs(point[axis]), std::abs(shift[axis]),
                std::abs(point[axis] - shift[axis])});
        }
    }
    result.pointError = 0x1p-48 * largest;
    return result;
}

bool meetsVoxel(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Coord& voxel)
{
    TriangleBoxTest test;
    test.set(a, b, c, 0);
    return test.meets(voxel, 0);
}

MaskTree::Ptr trianglesToVoxels(const IndexMesh& mesh, openvdb::util::NullInterrupter* interrupter)
{
    constexpr std::size_t kChunk = 64;
    const std::vector<Piece> pieces = piecesOfLarge(mesh, interrupter);
    const std::size_t chunks = (mesh.triangles.size() + kChunk - 1) / kChunk;
    const auto threads = std::size_t(tbb::this_task_arena::max_concurrency());
    std::vector<FoundVoxels> found(threads);
    const auto addChunk = [&](std::size_t chunk, FoundVoxels& voxels) {
        const std::size_t end = std::min((chunk + 1) * kChunk, mesh.triangles.size());
        for (std::size_t triangle = chunk * kChunk; triangle < end; ++triangle) {
            voxels.test.set(mesh, triangle);
            if (!isLarge(voxels.test.box())) voxels.addAll();
        }
    };
    detail::parallelForWithSlots(
        chunks + pieces.size(), found.size(), interrupter, [&](std::size_t i, std::size_t slot) {
            if (i < chunks) return addChunk(i, found[slot]);
            const Piece& piece = pieces[i - chunks];
            found[slot].test.set(mesh, piece.triangle);
            found[slot].addNode(piece.node);
        });

    const MaskTree::Ptr result = found.front().tree;
    found.front().accessor.clear();
    for (std::size_t slot = 1; slot < found.size(); ++slot) {
        detail::checkInterrupt(interrupter);
        result->topologyUnion(*found[slot].tree);
        found[slot].accessor.clear();
        found[slot].tree->clear();
    }
    openvdb::tools::pruneInactive(*result);
    return result;
}

} // namespace openvdb_spheretree
