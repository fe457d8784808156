// SPDX-License-Identifier: Apache-2.0
#include "MeshCheck.h"

#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/index/BoundingTree.h>
#include <openvdb_spheretree/mesh/TriangleVoxels.h>
#include <openvdb_spheretree/tree/GivenTree.h>
#include <openvdb_spheretree/tree/TreeShape.h>
#include <openvdb_spheretree/voxel/BoxSides.h>
#include <openvdb_spheretree/voxel/MaskDifference.h>

#include <openvdb/Grid.h>
#include <openvdb/math/BBox.h>
#include <openvdb/tree/ValueAccessor.h>

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

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
    int64_t pieces = 0;
    double area = 0;        // of these, in faces of voxels; a triangle may be a line, and have none
    Vec3d where = Vec3d(0); // the middle of the first

    Uncovered& operator+=(const Uncovered& other)
    {
        if (pieces == 0) where = other.where;
        pieces += other.pieces;
        area += other.area;
        return *this;
    }
};

/// The voxel cubes of an object, that every level covers.
class ObjectCubes {
public:
    /// @param voxels  null if no cubes are known to be covered
    explicit ObjectCubes(const openvdb::MaskTree* voxels) : mVoxels(voxels)
    {
        CoordBBox box;
        if (!voxels || !voxels->evalActiveVoxelBoundingBox(box)) return;
        mBox = {box.min().asVec3d() - Vec3d(0.5), box.max().asVec3d() + Vec3d(0.5)};
    }

    enum class Met { All, Some, None };
    /// @return which of the voxels that the piece meets are the object's. Those around a piece as long as a few
    ///         voxels are looked at one by one; some of a longer one may be.
    Met metBy(const Piece& piece) const
    {
        // Coordinates that no voxel has are turned away here.
        const openvdb::BBoxd around = boxOf(piece);
        if (mBox.empty() || !mBox.hasOverlap(around)) return Met::None;
        const Vec3d sides = around.extents();
        const double longest = std::max({sides[0], sides[1], sides[2]});
        if (longest > kNodeDim) return Met::Some;
        const CoordBBox box(Coord::round(around.min()), Coord::round(around.max()));
        // Only the root is asked anew for each voxel; nodes below are remembered.
        const openvdb::tree::ValueAccessor<const openvdb::MaskTree, /*IsSafe=*/false> values(
            *mVoxels);
        if (longest > kFew) return mayMeet(box, longest, values) ? Met::Some : Met::None;
        bool all = true, none = true;
        detail::forEachVoxelOf(box, [&](const Coord& voxel) {
            if (!all && !none) return; // of few voxels
            if (values.isValueOn(voxel)) {
                none = false;
            } else if (meetsVoxel(piece.corner[0], piece.corner[1], piece.corner[2], voxel)) {
                all = false;
            }
        });
        return none ? Met::None : all ? Met::All : Met::Some;
    }

private:
    using Node = openvdb::MaskTree::RootNodeType::ChildNodeType::ChildNodeType;
    using Leaf = openvdb::MaskTree::LeafNodeType;
    static constexpr double kNodeDim = double(Node::DIM), kFew = 3;

    static openvdb::BBoxd boxOf(const Piece& piece)
    {
        openvdb::BBoxd box;
        for (const Vec3d& corner : piece.corner) box.expand(corner);
        return box;
    }

    /// @return whether a node or tile that the box reaches into has voxels: at most 8 of them.
    template <typename Accessor>
    static bool mayMeet(const CoordBBox& box, double longest, const Accessor& values)
    {
        const bool small = longest <= double(Leaf::DIM);
        const int step = small ? int(Leaf::DIM) : int(Node::DIM);
        const Coord first = box.min() & ~(step - 1);
        for (int x = first[0]; x <= box.max()[0]; x += step) {
            for (int y = first[1]; y <= box.max()[1]; y += step) {
                for (int z = first[2]; z <= box.max()[2]; z += step) {
                    const Coord at(x, y, z);
                    const bool hasNode = small
                        ? values.template probeConstNode<Leaf>(at) != nullptr
                        : values.template probeConstNode<Node>(at) != nullptr;
                    if (hasNode || values.isValueOn(at)) return true;
                }
            }
        }
        return false;
    }

    const openvdb::MaskTree* mVoxels;
    openvdb::BBoxd mBox;
};

class LevelCover {
public:
    LevelCover(const SphereTree& tree, const SphereTreeLevel& level, const ObjectCubes& cubes,
        openvdb::util::NullInterrupter* interrupter)
        : mSpheres(storedIn(tree, level)), mTree(boundsOf(mSpheres), interrupter), mCubes(cubes),
          mInterrupter(interrupter)
    {}

    Uncovered uncoveredOf(const Piece& triangle) const
    {
        std::vector<Sphere> near;
        const detail::Bound bound = detail::Bound::ofBall(triangle.middle(), triangle.longest());
        mTree.visitMeeting(bound, [&](int32_t place) {
            near.push_back(mSpheres[std::size_t(mTree.order()[std::size_t(place)])]);
        });
        return uncoveredOf(triangle, near, 0);
    }

private:
    /// A piece has half the area after each step, and three steps halve its longest edge or nearly so. A
    /// triangle of 2^31 voxels is down to 1/64 after some 120.
    static constexpr int kDeepest = 160;
    static constexpr double kSmallest = 1.0 / 64;
    static constexpr double kLong = 64; // worth a task of its own

