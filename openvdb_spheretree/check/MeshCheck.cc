// SPDX-License-Identifier: Apache-2.0
#include "MeshCheck.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/index/BoundingTree.h>
#include <openvdb_spheretree/mesh/TriangleVoxels.h>
#include <openvdb_spheretree/tree/TreeShape.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>

#include <openvdb/Grid.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace openvdb_spheretree {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;

/// Part of a triangle, in index space.
struct Piece {
    std::array<Vec3d, 3> corner;

    double area() const
    {
        return (corner[1] - corner[0]).cross(corner[2] - corner[0]).length() / 2;
    }
    Vec3d middle() const { return (corner[0] + corner[1] + corner[2]) / 3.0; }
    int longestEdge() const
    {
        const auto lengthSq = [&](int i) { return (corner[(i + 1) % 3] - corner[i]).lengthSqr(); };
        int longest = 0;
        for (int i = 1; i < 3; ++i) longest = lengthSq(i) > lengthSq(longest) ? i : longest;
        return longest;
    }
    double longest() const
    {
        const int i = longestEdge();
        return (corner[(i + 1) % 3] - corner[i]).length();
    }
    std::array<Piece, 2> halves() const
    {
        const int i = longestEdge();
        const Vec3d &a = corner[i], &b = corner[(i + 1) % 3], &c = corner[(i + 2) % 3];
        const Vec3d middleOfEdge = (a + b) / 2.0;
        return {Piece{{a, middleOfEdge, c}}, Piece{{middleOfEdge, b, c}}};
    }
};

struct Sphere {
    Vec3d center; // index space
    double radius;
};

/// What of a triangle, or of all, is not covered.
struct Uncovered {
    double area = 0, allArea = 0; // of voxels' faces
    Vec3d where = Vec3d(0);       // the middle of a piece, if area > 0

    void add(const Uncovered& other)
    {
        if (area == 0) where = other.where;
        area += other.area;
        allArea += other.allArea;
    }
};

class LevelCover {
public:
    /// @param cubes  that every level covers; null if none are known to
    LevelCover(const SphereTree& tree, const SphereTreeLevel& level, const openvdb::MaskTree* cubes,
        openvdb::util::NullInterrupter* interrupter)
        : mSpheres(storedIn(tree, level)), mTree(boundsOf(mSpheres), interrupter), mCubes(cubes),
          mInterrupter(interrupter)
    {}

    Uncovered uncoveredOf(const Piece& triangle) const
    {
        Uncovered result;
        result.allArea = triangle.area();
        std::vector<Sphere> near;
        const detail::Bound bound = detail::Bound::ofBall(triangle.middle(), triangle.longest());
        mTree.visitMeeting(bound, [&](int32_t place) {
            near.push_back(mSpheres[std::size_t(mTree.order()[std::size_t(place)])]);
        });
        divide(triangle, near, 0, result);
        return result;
    }

private:
    /// A piece has half the area after each step, and three steps halve its longest edge or nearly so. A
    /// triangle of 2^31 voxels is down to 1/64 after some 120.
    static constexpr int kDeepest = 160;
    static constexpr double kSmallest = 1.0 / 64;

    static std::vector<Sphere> storedIn(const SphereTree& tree, const SphereTreeLevel& level)
    {
        // In index space, where cubes are; both radii and distances are scaled by the same number.
        constexpr double kRounding = 1e-12;
        std::vector<Sphere> spheres;
        for (int32_t id = level.begin; id < level.end; ++id) {
            const double radius =
                double(tree.spheres.radiusWorld[std::size_t(id)]) / tree.voxelSize();
            spheres.push_back(
                {tree.transform->worldToIndex(tree.centerWorld(id)), radius * (1 + kRounding)});
        }
        return spheres;
    }
    static std::vector<detail::Bound> boundsOf(const std::vector<Sphere>& spheres)
    {
        std::vector<detail::Bound> bounds;
        for (const Sphere& sphere : spheres) {
            bounds.push_back(detail::Bound::ofBall(sphere.center, sphere.radius));
        }
        return bounds;
    }

    static bool holds(const Sphere& sphere, const Piece& piece)
    {
        return std::all_of(piece.corner.begin(), piece.corner.end(), [&](const Vec3d& corner) {
            return (corner - sphere.center).lengthSqr() <= sphere.radius * sphere.radius;
        });
    }

