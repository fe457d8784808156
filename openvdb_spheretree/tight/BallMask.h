// SPDX-License-Identifier: Apache-2.0
/// @file tight/BallMask.h
/// @brief Which voxels of an 8x8x8 leaf a ball holds, exactly.

#pragma once

#include "../LeafLayout.h"
#include "FineBall.h"

namespace openvdb_spheretree {
namespace tight {

/// @return the voxels of the leaf at @a origin that lie in @a ball.
LeafMask ballMask(const FineBall& ball, const openvdb::Coord& origin);

/// @return whether @a ball comes as near to the leaf as one of its voxels.
bool mayReach(const FineBall& ball, const openvdb::Coord& origin);

/// @return the smallest box of voxels that holds all voxels of @a ball; false if it has none.
bool ballBox(const FineBall& ball, openvdb::CoordBBox& box);

} // namespace tight
} // namespace openvdb_spheretree
