// SPDX-License-Identifier: Apache-2.0
/// @file MaskGrids.h
/// @brief <openvdb/openvdb.h>, with the grids of voxel sets compiled once (Masks.cc), as their trees
/// are (Masks.h).

#pragma once

#include "Masks.h"

#include <openvdb/openvdb.h>

SPHERETREE_MASK_TEMPLATE class openvdb::Grid<openvdb::MaskTree>;
SPHERETREE_MASK_TEMPLATE class openvdb::Grid<openvdb::BoolTree>;
