// SPDX-License-Identifier: Apache-2.0
/// @file RayKernel.h
/// @brief The kernel of rays: the first leaf sphere along one.
///
/// Results are the same for every vector target. Tests: TestRayQuery.cc.

#pragma once

#include "BlockHit.h"
#include "SphereBlocks.h"

namespace openvdb_spheretree::detail {

/// In the coordinates of the blocks. The origin is where the line is nearest to the middle of the
/// tree, so that floats are as fine as the tree is large, wherever the ray started.
struct RayQuestion {
    float origin[3];
    float direction[3]; ///< of length 1
    float near, far;    ///< the part of the line that is the ray
    float slack;        ///< spheres are larger by this, so that rounding hides none
    bool leavesStart;   ///< spheres that hold the ray's start do not count
    bool anyHit;        ///< the first leaf found will do
};

/// @return the leaf that a ray enters first, and where; before `near` if the ray starts inside.
BlockHit firstLeaf(const SphereBlocks& tree, const RayQuestion& ray);

} // namespace openvdb_spheretree::detail