    static CoordBBox voxelsOf(const Piece& piece)
    {
        CoordBBox box;
        for (const Vec3d& corner : piece.corner) box.expand(Coord::round(corner));
        return box;
    }

    enum class Cubes { All, Some, None };
    /// @return which of the voxels that the piece meets are the object's. Those around a piece as long as a few
    ///         voxels are looked at one by one; some of a longer one may be.
    Cubes cubesOf(const Piece& piece) const
    {
        if (!mCubes) return Cubes::None;
        const CoordBBox box = voxelsOf(piece);
        if (box.volume() > 64) return Cubes::Some;
        bool all = true, none = true;
        for (auto voxel = box.begin(); voxel && (all || none); ++voxel) {
            if (mCubes->isValueOn(*voxel)) {
                none = false;
            } else if (meetsVoxel(piece.corner[0], piece.corner[1], piece.corner[2], *voxel)) {
                all = false;
            }
        }
        return all ? Cubes::All : none ? Cubes::None : Cubes::Some;
    }

    /// Recursion: kDeepest at most.
    void divide(const Piece& piece, const std::vector<Sphere>& candidates, int depth,
        Uncovered& result) const
    {
        if (depth % 16 == 15) detail::checkInterrupt(mInterrupter);
        const Vec3d middle = piece.middle();
        const double reach = piece.longest();
        std::vector<Sphere> near;
        for (const Sphere& sphere : candidates) {
            if (holds(sphere, piece)) return;
            const double apart = sphere.radius + reach;
            if ((sphere.center - middle).lengthSqr() <= apart * apart) near.push_back(sphere);
        }
        const Cubes cubes = cubesOf(piece);
        if (cubes == Cubes::All) return;
        const bool mayBeCovered = !near.empty() || cubes == Cubes::Some;
        if (!mayBeCovered || reach < kSmallest || depth == kDeepest) {
            result.add({piece.area(), 0, middle});
            return;
        }
        for (const Piece& half : piece.halves()) divide(half, near, depth + 1, result);
    }

    std::vector<Sphere> mSpheres;
    detail::BoundingTree mTree;
    const openvdb::MaskTree* mCubes;
    openvdb::util::NullInterrupter* mInterrupter;
};

std::vector<Piece> trianglesOf(const TriangleMesh& mesh, const openvdb::math::Transform& transform)
{
    std::vector<Piece> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const openvdb::Vec3I& triangle : mesh.triangles) {
        Piece& piece = triangles.emplace_back();
        for (int i = 0; i < 3; ++i) {
            piece.corner[std::size_t(i)] = transform.worldToIndex(Vec3d(mesh.points[triangle[i]]));
        }
    }
    return triangles;
}

} // namespace

std::vector<TreeFault> checkMeshCovered(const SphereTree& tree, const TriangleMesh& mesh,
    const openvdb::BoolGrid* object, openvdb::util::NullInterrupter* interrupter)
{
    if (tree.settings.isInner() || tree.settings.isFit() || !tree.settings.dist().isEuclidean()) {
        OPENVDB_THROW(
            openvdb::ValueError, "a mesh is covered by spheres with side=outer alone, of dist=l2");
    }
    requireUsableMesh(mesh, tree.voxelSize());
    const bool hasCubes = object && tree.settings.paddingVoxels() >= std::sqrt(0.75);
    const openvdb::MaskTree cubes =
        hasCubes ? detail::maskOf(object->tree()) : openvdb::MaskTree(false);
    const std::vector<Piece> triangles = trianglesOf(mesh, *tree.transform);

    std::vector<TreeFault> faults;
    for (const SphereTreeLevel& level : tree.levels) {
        const LevelCover cover(tree, level, hasCubes ? &cubes : nullptr, interrupter);
        std::vector<Uncovered> parts(triangles.size());
        detail::parallelFor(triangles.size(), interrupter,
            [&](std::size_t i) { parts[i] = cover.uncoveredOf(triangles[i]); });
        Uncovered all;
        for (const Uncovered& part : parts) all.add(part);
        if (all.area == 0) continue;
        faults.push_back({FaultKind::Surface,
            detail::sentence("level ", level.level, " is not proven to cover mesh '", mesh.name,
                "': ", 100 * all.area / std::max(all.allArea, all.area),
                "% of its surface lies outside the stored spheres (first: around ",
                tree.transform->indexToWorld(all.where), ')')});
    }
    return faults;
}

} // namespace openvdb_spheretree
