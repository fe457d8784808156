// SPDX-License-Identifier: Apache-2.0
/// @file RayScene.h
/// @brief Many shapes of one kind: which of them a ray hits first, and whether it hits any.
///
/// Shapes are stored in the order of the leaves of a BoundingTree. The result does not depend on
/// that tree: of shapes hit at the same distance the first is taken. Tests: TestRayScene.cc.

#pragma once

#include <openvdb_spheretree/index/BoundingTree.h>
#include <openvdb_spheretree/index/Ray.h>

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace openvdb_spheretree::detail {

struct Hit {
    double distance;       ///< along the ray
    int32_t shape;         ///< index among the shapes that the scene was made of
    openvdb::Vec3d normal; ///< unit, outwards
};

/// @tparam Shape  as in RayShapes.h
template <typename Shape>
class RayScene {
public:
    /// @throw Interrupted if the interrupter (may be null) said so
    RayScene(const std::vector<Shape>& shapes, openvdb::util::NullInterrupter* interrupter)
        : mBounds(boundsOf(shapes), interrupter)
    {
        mShapes.reserve(shapes.size());
        for (const int32_t i : mBounds.order()) mShapes.push_back(shapes[i]);
    }

    /// @return the first shape that @a ray enters.
    std::optional<Hit> nearest(const Ray& ray) const
    {
        int32_t found = -1;
        const std::vector<int32_t>& order = mBounds.order();
        double distance = kFar;
        mBounds.visitAlong(ray, kFar, [&](int32_t place, double far) {
            const double t = mShapes[place].entry(ray);
            if (t < 0 || t > far) return far;
            if (found >= 0 && t == far && order[place] > order[found]) return far;
            found = place;
            return distance = t;
        });
        if (found < 0) return {};
        return Hit{distance, order[found], mShapes[found].normal(ray, distance)};
    }

    /// @return whether @a ray enters any shape less than @a far away.
    bool isBlocked(const Ray& ray, double far = kFar) const
    {
        bool blocked = false;
        mBounds.visitAlong(ray, far, [&](int32_t place, double reach) {
            const double t = mShapes[place].entry(ray);
            if (t < 0 || t >= far) return reach;
            blocked = true;
            return -1.0;
        });
        return blocked;
    }

private:
    static constexpr double kFar = 1e200;

    static std::vector<Bound> boundsOf(const std::vector<Shape>& shapes)
    {
        std::vector<Bound> bounds;
        bounds.reserve(shapes.size());
        for (const Shape& shape : shapes) bounds.push_back(shape.bound());
        return bounds;
    }

    BoundingTree mBounds;
    std::vector<Shape> mShapes;
};

} // namespace openvdb_spheretree::detail
