// SPDX-License-Identifier: Apache-2.0
/// @file ObjectVoxels.h
/// @brief An object's voxels as the stages take them.

#pragma once

#include "FlatAxis.h"
#include "MaskTree.h"

namespace openvdb_spheretree {

/// @return the active voxels of @a object, turned so that its flat axis is z.
openvdb::MaskTree::Ptr voxelsOf(const openvdb::BoolGrid& object, const FlatAxis& flat);

} // namespace openvdb_spheretree
