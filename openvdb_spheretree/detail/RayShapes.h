// SPDX-License-Identifier: Apache-2.0
/// @file detail/RayShapes.h
/// @brief What a ray can hit: balls, and the voxels of a leaf node or a tile.
///
/// A shape has three functions: bound(), a ball and a box it lies in; entry(), where a ray enters it, negative
/// where it does not, or where it starts inside: what holds the eye is looked out of; and normal(),
/// the unit normal, outwards, where a ray enters. A shape with these three can be put in a RayScene,
/// and no other file need know it. Coordinates are doubles, in voxels.

#pragma once

#include "BoundingTree.h"
#include "Ray.h"

#include <openvdb/math/DDA.h>
#include <openvdb/math/Ray.h>
#include <openvdb/openvdb.h>

#include <cmath>

namespace openvdb_spheretree {
namespace detail {

constexpr double kNoEntry = -1;

struct BallShape {
    openvdb::Vec3d center;
    double radius;

    Bound bound() const { return Bound::ofBall(center, radius); }
    /// The discriminant comes from the distance of centre and line, which does not cancel for balls
    /// far away (Haines et al., Precision improvements for ray/sphere intersection, 2019).
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

/// The active voxels of a leaf node, or a tile, as cubes between half-integers. What is hit does not
/// depend on whether a cube of voxels is a tile or written out.
struct VoxelShape {
    using LeafNode = openvdb::BoolTree::LeafNodeType;

    openvdb::Vec3d lo, hi;          ///< around the active voxels
    openvdb::Vec3d corner;          ///< the lowest one of the leaf
    const LeafNode* leaf = nullptr; ///< null for a tile; owned by the tree it is in

    Bound bound() const { return Bound::ofBox(Box(lo, hi)); }

    double entry(const Ray& ray) const
    {
        const Span span(ray, lo, hi);
        if (span.begin > span.end || span.end < 0) return kNoEntry;
        return leaf ? entryOfVoxels(ray, span) : span.begin;
    }

    /// The axis along which the point lies on a face, which is between voxels: at a half-integer.
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
    /// The part of a ray in a box; empty where begin > end.
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

    /// The walk only finds the voxel; where the ray enters it is computed as for a tile.
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

} // namespace detail
} // namespace openvdb_spheretree
