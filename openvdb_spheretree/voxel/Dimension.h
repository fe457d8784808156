// SPDX-License-Identifier: Apache-2.0
/// @file Dimension.h
/// @brief Objects are solids (dim = 3), or one voxel thick along an axis (dim = 2).

#pragma once

#include <openvdb/Exceptions.h>

namespace openvdb_spheretree {

/// @throw openvdb::ValueError unless @a dim is 2 or 3
inline void requireDim(int dim)
{
    if (dim == 2 || dim == 3) return;
    OPENVDB_THROW(openvdb::ValueError, "dim=" << dim << " is out of range: it must be 2 or 3");
}

} // namespace openvdb_spheretree
