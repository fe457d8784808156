// SPDX-License-Identifier: Apache-2.0
/// @file Dimension.h
/// @brief Objects are solids (dim = 3), or one voxel thick along an axis (dim = 2).

#pragma once

namespace openvdb_spheretree {

/// @throw openvdb::ValueError unless @a dim is 2 or 3
void requireDim(int dim);

} // namespace openvdb_spheretree
