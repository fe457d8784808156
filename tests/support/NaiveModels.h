// SPDX-License-Identifier: Apache-2.0
/// @file NaiveModels.h
/// @brief Pyramid models voxel by voxel, on sets of coordinates.

#pragma once

#include "NaiveReference.h"

namespace spheretree_test {

/// Dilation, then erosion: a voxel stays whose whole ball has been dilated to.
Voxels naiveClosing(const Voxels& voxels, int radius, int dim = 3);

} // namespace spheretree_test
