// SPDX-License-Identifier: Apache-2.0
/// @file CoverTrial.h
/// @brief A trial disturbs one ball of a cover: the ball grows or moves. Then each ball near it is
/// placed anew for the voxels that it alone still holds.

#pragma once

#include "CoverPart.h"

#include <cstdint>

namespace openvdb_spheretree::tight {

/// @param number  of the trial: it decides which ball, and what is done to it
/// @return the change of the cover, which may raise the cost.
CoverChange tryChange(const BallCover& cover, const PartFit& fit, uint64_t number);

} // namespace openvdb_spheretree::tight
