// SPDX-License-Identifier: Apache-2.0
/// @file BoundingNode.h
/// @brief A node of a BoundingTree: the bounds of up to eight children side by side, so that a ray
/// is tested against all of them at once.

#pragma once

#include "Ray.h"

#include <array>
#include <cstdint>
#include <limits>

namespace openvdb_spheretree::detail {

struct BoundingNode {
    static constexpr int kWidth = 8;
    template <typename T>
    using Each = std::array<T, kWidth>; ///< one a child

    std::array<Each<float>, 3> lo{}, hi{}, center{}; ///< by axis
    Each<float> radius{}, behind;                    ///< of the ball, and as in Bound
    Each<int32_t> first{}; ///< of the bodies of a child, or the node that it is
    Each<int32_t> count{}; ///< of the bodies of a child; 0 if it is a node

    /// Without children: all is in front of nothing.
    BoundingNode() { behind.fill(-std::numeric_limits<float>::infinity()); }
};

/// @param entry  receives where the ray enters both ball and box, for the children of the result; 0
///               if it starts inside. (With the plane that touches the ball in front, in place of a
///               root, dragon-512's leaf balls take 7.9 s of CPU time at 640 x 480 in place of
///               4.0.)
/// @return a bit for each child that the ray enters no further away than @a far
uint32_t entriesOf(
    const BoundingNode& node, const Ray& ray, double far, BoundingNode::Each<double>& entry);

} // namespace openvdb_spheretree::detail
