// SPDX-License-Identifier: Apache-2.0
/// @file RayShapes.h
/// @brief What a ray can hit: Euclidean balls, discs, balls of norms, and the voxels of a leaf node or
/// tile.
///
/// A shape has three functions:
/// - bound(): a ball and a box that it lies in;
/// - entry(): the distance at which a ray enters it, or a negative number if it does not, or starts
///   inside (a camera looks out of the shape that holds it);
/// - normal(): the unit normal where a ray enters, outwards.
///
/// A RayScene takes any shape that has these. Coordinates are doubles, in voxels.

#pragma once

#include <openvdb_spheretree/index/BoundingTree.h>
#include <openvdb_spheretree/index/Ray.h>
#include <openvdb_spheretree/voxel/Distance.h>
#include <openvdb_spheretree/voxel/MaskTree.h>

#include <openvdb/math/DDA.h>
#include <openvdb/math/Ray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace openvdb_spheretree::detail {

constexpr double kNoEntry = -1;

struct BallShape {
    openvdb::Vec3d center;
    double radius;

    Bound bound() const
    {
        Bound bound = Bound::ofBall(center, radius);
        bound.behind = 0; // entry() is none where the centre is behind
        return bound;
    }
    /// The discriminant comes from the distance of the centre to the line, so that there is no
    /// cancellation for balls far away (Haines et al., Precision improvements for ray/sphere intersection, 2019).
    double entry(const Ray& ray) const
    {
        const openvdb::Vec3d toCenter = center - ray.origin;
        const double nearest = toCenter.dot(ray.direction);
        if (nearest < 0) return kNoEntry;
        const double halfSq = radius * radius - (toCenter - nearest * ray.direction).lengthSqr();
        return halfSq < 0 ? kNoEntry : nearest - std::sqrt(halfSq);
    }
    openvdb::Vec3d normal(const Ray& ray, double t) const { return (ray.at(t) - center).unit(); }
};

/// A disc across an axis, seen from both sides. Its edge is rounded to the eye, though it is flat, so
/// that discs of one colour are told apart.
struct DiscShape {
    openvdb::Vec3d center;
    double radius;
    int axis;

    Bound bound() const
    {
        Bound bound = Bound::ofBall(center, radius);
        openvdb::Vec3d reach(radius);
        reach[axis] = 0;
        bound.box = Box(center - reach, center + reach);
        return bound;
    }
    double entry(const Ray& ray) const
    {
        const double t = (center[axis] - ray.origin[axis]) * ray.inverse[axis];
        if (!(t > 0)) return kNoEntry;
        return (ray.at(t) - center).lengthSqr() > radius * radius ? kNoEntry : t;
    }
    openvdb::Vec3d normal(const Ray& ray, double t) const
    {
        constexpr double kFlat = 0.88, kSteepest = 0.8; // of the radius; of a unit vector
        openvdb::Vec3d across(0.0);
        across[axis] = ray.direction[axis] > 0 ? -1 : 1;
        const openvdb::Vec3d from = ray.at(t) - center;
        const double place = std::min(1.0, from.length() / radius);
        if (place <= kFlat) return across;
        const double tilt = kSteepest * (place - kFlat) / (1 - kFlat);
        return std::sqrt(1 - tilt * tilt) * across + tilt * from.unit();
    }
};

/// The faces of the unit ball of a norm, { x : |normal . x| <= 1 for all of them }. The norm is the
/// largest of these products over all orders and signs of three weights (Distance.h): at most 6
/// orders with 8 signs, in pairs of opposite faces. There are 3 pairs for l-infinity, 4 for l1 and 12
/// for chamfer:3,4,5.
struct NormFaces {
    explicit NormFaces(const Distance& norm)
    {
        const double unit = norm.unit();
        reach = std::max(
            1.0, std::max(std::sqrt(2) * unit / norm.edge(), std::sqrt(3) * unit / norm.corner()));
        std::array<int, 3> weights{
            norm.corner() - norm.edge(), norm.edge() - norm.face(), norm.face()}; // smallest first
        do {
            for (int signs = 0; signs < 8; ++signs) {
                openvdb::Vec3d normal;
                for (int axis = 0; axis < 3; ++axis) {
                    normal[axis] = (signs >> axis & 1 ? -weights[axis] : weights[axis]) / unit;
                }
                const auto isSame = [&](const openvdb::Vec3d& o) {
                    return o == normal || o == -normal;
                };
                if (std::none_of(normals.begin(), normals.end(), isSame)) normals.push_back(normal);
            }
        } while (std::next_permutation(weights.begin(), weights.end()));
    }

    std::vector<openvdb::Vec3d> normals; ///< one for each pair of faces; not of length 1
    double reach;                        ///< Euclidean distance of the farthest corner
};

/// A ball of a norm: a convex polyhedron, the intersection of the slabs between opposite faces.
struct NormBallShape {
    openvdb::Vec3d center;
    double radius;          ///< along each axis, so half the width of its box
    const NormFaces* faces; ///< not null; owned by the caller

