// SPDX-License-Identifier: Apache-2.0
/// @file MotionRequest.h
/// @brief What a request to bodies that move comes to, once it is known to make sense.

#pragma once

#include "ContinuousCollide.h"
#include "MotionKernels.h"

namespace openvdb_spheretree::detail {

/// @param radius  of which the tolerance is a part, where the request has none: the smaller body's
/// @throw openvdb::ValueError for a tolerance, a time or a number of blocks that is none
MotionLimits motionLimits(const ContinuousCollisionRequest& request, double radius);

} // namespace openvdb_spheretree::detail
