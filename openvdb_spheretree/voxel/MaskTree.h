// SPDX-License-Identifier: Apache-2.0
/// @file MaskTree.h
/// @brief OpenVDB's sets of voxels, and the names of its grids, as <openvdb/openvdb.h> has them. Most
/// files of this library work on voxels alone and include this instead.
///
/// The whole header takes two more seconds a file: each file that sees OpenVDB's maps
/// (<openvdb/math/Maps.h>) compiles their virtual functions once more. The grids are only declared here:
/// to use one, include <openvdb/openvdb.h>, before or after. The names are then declared twice, alike.

#pragma once

#include <openvdb/Exceptions.h>
#include <openvdb/Types.h>
#include <openvdb/math/Coord.h>
#include <openvdb/tree/Tree.h>
#include <openvdb/version.h>

namespace openvdb {
OPENVDB_USE_VERSION_NAMESPACE
namespace OPENVDB_VERSION_NAME {

using BoolTree = tree::Tree4<bool, 5, 4, 3>::Type;
using MaskTree = tree::Tree4<ValueMask, 5, 4, 3>::Type;
using FloatTree = tree::Tree4<float, 5, 4, 3>::Type;

class GridBase;
template <typename TreeT>
class Grid;
using BoolGrid = Grid<BoolTree>;
using FloatGrid = Grid<FloatTree>;

namespace math {
class Transform;
} // namespace math

} // namespace OPENVDB_VERSION_NAME
} // namespace openvdb