    Bound bound() const
    {
        const openvdb::Vec3d reach(radius);
        const double around = radius * faces->reach;
        return {center, around, Box(center - reach, center + reach), around};
    }
    double entry(const Ray& ray) const
    {
        const double around = radius * faces->reach;
        const openvdb::Vec3d toCenter = center - ray.origin;
        const double nearest = toCenter.dot(ray.direction);
        const double asideSq = (toCenter - nearest * ray.direction).lengthSqr();
        if (nearest < -around || asideSq > around * around) return kNoEntry;
        return crossing(ray).begin;
    }
    openvdb::Vec3d normal(const Ray& ray, double) const { return crossing(ray).normal.unit(); }

private:
    struct Crossing {
        double begin = kNoEntry;
        openvdb::Vec3d normal{0, 0, 1}; ///< of the face by which the ray enters
    };
    /// The ray enters the polyhedron with the last slab, if that is before it leaves the first.
    Crossing crossing(const Ray& ray) const
    {
        const openvdb::Vec3d toCenter = center - ray.origin;
        double begin = -1e300, end = 1e300;
        openvdb::Vec3d entered(0, 0, 1);
        for (const openvdb::Vec3d& face : faces->normals) {
            const double middle = face.dot(toCenter), speed = face.dot(ray.direction);
            constexpr double kParallel = 1e-150; // keeps quotients finite
            if (std::abs(speed) < kParallel) {
                if (std::abs(middle) > radius) return {};
                continue;
            }
            const double in = (middle - std::copysign(radius, speed)) / speed;
            end = std::min(end, (middle + std::copysign(radius, speed)) / speed);
            if (in > begin) begin = in, entered = speed > 0 ? -face : face;
        }
        return begin > end || begin < 0 ? Crossing() : Crossing{begin, entered};
    }
};

/// The active voxels of a leaf node, or a tile, as cubes between half-integers. Hits do not depend on
/// whether voxels are stored as a tile or one by one.
struct VoxelShape {
    using LeafNode = openvdb::BoolTree::LeafNodeType;

    openvdb::Vec3d lo, hi;          ///< around the active voxels
    openvdb::Vec3d corner;          ///< the lowest corner of the leaf; of a tile unused
    const LeafNode* leaf = nullptr; ///< null for a tile; owned by the tree it is in

    Bound bound() const { return Bound::ofBox(Box(lo, hi)); }

    double entry(const Ray& ray) const
    {
        const Span span(ray, lo, hi);
        if (span.begin > span.end || span.end < 0) return kNoEntry;
        return leaf ? entryOfVoxels(ray, span) : span.begin;
    }

    /// Faces are at half-integers, so it is along the axis whose coordinate is nearest to one.
    openvdb::Vec3d normal(const Ray& ray, double t) const
    {
        const openvdb::Vec3d point = ray.at(t) - openvdb::Vec3d(0.5);
        openvdb::Vec3d offFace;
        for (int axis = 0; axis < 3; ++axis) {
            offFace[axis] = std::abs(point[axis] - std::round(point[axis]));
        }
        const int axis = int(openvdb::math::MinIndex(offFace));
        openvdb::Vec3d result(0.0);
        result[axis] = ray.direction[axis] > 0 ? -1 : 1;
        return result;
    }

private:
    /// The part of a ray in a box; empty if begin > end.
    struct Span {
        double begin, end;
        Span(const Ray& ray, const openvdb::Vec3d& lo, const openvdb::Vec3d& hi)
            : begin(-1e300), end(1e300)
        {
            for (int axis = 0; axis < 3; ++axis) {
                const double a = (lo[axis] - ray.origin[axis]) * ray.inverse[axis];
                const double b = (hi[axis] - ray.origin[axis]) * ray.inverse[axis];
                begin = std::max(begin, std::min(a, b));
                end = std::min(end, std::max(a, b));
            }
        }
    };

    /// The walk only finds the voxel. Where the ray enters it is computed as for a tile.
    double entryOfVoxels(const Ray& ray, const Span& span) const
    {
        using DdaRay = openvdb::math::Ray<double>;
        const double begin = std::max(span.begin, 0.0);
        const DdaRay local(ray.origin - corner, ray.direction, begin, span.end);
        openvdb::math::DDA<DdaRay, 0> walk(local, begin, span.end);
        do {
            const openvdb::Coord voxel = walk.voxel();
            // Rounding may put the first step on the far side of a face.
            const bool inLeaf = ((voxel[0] | voxel[1] | voxel[2]) & ~7) == 0;
            if (!inLeaf || !leaf->isValueOn(LeafNode::coordToOffset(voxel))) continue;
            const openvdb::Vec3d low = corner + voxel.asVec3d();
            const Span inVoxel(ray, low, low + openvdb::Vec3d(1.0));
            if (inVoxel.begin >= 0) return inVoxel.begin;
        } while (walk.step());
        return kNoEntry;
    }
};

} // namespace openvdb_spheretree::detail