    static std::vector<Sphere> storedIn(const SphereTree& tree, const SphereTreeLevel& level)
    {
        // In index space, where cubes are; both radii and distances are scaled by the same number.
        constexpr double kRounding = 1e-12;
        // Of spheres of others, the centers are rounded.
        const double moved = tree.settings.isGiven() ? kGivenMove : 0;
        std::vector<Sphere> spheres;
        for (int32_t id = level.begin; id < level.end; ++id) {
            const double radius =
                double(tree.spheres.radiusWorld[std::size_t(id)]) / tree.voxelSize();
            spheres.push_back({tree.transform->worldToIndex(tree.centerWorld(id)),
                std::max(0.0, radius * (1 + kRounding) - moved)});
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

    /// @param candidates  spheres that may hold some of the piece
    Uncovered uncoveredOf(
        const Piece& piece, const std::vector<Sphere>& candidates, int depth) const
    {
        if (depth % 16 == 15) detail::checkInterrupt(mInterrupter);
        const Vec3d middle = piece.middle();
        const double reach = piece.longest();
        std::vector<Sphere> near;
        for (const Sphere& sphere : candidates) {
            if (holds(sphere, piece)) return {};
            const double apart = sphere.radius + reach;
            if ((sphere.center - middle).lengthSqr() <= apart * apart) near.push_back(sphere);
        }
        const ObjectCubes::Met cubes = mCubes.metBy(piece);
        if (cubes == ObjectCubes::Met::All) return {};
        const bool mayBeCovered = !near.empty() || cubes == ObjectCubes::Met::Some;
        if (!mayBeCovered || reach < kSmallest || depth == kDeepest) {
            return {1, piece.area(), middle};
        }
        const std::array<Piece, 2> halves = piece.halves();
        std::array<Uncovered, 2> parts;
        const auto look = [&](int i) { parts[i] = uncoveredOf(halves[i], near, depth + 1); };
        if (reach > kLong) {
            tbb::parallel_invoke([&] { look(0); }, [&] { look(1); });
        } else {
            look(0);
            look(1);
        }
        return parts[0] += parts[1];
    }

    std::vector<Sphere> mSpheres;
    detail::BoundingTree mTree;
    const ObjectCubes& mCubes;
    openvdb::util::NullInterrupter* mInterrupter;
};

/// What to say of a level of which some is not covered.
std::string sentenceOf(const Uncovered& uncovered, double area, const SphereTreeLevel& level,
    const SphereTree& tree, const TriangleMesh& mesh)
{
    const bool isFace = uncovered.area > 0;
    const std::string much = isFace
        ? detail::sentence(
            100 * uncovered.area / std::max(area, uncovered.area), "% of its surface lies")
        : detail::sentence(uncovered.pieces, " pieces of triangles without area lie");
    return detail::sentence("level ", level.level, " is not proven to cover mesh '", mesh.name,
        "': ", much, " outside the stored spheres (first: around ",
        tree.transform->indexToWorld(uncovered.where), ')');
}

std::vector<Piece> trianglesOf(const TriangleMesh& mesh, const openvdb::math::Transform& transform)
{
    std::vector<Piece> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const openvdb::Vec3I& triangle : mesh.triangles) {
        Piece& piece = triangles.emplace_back();
        for (int i = 0; i < 3; ++i) {
            piece.corner[std::size_t(i)] = transform.worldToIndex(mesh.points[triangle[i]]);
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
    const detail::Stage stage("mesh", interrupter, nullptr);
    const bool hasCubes = object && tree.settings.paddingVoxels() >= std::sqrt(0.75);
    const openvdb::MaskTree voxels =
        hasCubes ? detail::maskOf(object->tree()) : openvdb::MaskTree(false);
    const ObjectCubes cubes(hasCubes ? &voxels : nullptr);
    const std::vector<Piece> triangles = trianglesOf(mesh, *tree.transform);
    double area = 0;
    for (const Piece& triangle : triangles) area += triangle.area();

    std::vector<TreeFault> faults;
    for (const SphereTreeLevel& level : tree.levels) {
        const LevelCover cover(tree, level, cubes, interrupter);
        std::vector<Uncovered> parts(triangles.size());
        detail::parallelFor(triangles.size(), interrupter,
            [&](std::size_t i) { parts[i] = cover.uncoveredOf(triangles[i]); });
        Uncovered all;
        for (const Uncovered& part : parts) all += part;
        if (all.pieces == 0) continue;
        faults.push_back({FaultKind::Surface, sentenceOf(all, area, level, tree, mesh)});
    }
    return faults;
}

std::vector<TreeFault> checkAgainst(const SphereTree& tree, const openvdb::BoolGrid* object,
    const TriangleMesh* mesh, openvdb::util::NullInterrupter* interrupter)
{
    std::vector<TreeFault> faults;
    if (object) faults = checkSphereTree(tree, *object, interrupter);
    if (!mesh) return faults;
    for (TreeFault& fault : checkMeshCovered(tree, *mesh, object, interrupter)) {
        faults.push_back(std::move(fault));
    }
    return faults;
}

} // namespace openvdb_spheretree
